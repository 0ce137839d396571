// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/base/report.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

#include <connectivity/base/budget.hpp>

namespace connectivity {

ReportEntry& Report::entry(std::string_view product) {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](auto& e) { return e.product == product; });
    if (found != entries_.end()) return *found;
    constexpr std::size_t usual = 16;  // small builds would notice the growth
    if (entries_.empty()) entries_.reserve(usual);
    entries_.emplace_back();
    entries_.back().product = product;
    return entries_.back();
}

const ReportEntry* Report::find(std::string_view product) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](auto& e) { return e.product == product; });
    return found == entries_.end() ? nullptr : &*found;
}

std::int64_t& Report::counter(std::string_view name) {
    const auto found =
        std::find_if(counters_.begin(), counters_.end(), [&](auto& c) { return c.name == name; });
    if (found != counters_.end()) return found->value;
    counters_.push_back({std::string(name), 0});
    return counters_.back().value;
}

std::int64_t Report::count(std::string_view name) const {
    const auto found =
        std::find_if(counters_.begin(), counters_.end(), [&](auto& c) { return c.name == name; });
    return found == counters_.end() ? 0 : found->value;
}

std::int64_t Report::total_bytes() const {
    std::int64_t sum = 0;
    for (const auto& e : entries_) sum += e.bytes;
    return sum;
}

std::string Report::text() const {
    std::string out = "product      asked by    built          held        ms  why\n";
    std::array<char, 128> line{};
    for (const auto& e : entries_) {
        std::snprintf(line.data(), line.size(), "%-12s %-11s %-7s %11s %9.2f  ", e.product.c_str(),
                      e.asked_by.empty() ? "nobody" : e.asked_by.c_str(),
                      e.built ? (e.reused ? "reused" : "yes") : "no", human_bytes(e.bytes).c_str(),
                      e.ms);
        out += line.data() + e.reason + '\n';
    }
    for (const auto& c : counters_) out += c.name + " = " + std::to_string(c.value) + '\n';
    return out;
}

namespace {
std::int64_t now_ns() {
    using std::chrono::duration_cast, std::chrono::nanoseconds, std::chrono::steady_clock;
    return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
}
}  // namespace

Stopwatch::Stopwatch() : start_ns_(now_ns()) {}
double Stopwatch::ms() const { return static_cast<double>(now_ns() - start_ns_) * 1e-6; }

}  // namespace connectivity
