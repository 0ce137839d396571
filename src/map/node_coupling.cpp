// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/node_coupling.hpp>

#include <algorithm>
#include <utility>

#include <connectivity/base/kokkos_shim.hpp>
#include <connectivity/base/runtime.hpp>
#include <connectivity/map/pair_field_base.hpp>

#include "base/first_exception.hpp"

namespace connectivity {
namespace {

constexpr const char* label = "map/pairs/coupling";
using Slots = Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>;

bool is_allowed(double value) { return value >= 0 && value <= 1; }

/// fill(row, first, last) writes values[first .. last) of a half row. Returns the first pair whose
/// value is not allowed, or their number.
template <class Fill>
Offset evaluate(const HalfRows& pairs, const Fill& fill, const double* values) {
    const Offset n_rows = static_cast<Offset>(pairs.offsets.size()) - 1;
    const auto n_pairs = static_cast<Offset>(pairs.j.size());
    Offset first_bad = n_pairs;
    detail::FirstException failure;
    auto* const failed = &failure;
    Kokkos::parallel_reduce(
        label, Slots(0, n_rows),
        [=](const Offset row, Offset& bad) {
            const Offset first = pairs.offsets(row), last = pairs.offsets(row + 1);
            if (first == last || failed->any()) return;
            try {
                fill(row, first, last);
            } catch (...) {
                failed->keep();
                return;
            }
            for (Offset k = first; k < last && k < bad; ++k)
                if (!is_allowed(values[k])) bad = k;
        },
        Kokkos::Min<Offset>(first_bad));
    failure.rethrow();
    return std::min(first_bad, n_pairs);
}

[[noreturn]] void throw_out_of_range(const HalfRows& pairs, Offset k, double value) {
    const Offset* const begin = pairs.offsets.data();
    const Offset row = std::upper_bound(begin, begin + pairs.offsets.size(), k) - begin - 1;
    throw Error(Status::argument, "set_coupling: pair " + std::to_string(k) + " (slots " +
                                      std::to_string(pairs.node(row)) + " and " +
                                      std::to_string(pairs.j(k)) +
                                      "): coupling = " + number(value) + ", must be in [0, 1]");
}

}  // namespace

ConstView<double> PairCoupling::values() const {
    if (!exists_) return {};
    return Kokkos::subview(values_, std::pair<Offset, Offset>(0, n_));
}

Offset PairCoupling::bytes() const {
    return static_cast<Offset>((values_.size() + spare_.size() + pending_.size()) * sizeof(double));
}

template <class Fill>
void PairCoupling::fill_all(const HalfRows& pairs, const Fill& fill) {
    const auto n = static_cast<Offset>(pairs.j.size());
    ensure_capacity(spare_, label, n);
    shim::outside_parallel_region([&] {
        start_runtime();  // for this thread: it may be another one than the builder's
        double* const out = spare_.data();
        const auto fill_row = [&](Offset row, Offset first, Offset last) {
            fill(row, first, last, out);
        };
        const Offset bad = evaluate(pairs, fill_row, out);
        if (bad < n) throw_out_of_range(pairs, bad, spare_(bad));
    });
    std::swap(values_, spare_);
    n_ = n;
    exists_ = true;
}

void PairCoupling::set(const HalfRows& pairs, const NodeCoupling& f) {
    fill_all(pairs, [&](Offset row, Offset first, Offset last, double* out) {
        f(pairs.node(row), {pairs.j.data() + first, pairs.j.data() + last}, out + first);
    });
}

void PairCoupling::set(const HalfRows& pairs, std::span<const double> values) {
    fill_all(pairs, [&](Offset, Offset first, Offset last, double* out) {
        std::copy(values.data() + first, values.data() + last, out + first);
    });
}

void PairCoupling::set(const HalfRows& pairs, Offset k, double value) {
    const auto n = static_cast<Offset>(pairs.j.size());
    if (k < 0 || k >= n)
        throw Error(Status::argument, "set_coupling: pair " + std::to_string(k) +
                                          ", must be in [0, " + std::to_string(n) + ")");
    if (!is_allowed(value)) throw_out_of_range(pairs, k, value);
    if (!exists_) {
        ensure_capacity(values_, label, n);
        detail::fill_pairs(values_.data(), n, 1.0);
    } else if (values_.use_count() > 1) {  // a view of the old values keeps them
        const auto copy = allocate<double>(label, n);
        std::copy_n(values_.data(), n, copy.data());
        values_ = copy;
    }
    n_ = n;
    exists_ = true;
    values_(k) = value;
}

void PairCoupling::clear() noexcept {
    values_ = spare_ = pending_ = {};
    n_ = 0;
    exists_ = false;
}

void PairCoupling::drop() noexcept {
    if (!exists_) return clear();
    n_ = 0;
    exists_ = false;
}

void PairCoupling::prepare_remap(const ConstView<Offset>& new_to_old) {
    if (!exists_) return;
    n_pending_ = static_cast<Offset>(new_to_old.size());
    pending_ = detail::remapped<double>(label, values_.data(), 1, new_to_old);
}

void PairCoupling::commit_remap() noexcept {
    if (!exists_) return;
    values_ = pending_;
    pending_ = {};
    n_ = n_pending_;
}

}  // namespace connectivity
