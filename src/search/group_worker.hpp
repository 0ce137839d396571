// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Finds the rows of a block of leaves: candidates once, one sort, lists narrowed for groups and
/// leaves, tests.
///
/// A range of leaves whose frame is not good enough for float tests, or which meets two periodic
/// images of one node, is split in two, down to single nodes. What is left after that is tested in
/// double, candidate by candidate. Cost for supports of one size: about 4 candidates and 6 vector
/// tests a node and neighbour row of 60.

#include "candidate_store.hpp"
#include "frame.hpp"
#include "kernels.hpp"
#include "row_sink.hpp"

namespace connectivity::detail {

/// What all workers of a sweep share.
template <int Dim>
struct GroupSweep {
    const SearchNodes<Dim>& nodes;
    const GroupOrder& order;
    const GroupBoxes<Dim>& boxes;
    const Kernels<Dim>& kernels;
    SearchMode mode;
    int label_bits;
    RowSink& sink;
};

/// Scratch memory of one thread; kept from build to build.
template <int Dim>
class GroupWorker {
public:
    struct Counters {
        Offset candidates = 0, doubts = 0, exact_nodes = 0;
    };

    /// Finds the rows of leaves [first, last) and hands them over. Throws Error{memory},
    /// std::bad_alloc, and what the sink throws.
    void process(const GroupSweep<Dim>& sweep, int worker, Offset first, Offset last);

    Counters counters;
    Offset bytes() const;

private:
    /// Nodes to be treated together: whole leaves, or one node of a leaf.
    struct Range {
        Offset first, last;
        int only;  // -1: all
    };

    void process(const Range& range);
    void split(const Range& range);
    bool find_candidates(const Frame<Dim>& frame, const Range& range);
    bool collect_image(const Frame<Dim>& frame, const FrameBox<Dim>& box,
                       const double (&image)[Dim]);
    void find_leaves(const ReachBox<Dim>& box);
    void test_groups(const Range& range, const Frame<Dim>& frame);
    void test_leaf(Offset leaf, int only, const Frame<Dim>& frame);
    void settle_doubts(const int* own, int words, int n_doubts);
    void keep_row(Slot slot, std::uint64_t* bits, int words, int place, RowSink::Wanted wanted);

    void process_exactly(const Range& range);

    ReachBox<Dim> box_of(const Range& range) const;
    FrameBox<Dim> inside(const Frame<Dim>& frame, const Range& range) const;
    bool is_wanted(const Range& range) const;

    const GroupSweep<Dim>* sweep_ = nullptr;
    Significance<Dim> see_{};
    PredicateData<Dim> predicate_{};
    Form form_ = Form::balls;
    int worker_ = 0;
    CandidateStore<Dim> found_, block_, group_, leaf_;
    LabelSort sort_;
    Buffer<int> leaves_;
    int n_leaves_ = 0;
    Buffer<std::uint64_t> bits_;
    Buffer<Doubt> doubts_;
};

extern template class GroupWorker<1>;
extern template class GroupWorker<2>;
extern template class GroupWorker<3>;

}  // namespace connectivity::detail
