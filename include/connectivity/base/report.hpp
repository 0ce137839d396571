// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a build made, who asked for it, and what it cost. What nobody asked for stands here with 0
/// bytes and 0 ms.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace connectivity {

struct ReportEntry {
    std::string product;   ///< "rows", "pairs", "order", ...
    std::string asked_by;  ///< who needs it; empty if nobody
    std::string reason;    ///< why it was built the way it was
    bool built = false;
    bool reused = false;     ///< storage or content kept from the build before
    std::int64_t bytes = 0;  ///< held now
    double ms = 0;           ///< of the last build
};

struct ReportCounter {
    std::string name;
    std::int64_t value = 0;
};

class Report {
public:
    /// The entry of a product, made on first use.
    ReportEntry& entry(std::string_view product);
    const ReportEntry* find(std::string_view product) const;
    std::int64_t& counter(std::string_view name);
    std::int64_t count(std::string_view name) const;  ///< 0 if there is none

    const std::vector<ReportEntry>& entries() const { return entries_; }
    const std::vector<ReportCounter>& counters() const { return counters_; }
    std::int64_t total_bytes() const;

    /// A table for people: one line per product, then the counters.
    std::string text() const;

private:
    std::vector<ReportEntry> entries_;
    std::vector<ReportCounter> counters_;
};

/// Milliseconds since it was made.
class Stopwatch {
public:
    Stopwatch();
    double ms() const;

private:
    std::int64_t start_ns_;
};

}  // namespace connectivity
