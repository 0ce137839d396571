// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/lists/classes.hpp>

#include "guard.hpp"
#include "tree_objects.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

/// A list, and the boxes of its rows where they are not all boxes or levels.
struct ListAndRows {
    LevelBoxList list;
    ConstView<BoxId> row_boxes;
    bool is_none = false;
};

ListAndRows a_list(const BoxList& list, const ConstView<BoxId>& row_boxes = {}) {
    return {{list, {}, {}}, row_boxes};
}

ListAndRows perhaps(const std::optional<BoxList>& list, const ConstView<BoxId>& row_boxes = {}) {
    if (list) return a_list(*list, row_boxes);
    return {{}, {}, true};
}

/// A row for each level.
ListAndRows levels(const ConstView<BoxId>& boxes, const ConstView<Offset>& level_starts) {
    return a_list({level_starts, boxes, {}});
}

ListAndRows smaller(const FMMTraversalInfo& lists, int level) {
    const LevelBoxList list = lists.from_sep_smaller(level);
    return {list, list.target_boxes_sep_smaller};
}

ListAndRows list_of(const FMMTraversalInfo& lists, std::int32_t which, std::int32_t level) {
    const ConstView<BoxId> targets = lists.target_boxes(),
                           target_parents = lists.target_or_target_parent_boxes();
    switch (which) {
        case CONN_LIST_SOURCE_BOXES:
            return levels(lists.source_boxes(), lists.level_start_source_box_nrs());
        case CONN_LIST_TARGET_BOXES: return levels(targets, lists.level_start_target_box_nrs());
        case CONN_LIST_SOURCE_PARENT_BOXES:
            return levels(lists.source_parent_boxes(), lists.level_start_source_parent_box_nrs());
        case CONN_LIST_TARGET_OR_TARGET_PARENT_BOXES:
            return levels(target_parents, lists.level_start_target_or_target_parent_box_nrs());
        case CONN_LIST_SAME_LEVEL_NON_WELL_SEP_BOXES:
            return a_list(lists.same_level_non_well_sep_boxes());
        case CONN_LIST_COLLEAGUES: return perhaps(lists.colleagues());
        case CONN_LIST_NEIGHBOR_SOURCE_BOXES: return a_list(lists.neighbor_source_boxes(), targets);
        case CONN_LIST_FROM_SEP_SIBLINGS: return a_list(lists.from_sep_siblings(), target_parents);
        case CONN_LIST_FROM_SEP_SMALLER: return smaller(lists, level);
        case CONN_LIST_FROM_SEP_CLOSE_SMALLER:
            return perhaps(lists.from_sep_close_smaller(), targets);
        case CONN_LIST_FROM_SEP_BIGGER: return a_list(lists.from_sep_bigger(), target_parents);
        case CONN_LIST_FROM_SEP_CLOSE_BIGGER:
            return perhaps(lists.from_sep_close_bigger(), targets);
        default:
            throw Error(Status::argument,
                        "which = " + std::to_string(which) + ", must be one of CONN_LIST_*");
    }
}

struct ClassesPin final : Handle {
    ConstView<std::int32_t> classes, level_starts;
    ConstView<double> vectors, angles;

    const char* kind() const noexcept override { return "the owner of a classes view"; }
    void drop_views() noexcept override {
        classes = level_starts = {};
        vectors = angles = {};
    }
};

void take_translations(const FMMTraversalInfo& lists, bool per_level, ClassesPin& pin,
                       conn_classes_view& out) {
    const TranslationClassesInfo info(lists, per_level);
    pin.classes = info.from_sep_siblings_translation_classes();
    pin.level_starts = info.from_sep_siblings_translation_classes_level_starts();
    pin.vectors = info.from_sep_siblings_translation_class_to_distance_vector();
    out.n_classes = info.nfrom_sep_siblings_translation_classes();
    out.n_levels = per_level ? lists.nlevels() : 1;
}

void take_rotations(const FMMTraversalInfo& lists, ClassesPin& pin, conn_classes_view& out) {
    const RotationClassesInfo info(lists);
    pin.classes = info.from_sep_siblings_rotation_classes();
    pin.angles = info.from_sep_siblings_rotation_class_to_angle();
    out.n_classes = info.nfrom_sep_siblings_rotation_classes();
}

}  // namespace

void connectivity::capi::hand_over_list(const LevelBoxList& list, const ConstView<BoxId>& row_boxes,
                                        std::uint64_t generation, std::int32_t space,
                                        conn_box_list_view* view) {
    conn_box_list_view out = read_view(view, conn_box_list_view CONN_BOX_LIST_VIEW_INIT);
    auto pin = std::make_unique<BoxListPin>();
    pin->list = list;
    pin->row_boxes = row_boxes;
    out.n_rows = list.size();
    out.n_entries = list.count();
    out.generation = generation;
    out.space = space;
    out.starts = list.starts.data();
    out.lists = list.lists.data();
    out.images = list.images.data();
    out.row_boxes = row_boxes.data();
    out.nonempty_indices = list.nonempty_indices.data();
    write_view(view, out, std::move(pin));
}

conn_status conn_box_list_release(conn_box_list_view* view) {
    return guarded(__func__, [&] {
        release_view<BoxListPin>(view, conn_box_list_view CONN_BOX_LIST_VIEW_INIT);
    });
}

conn_status conn_lists_acquire(const conn_lists* lists, int32_t which, int32_t level, int32_t space,
                               conn_box_list_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_lists& ours = built_lists(lists);
        check_space(space);
        if (which != CONN_LIST_FROM_SEP_SMALLER && level != 0)
            throw Error(Status::argument, "level = " + std::to_string(level) +
                                              ", must be 0 but for CONN_LIST_FROM_SEP_SMALLER");
        const ListAndRows found = list_of(*ours.lists, which, level);
        if (!found.is_none)
            return hand_over_list(found.list, found.row_boxes, ours.generation, space, view);
        conn_box_list_view out = read_view(view, conn_box_list_view CONN_BOX_LIST_VIEW_INIT);
        out.is_none = 1;
        out.generation = ours.generation;
        out.space = space;
        write_view(view, out, std::make_unique<BoxListPin>());
    });
}

conn_status conn_lists_classes_acquire(const conn_lists* lists, int32_t which, int32_t space,
                                       conn_classes_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_lists& ours = built_lists(lists);
        check_space(space);
        if (which < CONN_CLASSES_TRANSLATION_PER_LEVEL || which > CONN_CLASSES_ROTATION)
            throw Error(Status::argument,
                        "which = " + std::to_string(which) + ", must be one of CONN_CLASSES_*");
        conn_classes_view out = read_view(view, conn_classes_view CONN_CLASSES_VIEW_INIT);
        auto pin = std::make_unique<ClassesPin>();
        if (which == CONN_CLASSES_ROTATION)
            take_rotations(*ours.lists, *pin, out);
        else
            take_translations(*ours.lists, which == CONN_CLASSES_TRANSLATION_PER_LEVEL, *pin, out);
        out.n_entries = static_cast<std::int64_t>(pin->classes.size());
        out.generation = ours.generation;
        out.dim = ours.lists->tree().dim;
        out.space = space;
        out.classes = pin->classes.data();
        out.level_starts = pin->level_starts.data();
        out.vectors = pin->vectors.data();
        out.angles = pin->angles.data();
        write_view(view, out, std::move(pin));
    });
}

conn_status conn_lists_classes_release(conn_classes_view* view) {
    return guarded(__func__, [&] {
        release_view<ClassesPin>(view, conn_classes_view CONN_CLASSES_VIEW_INIT);
    });
}
