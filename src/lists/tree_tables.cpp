// SPDX-License-Identifier: BSD-3-Clause
#include "tree_tables.hpp"

#include <atomic>
#include <cmath>
#include <string>

#include "chunks.hpp"

namespace connectivity::detail {
namespace {

[[noreturn]] void refuse(Status status, const std::string& what) {
    throw Error(status, "interaction lists: tree." + what);
}

template <class T>
void require_size(const char* name, const ConstView<T>& array, Offset n) {
    if (static_cast<Offset>(array.size()) < n)
        refuse(array.size() == 0 ? Status::null : Status::argument,
               std::string(name) + " has " + std::to_string(array.size()) + " elements, needs " +
                   std::to_string(n));
}

void check_sizes(const TreeView& t) {
    if (t.dim < 1 || t.dim > 3)
        refuse(Status::argument, "dim is " + std::to_string(t.dim) + ", must be 1, 2 or 3");
    if (t.n_boxes < 1 || t.n_boxes > max_slots)
        refuse(Status::argument,
               "n_boxes is " + std::to_string(t.n_boxes) + ", must be 1 to 2147483647");
    if (t.n_levels < 1 || t.n_levels > 255)
        refuse(Status::argument,
               "n_levels is " + std::to_string(t.n_levels) + ", must be 1 to 255");
    if (t.aligned_n_boxes < t.n_boxes)
        refuse(Status::argument, "aligned_n_boxes is " + std::to_string(t.aligned_n_boxes) +
                                     ", must be at least n_boxes = " + std::to_string(t.n_boxes));
    require_size("level_start_box_nrs", t.level_start_box_nrs, t.n_levels + 1);
    require_size("box_parent_ids", t.box_parent_ids, t.n_boxes);
    require_size("box_child_ids", t.box_child_ids, (Offset{1} << t.dim) * t.aligned_n_boxes);
    require_size("box_levels", t.box_levels, t.n_boxes);
    require_size("box_flags", t.box_flags, t.n_boxes);
}

void check_levels(const TreeView& t) {
    const auto& starts = t.level_start_box_nrs;
    if (starts(0) != 0 || starts(1) != 1 || starts(t.n_levels) != t.n_boxes)
        refuse(Status::argument, "level_start_box_nrs must begin with 0, 1 and end with n_boxes");
    for (int l = 0; l < t.n_levels; ++l)
        if (starts(l) > starts(l + 1))
            refuse(Status::argument, "level_start_box_nrs descends at level " + std::to_string(l));
    if (!std::isfinite(t.root_extent) || t.root_extent < 0 || !std::isfinite(t.stick_out_factor) ||
        t.stick_out_factor < 0)
        refuse(Status::argument, "root_extent is " + connectivity::number(t.root_extent) +
                                     ", stick_out_factor " +
                                     connectivity::number(t.stick_out_factor) +
                                     "; both must be finite and not negative");
}

bool is_in_level(const TreeView& t, Offset b, int level) {
    return level >= 0 && level < t.n_levels && b >= t.level_start_box_nrs(level) &&
           b < t.level_start_box_nrs(level + 1);
}

/// Lays out one box; what is wrong with it, or null.
const char* lay_out(const TreeTables& tables, BoxId b) {
    const TreeView& t = tables.tree;
    const int level = t.box_levels(b);
    if (!is_in_level(t, b, level)) return "box_levels does not go with level_start_box_nrs";
    unsigned mask = 0;
    for (int m = 0; m < tables.n_children; ++m) {
        const BoxId c = t.child(m, b);
        tables.children(Offset{b} * tables.n_children + m) = c;
        if (c == 0) continue;
        if (!is_in_level(t, c, level + 1)) return "box_child_ids names no box of the next level";
        if (t.box_parent_ids(c) != b) return "box_child_ids names a box with another parent";
        mask |= 1u << m;
    }
    tables.child_mask(b) = static_cast<std::uint8_t>(mask);
    tables.number(b) = 0;
    if (b == 0) return nullptr;
    const BoxId parent = t.box_parent_ids(b);
    if (!is_in_level(t, parent, level - 1)) return "box_parent_ids is no box of the level above";
    int n_found = 0;
    for (int m = 0; m < tables.n_children; ++m)
        if (t.child(m, parent) == b) {
            tables.number(b) = static_cast<std::uint8_t>(m);
            ++n_found;
        }
    if (n_found != 1) return "box_child_ids of its parent must name it exactly once";
    const auto flags = t.box_flags(b), above = t.box_flags(parent);
    if ((flags & source_flags) && !(above & box_flag::has_child_sources))
        return "box_flags has sources its parent's do not know of";
    if ((flags & target_flags) && !(above & box_flag::has_child_targets))
        return "box_flags has targets its parent's do not know of";
    return nullptr;
}

}  // namespace

TreeTables::TreeTables(const TreeView& view, TableScratch& scratch)
    : tree(view), n_children(1 << view.dim) {
    check_sizes(view);
    check_levels(view);
    ensure_capacity(scratch.children, "lists/children", view.n_boxes * n_children);
    ensure_capacity(scratch.child_mask, "lists/child_mask", view.n_boxes);
    ensure_capacity(scratch.number, "lists/child_number", view.n_boxes);
    children = scratch.children;
    child_mask = scratch.child_mask;
    number = scratch.number;
    std::atomic<Offset> worst{view.n_boxes};
    for_each_chunk("lists/tables", view.n_boxes, 4096, [&](Offset, Offset first, Offset last) {
        for (Offset b = first; b < last; ++b)
            if (lay_out(*this, static_cast<BoxId>(b)) != nullptr) {
                Offset known = worst.load();
                while (b < known && !worst.compare_exchange_weak(known, b)) {
                }
                return;
            }
    });
    if (const auto b = static_cast<BoxId>(worst.load()); b < view.n_boxes)
        refuse(Status::argument, std::string(lay_out(*this, b)) + ": box " + std::to_string(b));
}

}  // namespace connectivity::detail
