// SPDX-License-Identifier: BSD-3-Clause
#include "near_blocks.hpp"

namespace connectivity::detail::device {

namespace {

template <int Dim>
struct Walk {
    Problem<Dim> problem;
    Offset* offsets;   // counts, where nothing is written
    NearBlock* pairs;  // nullptr: count

    KOKKOS_INLINE_FUNCTION void operator()(Offset b) const {
        Offset found = 0;
        if (problem.wanted[b] != 0)
            for (int t = 0; t < problem.n_trees; ++t)
                found += walk(b, problem.tree[t], pairs == nullptr ? 0 : offsets[b] + found);
        if (pairs == nullptr) offsets[b] = found;
    }

private:
    KOKKOS_INLINE_FUNCTION Offset walk(Offset b, const ClassTree& tree, Offset to) const {
        const Box<Dim> box = problem.node[problem.block_node[b]];
        Offset stack[64], found = 0;
        int depth = 0;
        stack[depth++] = 1;
        while (depth > 0) {
            const Offset k = stack[--depth];
            if (!problem.near(box, problem.node[tree.first_node + k])) continue;
            if (k < tree.n_blocks) {
                stack[depth++] = 2 * k + 1;
                stack[depth++] = 2 * k;
                continue;
            }
            if (pairs != nullptr)
                pairs[to + found] = {static_cast<Slot>(b),
                                     static_cast<Slot>(tree.first_block + k - tree.n_blocks)};
            ++found;
        }
        return found;
    }
};

}  // namespace

template <class Exec, int Dim>
void NearBlocks<Exec, Dim>::find(const Problem<Dim>& problem) {
    ensure_capacity(offsets_, "search/device/near_offsets", problem.n_blocks + 1);
    const Items<Exec> blocks(0, problem.n_blocks);
    Kokkos::parallel_for("search/device/near/count", blocks,
                         Walk<Dim>{problem, offsets_.data(), nullptr});
    n_ = make_offsets<Exec>("search/device/near/scan", offsets_.data(), problem.n_blocks);
    ensure_capacity(pairs_, "search/device/near_blocks", n_);
    if (n_ > 0)
        Kokkos::parallel_for("search/device/near/fill", blocks,
                             Walk<Dim>{problem, offsets_.data(), pairs_.data()});
}

template class NearBlocks<Kokkos::DefaultExecutionSpace, 1>;
template class NearBlocks<Kokkos::DefaultExecutionSpace, 2>;
template class NearBlocks<Kokkos::DefaultExecutionSpace, 3>;

}  // namespace connectivity::detail::device
