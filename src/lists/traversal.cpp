// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/lists/traversal.hpp>

#include <limits>
#include <string>
#include <utility>

#include <connectivity/base/runtime.hpp>

#include "traversal_build.hpp"

namespace connectivity {

using detail::TraversalState;

namespace {

using Hull = std::optional<ConstView<double>>;

BoxList asked(const detail::BoxRows& rows, bool wanted, const char* name) {
    if (!wanted)
        throw Error(Status::not_built,
                    std::string(name) + " was not asked for in the last build of the traversal");
    return rows.view();
}

}  // namespace

FMMTraversalInfo::FMMTraversalInfo() : state_(std::make_unique<TraversalState>()) {
    TraversalOptions& options = state_->options;  // of nothing there are no lists
    options.same_level_non_well_sep_boxes = options.neighbor_source_boxes =
        options.from_sep_siblings = options.from_sep_smaller = options.from_sep_bigger = false;
}
FMMTraversalInfo::FMMTraversalInfo(const TreeView& tree, const TraversalOptions& options)
    : FMMTraversalInfo() {
    rebuild(tree, options);
}
FMMTraversalInfo::FMMTraversalInfo(const FMMTraversalInfo& other)
    : state_(std::make_unique<TraversalState>(*other.state_)) {
    release_scratch();
}
FMMTraversalInfo::FMMTraversalInfo(FMMTraversalInfo&& other) noexcept = default;
FMMTraversalInfo& FMMTraversalInfo::operator=(FMMTraversalInfo other) noexcept {
    std::swap(state_, other.state_);
    return *this;
}
FMMTraversalInfo::~FMMTraversalInfo() = default;

void FMMTraversalInfo::rebuild(const TreeView& tree, const TraversalOptions& options) {
    run_kernels("lists", [&] {  // short: outside of it a name that needs memory is no Error
        const shim::ProfilingRegion region("lists/rebuild");
        try {
            detail::TraversalBuild build(tree, options, state_->scratch);
            build.prepare(*state_);
            build.commit(*state_);
        } catch (...) {
            release_scratch();  // it may be what there was no memory for
            throw;
        }
    });
}

Offset FMMTraversalInfo::scratch_bytes() const { return state_->scratch.bytes(); }
void FMMTraversalInfo::release_scratch() {
    state_->scratch = {};
    if (state_->built) state_->report.entry("scratch").bytes = 0;
}

const TreeView& FMMTraversalInfo::tree() const { return state_->tree; }
int FMMTraversalInfo::well_sep_is_n_away() const { return state_->options.well_sep_is_n_away; }
const Budget& FMMTraversalInfo::budget() const { return state_->options.budget; }
const Report& FMMTraversalInfo::report() const { return state_->report; }

ConstView<BoxId> FMMTraversalInfo::source_boxes() const { return state_->base.sources.values(); }
ConstView<BoxId> FMMTraversalInfo::target_boxes() const { return state_->base.targets.values(); }
ConstView<BoxId> FMMTraversalInfo::source_parent_boxes() const {
    return state_->base.source_parents.values();
}
ConstView<BoxId> FMMTraversalInfo::target_or_target_parent_boxes() const {
    return state_->base.target_parents.values();
}
ConstView<Offset> FMMTraversalInfo::level_start_source_box_nrs() const {
    return state_->base.sources.offsets();
}
ConstView<Offset> FMMTraversalInfo::level_start_target_box_nrs() const {
    return state_->base.targets.offsets();
}
ConstView<Offset> FMMTraversalInfo::level_start_source_parent_box_nrs() const {
    return state_->base.source_parents.offsets();
}
ConstView<Offset> FMMTraversalInfo::level_start_target_or_target_parent_box_nrs() const {
    return state_->base.target_parents.offsets();
}
Offset FMMTraversalInfo::ntarget_boxes() const { return state_->base.targets.n_values(); }
Offset FMMTraversalInfo::ntarget_or_target_parent_boxes() const {
    return state_->base.target_parents.n_values();
}

Hull FMMTraversalInfo::box_source_bounding_box_min() const {
    const TreeParticles& sources = tree().sources;
    return sources.have_extent() ? Hull(sources.bounding_box_min) : Hull();
}
Hull FMMTraversalInfo::box_source_bounding_box_max() const {
    const TreeParticles& sources = tree().sources;
    return sources.have_extent() ? Hull(sources.bounding_box_max) : Hull();
}
Hull FMMTraversalInfo::box_target_bounding_box_min() const {
    const TreeParticles& targets = tree().targets;
    return targets.have_extent() ? Hull(targets.bounding_box_min) : Hull();
}
Hull FMMTraversalInfo::box_target_bounding_box_max() const {
    const TreeParticles& targets = tree().targets;
    return targets.have_extent() ? Hull(targets.bounding_box_max) : Hull();
}

bool FMMTraversalInfo::has_same_level_non_well_sep_boxes() const {
    return state_->options.same_level_non_well_sep_boxes;
}
bool FMMTraversalInfo::has_neighbor_source_boxes() const {
    return state_->options.neighbor_source_boxes;
}
bool FMMTraversalInfo::has_from_sep_siblings() const { return state_->options.from_sep_siblings; }
bool FMMTraversalInfo::has_from_sep_smaller() const { return state_->options.from_sep_smaller; }
bool FMMTraversalInfo::has_from_sep_bigger() const { return state_->options.from_sep_bigger; }

BoxList FMMTraversalInfo::same_level_non_well_sep_boxes() const {
    return asked(state_->same_level, has_same_level_non_well_sep_boxes(),
                 "same_level_non_well_sep_boxes");
}
std::optional<BoxList> FMMTraversalInfo::colleagues() const {
    if (well_sep_is_n_away() != 1) return {};
    return same_level_non_well_sep_boxes();
}
BoxList FMMTraversalInfo::neighbor_source_boxes() const {
    return asked(state_->neighbors, has_neighbor_source_boxes(), "neighbor_source_boxes");
}
BoxList FMMTraversalInfo::from_sep_siblings() const {
    return asked(state_->siblings, has_from_sep_siblings(), "from_sep_siblings");
}
BoxList FMMTraversalInfo::from_sep_bigger() const {
    return asked(state_->bigger, has_from_sep_bigger(), "from_sep_bigger");
}
std::optional<BoxList> FMMTraversalInfo::from_sep_close_smaller() const {
    if (!state_->has_close) return {};
    return asked(state_->close_smaller, has_from_sep_smaller(), "from_sep_close_smaller");
}
std::optional<BoxList> FMMTraversalInfo::from_sep_close_bigger() const {
    if (!state_->has_close) return {};
    return asked(state_->close_bigger, has_from_sep_bigger(), "from_sep_close_bigger");
}

LevelBoxList FMMTraversalInfo::from_sep_smaller(int source_level) const {
    if (!has_from_sep_smaller())
        throw Error(Status::not_built,
                    "from_sep_smaller was not asked for in the last build of the traversal");
    if (source_level < 0 || source_level >= nlevels())
        throw Error(Status::argument, "from_sep_smaller: source_level is " +
                                          std::to_string(source_level) + ", must be 0 to " +
                                          std::to_string(nlevels() - 1));
    const detail::SmallerLists& smaller = state_->smaller;
    const Offset* const rows = smaller.indices.offset_data() + source_level;
    const std::pair<Offset, Offset> range(rows[0], rows[1]);
    return {smaller.levels[static_cast<std::size_t>(source_level)].view(),
            Kokkos::subview(smaller.indices.values(), range),
            Kokkos::subview(smaller.targets.values(), range)};
}

View<BoxId> starts_as_box_ids(const ConstView<Offset>& starts) {
    if (starts.size() > 0 && starts(starts.size() - 1) > max_slots)
        throw Error(Status::too_many,
                    "a list of " + std::to_string(starts(starts.size() - 1)) +
                        " entries has starts beyond 2147483647, the largest of 32 bits");
    auto copy = allocate<BoxId>("lists/starts", static_cast<Offset>(starts.size()));
    for (std::size_t i = 0; i < starts.size(); ++i) copy(i) = static_cast<BoxId>(starts(i));
    return copy;
}

}  // namespace connectivity
