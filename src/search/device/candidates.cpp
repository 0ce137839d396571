// SPDX-License-Identifier: BSD-3-Clause
#include "candidates.hpp"

#include "sort_segments.hpp"

namespace connectivity::detail::device {

namespace {

/// The candidates that a near block has for a block, leaf by leaf.
template <class Exec, int Dim>
struct CollectNearBlock {
    Problem<Dim> problem;
    const NearBlock* pairs;  // the first one of the batch
    Offset* offsets;         // of that one; counts, where nothing is written
    Slot* slots;             // nullptr: count

    using Member = typename Teams<Exec>::member_type;

    KOKKOS_INLINE_FUNCTION void operator()(const Member& team, Offset pair) const {
        const Offset near = pairs[pair].near;
        const Box<Dim> box = problem.node[problem.block_node[pairs[pair].block]];
        const Offset before = slots == nullptr ? 0 : offsets[pair] - offsets[0];
        Offset found = 0;
        for (Offset l = problem.block_leaf[near]; l < problem.block_leaf[near + 1]; ++l) {
            if (!problem.near(box, problem.leaf[l])) continue;
            if (slots != nullptr) collect(team, box, l, slots + before + found);
            found += count(team, box, l);
        }
        if (slots == nullptr)
            Kokkos::single(Kokkos::PerThread(team), [&] { offsets[pair] = found; });
    }

private:
    KOKKOS_INLINE_FUNCTION bool is_candidate(const Box<Dim>& box, Offset l, int k) const {
        return problem.slot[l * leaf_size + k] >= 0 && problem.near(box, problem.box_in_leaf(l, k));
    }
    KOKKOS_INLINE_FUNCTION int count(const Member& team, const Box<Dim>& box, Offset l) const {
        int n = 0;
        Kokkos::parallel_reduce(
            Kokkos::ThreadVectorRange(team, leaf_size),
            [&](int k, int& sum) { sum += is_candidate(box, l, k) ? 1 : 0; }, n);
        return n;
    }
    KOKKOS_INLINE_FUNCTION void collect(const Member& team, const Box<Dim>& box, Offset l,
                                        Slot* to) const {
        Kokkos::parallel_scan(Kokkos::ThreadVectorRange(team, leaf_size),
                              [&](int k, int& sum, bool final) {
                                  if (!is_candidate(box, l, k)) return;
                                  if (final) to[sum] = problem.slot[l * leaf_size + k];
                                  ++sum;
                              });
    }
};

/// Offsets by block from offsets by pair of near blocks.
struct OffsetsByBlock {
    const Offset* near_offsets;
    const Offset* pair_offsets;
    Offset* block_offsets;
    KOKKOS_INLINE_FUNCTION void operator()(Offset b) const {
        block_offsets[b] = pair_offsets[near_offsets[b]];
    }
};

/// One number from the memory of kernels.
template <class Exec>
Offset read(const Offset* at) {
    Offset value = 0;
    Kokkos::deep_copy(
        Kokkos::View<Offset, HostMemory, Kokkos::MemoryUnmanaged>(&value),
        Kokkos::View<const Offset, typename Exec::memory_space, Kokkos::MemoryUnmanaged>(at));
    return value;
}

}  // namespace

template <class Exec, int Dim>
const Offset* Candidates<Exec, Dim>::count(const Problem<Dim>& problem,
                                           const NearBlocks<Exec, Dim>& near) {
    ensure_capacity(pair_offsets_, "search/device/pair_offsets", near.n() + 1);
    Offset* const blocks =
        block_offsets_.reserve("search/device/candidate_offsets", problem.n_blocks + 1);
    for_each_vector<Exec>(
        "search/device/candidates/count", near.n(),
        CollectNearBlock<Exec, Dim>{problem, near.pairs(), pair_offsets_.data(), nullptr});
    make_offsets<Exec>("search/device/candidates/scan", pair_offsets_.data(), near.n());
    Kokkos::parallel_for("search/device/candidates/offsets", Items<Exec>(0, problem.n_blocks + 1),
                         OffsetsByBlock{near.offsets(), pair_offsets_.data(), blocks});
    offsets_ = blocks;
    host_offsets_ = block_offsets_.fetch(problem.n_blocks + 1);
    return host_offsets_;
}

template <class Exec, int Dim>
void Candidates<Exec, Dim>::fill(const Problem<Dim>& problem, const NearBlocks<Exec, Dim>& near,
                                 Offset first, Offset last) {
    if (host_offsets_[last] == host_offsets_[first]) return;
    const Offset pair = read<Exec>(near.offsets() + first), end = read<Exec>(near.offsets() + last);
    for_each_vector<Exec>("search/device/candidates/fill", end - pair,
                          CollectNearBlock<Exec, Dim>{problem, near.pairs() + pair,
                                                      pair_offsets_.data() + pair, slots_.data()});
    sort_segments<Exec>(last - first, offsets_ + first, slots_.data());
}

template class Candidates<Kokkos::DefaultExecutionSpace, 1>;
template class Candidates<Kokkos::DefaultExecutionSpace, 2>;
template class Candidates<Kokkos::DefaultExecutionSpace, 3>;

}  // namespace connectivity::detail::device
