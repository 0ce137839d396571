// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// One build of interaction lists: everything that can fail first, then a fill that cannot.
///
/// Cost: every walk is made twice, to count and to fill; besides the lists it needs the near rows,
/// 16 bytes a target box, and 16 bytes for each level and 256 target boxes, all of it scratch.

#include <string>
#include <vector>

#include "state.hpp"

namespace connectivity::detail {

class TraversalBuild {
public:
    /// Checks options and tree, and finds what is near. Throws Error.
    TraversalBuild(const TreeView& tree, const TraversalOptions& options, BuildScratch& scratch);

    /// Counts, checks the budget, and takes the storage that the lists need. Throws Error; then
    /// the state is as it was.
    void prepare(TraversalState& state);
    /// Fills and publishes what was prepared: overwrites the old lists, and needs no memory.
    void commit(TraversalState& state);

private:
    struct Plan {
        const char* name;
        bool wanted;
        Offset bytes, entries;
    };
    static constexpr Offset chunk = 256;  ///< target boxes

    void find_bases();
    void count_targets();
    void prepare_lists(TraversalState& state);
    void prepare_smaller(SmallerLists& smaller);
    void check_budget() const;
    void reserve(TraversalState& state);
    void make_report();

    void fill_bases(BaseLists& base) const;
    void fill_same_level(BoxRows& rows) const;
    void fill_siblings(BoxRows& rows) const;
    void fill_bigger(BoxRows& rows) const;
    void fill_close_bigger(BoxRows& rows) const;
    void fill_targets(TraversalState& state);
    void publish(TraversalState& state);

    template <class Count>
    void plan(const char* name, bool wanted, BoxRows& rows, Offset n_rows, const Count& count) {
        const Offset bytes = wanted ? rows.prepare(n_rows, periodic_, count) : 0;
        plans_.push_back({name, wanted, bytes, wanted ? rows.n_prepared() : 0});
    }
    Offset n_levels() const { return tables_.tree.n_levels; }
    Offset n_targets() const { return scratch_.targets.size(); }
    BoxId target(Offset i) const { return scratch_.targets[i]; }
    BoxId target_parent(Offset i) const { return scratch_.target_parents[i]; }
    std::size_t cell(Offset of_chunk, Offset level) const {
        return static_cast<std::size_t>(of_chunk * n_levels() + level);
    }

    Stopwatch watch_;  // the first member: it times the making of the others
    BuildScratch& scratch_;
    TraversalOptions options_;
    TreeTables tables_;
    Separation separation_;
    NearRows near_;
    bool periodic_ = false, has_close_ = false;
    std::vector<Plan> plans_;
    Report report_;
    double ms_near_ = 0, ms_count_ = 0;
    std::string walk_label_ = "lists/targets/fill";
};

}  // namespace connectivity::detail
