// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Laws that hold for the lists of any tree: every target meets every source exactly once.

#include <cstdlib>

#include <gtest/gtest.h>

#include "lists/brute_lists.hpp"

namespace connectivity::test {

using Rows = std::map<BoxId, Row>;

/// Random cases to try: CONNECTIVITY_LIST_CASES, or what is usual.
inline int n_cases(int usual) {
    const char* const told = std::getenv("CONNECTIVITY_LIST_CASES");
    return told != nullptr ? std::atoi(told) : usual;
}

/// How often the own sources of every (box, image) reach the own targets of every box.
class Coverage {
public:
    Coverage(const FMMTraversalInfo& lists, const Rows& smaller_of) : tree_(lists.tree()) {
        add_tree(lists);
        const auto targets = lists.target_boxes();
        for (Offset i = 0; i < lists.ntarget_boxes(); ++i) {
            auto& reached = reached_[targets(i)];
            const auto add = [&](const BoxList& list) {
                for (const Entry& e : row_of(list, i)) ++reached[e];
            };
            add(lists.neighbor_source_boxes());
            if (const auto close = lists.from_sep_close_smaller()) add(*close);
            if (const auto close = lists.from_sep_close_bigger()) add(*close);
            for (const Entry& e : smaller_of.at(targets(i))) add_below(e, reached);
            for (BoxId b = targets(i);; b = tree_.box_parent_ids(b)) {
                for (const auto& [e, n] : locals_[b]) reached[e] += n;
                if (b == 0) break;
            }
        }
    }

    int times(BoxId target, const Entry& source) const {
        const auto row = reached_.find(target);
        if (row == reached_.end()) return 0;
        const auto at = row->second.find(source);
        return at == row->second.end() ? 0 : at->second;
    }
    std::size_t n_reached(BoxId target) const {
        const auto row = reached_.find(target);
        return row == reached_.end() ? 0 : row->second.size();
    }

private:
    using Counts = std::map<Entry, int>;

    void add_below(const Entry& e, Counts& counts) const {
        if (tree_.box_flags(e.box) & 1) ++counts[e];
        for (int m = 0; m < 1 << tree_.dim; ++m)
            if (const BoxId c = tree_.child(m, e.box); c != 0) add_below({c, e.image}, counts);
    }
    /// Lists 2 and 4: local expansions.
    void add_tree(const FMMTraversalInfo& lists) {
        const auto boxes = lists.target_or_target_parent_boxes();
        for (Offset i = 0; i < lists.ntarget_or_target_parent_boxes(); ++i) {
            Counts& counts = locals_[boxes(i)];
            for (const Entry& e : row_of(lists.from_sep_siblings(), i)) add_below(e, counts);
            for (const Entry& e : row_of(lists.from_sep_bigger(), i)) ++counts[e];
        }
    }

    TreeView tree_;
    std::map<BoxId, Counts> reached_, locals_;
};

inline void expect_coverage(const FMMTraversalInfo& lists, const Rows& smaller_of,
                            const std::vector<ImageCode>& images) {
    const Coverage coverage(lists, smaller_of);
    for (Offset i = 0; i < lists.ntarget_boxes(); ++i) {
        const BoxId t = lists.target_boxes()(i);
        for (Offset j = 0; j < static_cast<Offset>(lists.source_boxes().size()); ++j)
            for (const ImageCode image : images)
                ASSERT_EQ(coverage.times(t, {lists.source_boxes()(j), image}), 1)
                    << "target box " << t << ", source box " << lists.source_boxes()(j)
                    << ", image " << int{image};
        ASSERT_EQ(coverage.n_reached(t), lists.source_boxes().size() * images.size());
    }
}

/// The kernel that is 1 everywhere: every target receives the number of sources.
inline void expect_constant_one(const FMMTraversalInfo& lists, const Rows& smaller_of,
                                std::size_t n_images) {
    const TreeView& tree = lists.tree();
    std::vector<Offset> potential(tree.n_boxes);
    const auto &own = tree.sources.box_counts_nonchild, &below = tree.sources.box_counts_cumul;
    const auto boxes = lists.target_or_target_parent_boxes();
    for (Offset i = 0; i < lists.ntarget_or_target_parent_boxes(); ++i) {
        Offset& local = potential[boxes(i)];
        if (boxes(i) != 0) local = potential[tree.box_parent_ids(boxes(i))];
        for (const BoxId s : lists.from_sep_siblings()[i]) local += below(s);
        for (const BoxId s : lists.from_sep_bigger()[i]) local += own(s);
    }
    const FMMTraversalInfo merged = lists.merge_close_lists();
    const Offset wanted = tree.sources.n * static_cast<Offset>(n_images);
    for (Offset i = 0; i < lists.ntarget_boxes(); ++i) {
        const BoxId t = lists.target_boxes()(i);
        Row joined = row_of(lists.neighbor_source_boxes(), i);
        for (const auto& close : {lists.from_sep_close_smaller(), lists.from_sep_close_bigger()})
            if (close)
                for (const Entry& e : row_of(*close, i)) joined.push_back(e);
        ASSERT_EQ(row_of(merged.neighbor_source_boxes(), i), joined) << "target box " << t;
        Offset sum = potential[t];
        for (const BoxId s : merged.neighbor_source_boxes()[i]) sum += own(s);
        for (const Entry& e : smaller_of.at(t)) sum += below(e.box);
        ASSERT_EQ(sum, wanted) << "target box " << t;
    }
}

}  // namespace connectivity::test
