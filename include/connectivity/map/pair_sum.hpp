// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Sums over pairs at their nodes: what each pair adds to its two ends, in three ways.
///
/// f(pair number k, slot i, slot j), i first in the pair, returns a PairContribution<T, n>: n
/// values for i and n for j. All three add it to out [n_slots * n], interleaved; set that first.
/// They differ in what they need, in cost, and in whether the order of a sum is fixed:
///
///   add_pairs_atomically  pairs only. Each pair evaluated once, n atomic additions a pair. Bits
///                         differ from run to run with more than one thread.
///   add_pairs_by_rows     rows, pairs and RowPairs (4 bytes an entry). Each pair evaluated at both
///                         ends, no atomics. Only stored, active nodes get their sum. Same bits
///                         for any number of threads: a sum runs along its row.
///   add_pairs_by_colours  pairs and PairColours. Each pair evaluated once, no atomics. Same bits
///                         for any number of threads: a sum runs through the colours. For hosts
///                         only.
///
/// f must not depend on the order of its calls, which come from several threads. Throw
/// Error{argument} if out has another size, Error{stale} if f reads a field of another pair list.
/// Complete when they return.

#include <type_traits>

#include <connectivity/map/pair_colours.hpp>
#include <connectivity/map/pairwise_field.hpp>
#include <connectivity/map/row_pairs.hpp>

namespace connectivity {

/// What a pair adds to its first and to its second node.
template <class T, int n = 1>
struct PairContribution {
    using value_type = T;
    static constexpr int n_components = n;
    T i[n], j[n];
};

/// Contributions that are stored: v to i and -v to j (forces), v to both, or of 2n values the
/// first half to i and the second to j.
enum class PairSymmetry { antisymmetric, symmetric, two_sided };

template <PairSymmetry symmetry, class T, int n, class Space>
struct StoredContribution {
    PairwiseFieldView<const T, symmetry == PairSymmetry::two_sided ? 2 * n : n, Space> field;

    Stamp stamp() const { return field.stamp; }
    KOKKOS_INLINE_FUNCTION PairContribution<T, n> operator()(Offset k, Slot, Slot) const {
        PairContribution<T, n> c;
        const T* const v = field.data() + k * (symmetry == PairSymmetry::two_sided ? 2 * n : n);
        for (int e = 0; e < n; ++e) {
            c.i[e] = v[e];
            if constexpr (symmetry == PairSymmetry::antisymmetric)
                c.j[e] = -v[e];
            else
                c.j[e] = v[symmetry == PairSymmetry::two_sided ? n + e : e];
        }
        return c;
    }
};

template <class T, int n, class Space>
auto antisymmetric(const PairwiseFieldView<T, n, Space>& field) {
    return StoredContribution<PairSymmetry::antisymmetric, std::remove_const_t<T>, n, Space>{field};
}
template <class T, int n, class Space>
auto symmetric(const PairwiseFieldView<T, n, Space>& field) {
    return StoredContribution<PairSymmetry::symmetric, std::remove_const_t<T>, n, Space>{field};
}
template <class T, int n, class Space>
auto two_sided(const PairwiseFieldView<T, n, Space>& field) {
    static_assert(n % 2 == 0, "a field of 2n values: n for each end");
    return StoredContribution<PairSymmetry::two_sided, std::remove_const_t<T>, n / 2, Space>{field};
}

namespace detail {
template <class F>
using Contribution = std::invoke_result_t<const F&, Offset, Slot, Slot>;
template <class F>
using ContributionValue = typename Contribution<F>::value_type;

template <class Exec>
using SumRange =
    Kokkos::RangePolicy<Exec, Kokkos::Schedule<Kokkos::Dynamic>, Kokkos::IndexType<Offset>>;

void check_pair_sum(Offset n_slots, int n_components, Offset n_out);
void check_pair_stamp(Stamp given, Stamp pairs, const char* what);

template <class F, class Out>
void check_pair_sum(const F& f, Offset n_slots, Stamp stamp, const Out& out) {
    check_pair_sum(n_slots, Contribution<F>::n_components, static_cast<Offset>(out.extent(0)));
    if constexpr (requires { f.stamp(); }) check_pair_stamp(f.stamp(), stamp, "a field");
}

template <class F, class Space>
struct AddAtomically {
    static constexpr int n = Contribution<F>::n_components;
    using T = ContributionValue<F>;
    NodePairList::View<Space> pairs;
    F f;
    T* out;

    KOKKOS_INLINE_FUNCTION void operator()(const Offset row) const {
        const Offset first = pairs.offsets(row), last = pairs.offsets(row + 1);
        if (first == last) return;
        const Slot i = pairs.node(row);
        T sum[n] = {};
        for (Offset k = first; k < last; ++k) {
            const Slot j = pairs.j(k);
            const auto c = f(k, i, j);
            for (int e = 0; e < n; ++e) {
                sum[e] += c.i[e];
                Kokkos::atomic_add(out + Offset{j} * n + e, c.j[e]);
            }
        }
        for (int e = 0; e < n; ++e) Kokkos::atomic_add(out + Offset{i} * n + e, sum[e]);
    }
};

template <class F, class Space>
struct AddByRows {
    static constexpr int n = Contribution<F>::n_components;
    using T = ContributionValue<F>;
    RowPairs::View<Space> of;
    F f;
    T* out;

    KOKKOS_INLINE_FUNCTION void operator()(const Offset row) const {
        const Slot a = of.slot(row);
        const Offset begin = of.rows.offsets(row * of.rows.n_lists),
                     end = of.rows.offsets((row + 1) * of.rows.n_lists);
        const Slot half = of.pairs.half_row(a);
        T sum[n] = {};
        for (Offset e = begin; e < end; ++e) {
            const Slot b = of.rows.slots(e);
            if (half < of.pairs.half_row(b)) {
                const auto c = f(of[e], a, b);
                for (int d = 0; d < n; ++d) sum[d] += c.i[d];
            } else {
                const auto c = f(of[e], b, a);
                for (int d = 0; d < n; ++d) sum[d] += c.j[d];
            }
        }
        for (int d = 0; d < n; ++d) out[Offset{a} * n + d] += sum[d];
    }
};

template <class F>
struct AddBlock {
    static constexpr int n = Contribution<F>::n_components;
    using T = ContributionValue<F>;
    NodePairList::View<> pairs;
    F f;
    T* out;
    const Slot* slots;
    const Offset* block_offset;

    void operator()(const Offset block) const {
        for (Offset s = block_offset[block]; s < block_offset[block + 1]; ++s) {
            const Slot i = slots[s];
            const Slot row = pairs.half_row(i);
            const Offset first = pairs.offsets(row), last = pairs.offsets(row + 1);
            if (first == last) continue;  // another block may be adding to this node
            T sum[n] = {};
            for (Offset k = first; k < last; ++k) {
                const Slot j = pairs.j(k);
                const auto c = f(k, i, j);
                for (int e = 0; e < n; ++e) {
                    sum[e] += c.i[e];
                    out[Offset{j} * n + e] += c.j[e];
                }
            }
            for (int e = 0; e < n; ++e) out[Offset{i} * n + e] += sum[e];
        }
    }
};
}  // namespace detail

template <class Exec, class Space, class F>
void add_pairs_atomically(const Exec& exec, const NodePairList::View<Space>& pairs, const F& f,
                          const View<detail::ContributionValue<F>, Space>& out) {
    detail::check_pair_sum(f, pairs.n_slots(), pairs.stamp, out);
    Kokkos::parallel_for("map/add_pairs/atomic",
                         detail::SumRange<Exec>(exec, 0, pairs.n_slots(), Kokkos::ChunkSize(64)),
                         detail::AddAtomically<F, Space>{pairs, f, out.data()});
    exec.fence();
}

template <class Exec, class Space, class F>
void add_pairs_by_rows(const Exec& exec, const RowPairs::View<Space>& rows, const F& f,
                       const View<detail::ContributionValue<F>, Space>& out) {
    detail::check_pair_sum(f, rows.pairs.n_slots(), rows.pairs.stamp, out);
    Kokkos::parallel_for("map/add_pairs/rows",
                         detail::SumRange<Exec>(exec, 0, rows.rows.n_rows(), Kokkos::ChunkSize(64)),
                         detail::AddByRows<F, Space>{rows, f, out.data()});
    exec.fence();
}

template <class F>
void add_pairs_by_colours(const HostExec& exec, const PairColours& colours,
                          const NodePairList::View<>& pairs, const F& f,
                          const View<detail::ContributionValue<F>>& out) {
    detail::check_pair_sum(f, pairs.n_slots(), pairs.stamp, out);
    detail::check_pair_stamp(colours.stamp(), pairs.stamp, "colours");
    const detail::AddBlock<F> add{pairs, f, out.data(), colours.slots().data(),
                                  colours.block_offset().data()};
    for (int c = 0; c < colours.n_colours(); ++c) {
        const auto at = static_cast<std::size_t>(c);
        Kokkos::parallel_for(
            "map/add_pairs/colour",
            detail::SumRange<HostExec>(exec, colours.colour_offset()[at],
                                       colours.colour_offset()[at + 1], Kokkos::ChunkSize(1)),
            add);
    }
    exec.fence();
}

}  // namespace connectivity
