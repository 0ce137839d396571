// SPDX-License-Identifier: BSD-3-Clause
#include "leaf_lists.hpp"

namespace connectivity::detail::device {

namespace {

template <class Exec, int Dim>
struct NarrowToLeaf {
    Problem<Dim> problem;
    const Slot* candidates;   // of the batch
    const Offset* of_blocks;  // where those of each block are, [n_blocks + 1]
    Offset first_block, first_leaf;
    Offset* offsets;  // of the first leaf; counts, where nothing is written
    Slot* slots;      // nullptr: count

    using Member = typename Teams<Exec>::member_type;

    KOKKOS_INLINE_FUNCTION void operator()(const Member& team, Offset item) const {
        const Offset l = first_leaf + item, b = problem.leaf_block[l];
        const Slot* const from = candidates + (of_blocks[b] - of_blocks[first_block]);
        const int n = static_cast<int>(of_blocks[b + 1] - of_blocks[b]);
        const Box<Dim> box = problem.leaf[l];
        if (slots == nullptr) {
            Offset found = 0;
            Kokkos::parallel_reduce(
                Kokkos::ThreadVectorRange(team, n),
                [&](int k, Offset& sum) { sum += is_near(box, from[k]) ? 1 : 0; }, found);
            Kokkos::single(Kokkos::PerThread(team), [&] { offsets[item] = found; });
        } else {
            Slot* const to = slots + (offsets[item] - offsets[0]);
            Kokkos::parallel_scan(Kokkos::ThreadVectorRange(team, n),
                                  [&](int k, Offset& sum, bool final) {
                                      if (!is_near(box, from[k])) return;
                                      if (final) to[sum] = from[k];
                                      ++sum;
                                  });
        }
    }

private:
    KOKKOS_INLINE_FUNCTION bool is_near(const Box<Dim>& box, Offset i) const {
        return problem.near(box, problem.box_of_slot(i));
    }
};

}  // namespace

template <class Exec, int Dim>
const Offset* LeafLists<Exec, Dim>::count(const Problem<Dim>& problem,
                                          const Candidates<Exec, Dim>& candidates,
                                          Offset first_block, Offset first_leaf, Offset last_leaf) {
    const Offset n = last_leaf - first_leaf;
    first_leaf_ = first_leaf;
    counted_ = offsets_.reserve("search/device/leaf_offsets", n + 1);
    for_each_vector<Exec>("search/device/leaves/count", n,
                          NarrowToLeaf<Exec, Dim>{problem, candidates.slots(), candidates.offsets(),
                                                  first_block, first_leaf, counted_, nullptr});
    make_offsets<Exec>("search/device/leaves/scan", counted_, n);
    return offsets_.fetch(n + 1);
}

template <class Exec, int Dim>
void LeafLists<Exec, Dim>::fill(const Problem<Dim>& problem,
                                const Candidates<Exec, Dim>& candidates, Offset first_block,
                                Offset first, Offset last) {
    filled_ = counted_ + (first - first_leaf_);
    if (slots_.data() == nullptr) return;  // no list has an entry
    for_each_vector<Exec>(
        "search/device/leaves/fill", last - first,
        NarrowToLeaf<Exec, Dim>{problem, candidates.slots(), candidates.offsets(), first_block,
                                first, counted_ + (first - first_leaf_), slots_.data()});
}

template class LeafLists<Kokkos::DefaultExecutionSpace, 1>;
template class LeafLists<Kokkos::DefaultExecutionSpace, 2>;
template class LeafLists<Kokkos::DefaultExecutionSpace, 3>;

}  // namespace connectivity::detail::device
