// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>

#include "arguments.hpp"
#include "guard.hpp"
#include "objects.hpp"
#include "tree_objects.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

conn_lists& handle_of(conn_lists* lists) {
    return Registry::instance().get<conn_lists>(lists, "lists");
}

std::optional<FromSepSmallerCrit> read_crit(std::int32_t crit) {
    switch (crit) {
        case CONN_CRIT_DEFAULT: return {};
        case CONN_CRIT_STATIC_LINF: return FromSepSmallerCrit::static_linf;
        case CONN_CRIT_PRECISE_LINF: return FromSepSmallerCrit::precise_linf;
        case CONN_CRIT_STATIC_L2: return FromSepSmallerCrit::static_l2;
        default:
            throw Error(Status::argument,
                        "options->from_sep_smaller_crit = " + std::to_string(crit) +
                            ", must be one of CONN_CRIT_*");
    }
}

ConstView<std::uint8_t> read_mask(const std::uint8_t* mask, std::int64_t n) {
    if (mask == nullptr) return {};
    const auto copy = allocate<std::uint8_t>("capi/mask", n);
    std::copy_n(mask, n, copy.data());
    return copy;
}

void read_masks(const conn_lists_options& o, Offset n_boxes, TraversalOptions& options) {
    const bool has_mask = o.source_boxes_mask != nullptr || o.source_parent_boxes_mask != nullptr;
    const Offset expected = has_mask ? n_boxes : 0;
    if (o.n_mask != expected)
        throw Error(Status::argument,
                    "options->n_mask = " + std::to_string(o.n_mask) + ", must be " +
                        std::to_string(expected) +
                        (has_mask ? ", the boxes of the tree" : " where there are no masks"));
    options.source_boxes_mask = read_mask(o.source_boxes_mask, o.n_mask);
    options.source_parent_boxes_mask = read_mask(o.source_parent_boxes_mask, o.n_mask);
}

TraversalOptions read_options(const conn_lists_options* given, Offset n_boxes,
                              std::int64_t context_budget) {
    conn_lists_options o = CONN_LISTS_OPTIONS_INIT;
    if (given != nullptr) o = read_struct(given, o, "options");
    check_reserved(o.reserved, "options");
    TraversalOptions options;
    options.well_sep_is_n_away = o.well_sep_is_n_away;
    options.from_sep_smaller_crit = read_crit(o.from_sep_smaller_crit);
    options.from_sep_smaller_min_nsources_cumul = o.from_sep_smaller_min_nsources_cumul;
    const auto flag = [](std::int32_t value, const char* name) {
        return read_flag(value, std::string("options->") + name);
    };
    options.same_level_non_well_sep_boxes =
        flag(o.same_level_non_well_sep_boxes, "same_level_non_well_sep_boxes");
    options.neighbor_source_boxes = flag(o.neighbor_source_boxes, "neighbor_source_boxes");
    options.from_sep_siblings = flag(o.from_sep_siblings, "from_sep_siblings");
    options.from_sep_smaller = flag(o.from_sep_smaller, "from_sep_smaller");
    options.from_sep_bigger = flag(o.from_sep_bigger, "from_sep_bigger");
    read_masks(o, n_boxes, options);
    options.budget.bytes = read_budget(o.budget_bytes, context_budget);
    return options;
}

}  // namespace

const conn_lists& connectivity::capi::built_lists(const conn_lists* lists) {
    const auto& ours = Registry::instance().get<const conn_lists>(lists, "lists");
    if (ours.generation == 0)
        throw Error(Status::not_built, "lists were never built; call conn_lists_rebuild first");
    return ours;
}

conn_status conn_lists_options_init(conn_lists_options* options, size_t size) {
    return guarded(__func__, [&] {
        init_struct(options, size, conn_lists_options CONN_LISTS_OPTIONS_INIT, "options");
    });
}

conn_status conn_lists_create(conn_context* context, conn_lists** lists) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<conn_context>(context, "context");
        required(lists, "lists") =
            Registry::instance().add(std::make_unique<conn_lists>(ours.budget_bytes));
    });
}

conn_status conn_lists_destroy(conn_lists** lists) {
    return guarded(__func__, [&] { Registry::instance().destroy(lists, "lists"); });
}

conn_status conn_lists_rebuild(conn_lists* lists, const conn_tree* tree,
                               const conn_lists_options* options) {
    return guarded_with_runtime(__func__, [&] {
        conn_lists& ours = handle_of(lists);
        const conn_tree& from = built_tree(tree);
        ours.lists->rebuild(from.view(),
                            read_options(options, from.view().n_boxes, ours.context_budget));
        ours.work.reset();
        ours.generation = from.generation;
    });
}

conn_status conn_lists_merge_close(conn_lists* lists) {
    return guarded_with_runtime(__func__, [&] {
        conn_lists& ours = handle_of(lists);
        built_lists(lists);
        *ours.lists = ours.lists->merge_close_lists();
        ours.work.reset();
    });
}

conn_status conn_lists_report_text(const conn_lists* lists, char* text, int64_t capacity,
                                   int64_t* length) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<const conn_lists>(lists, "lists");
        copy_text_out(ours.lists->report().text(), text, capacity, length);
    });
}

conn_status conn_lists_work(const conn_lists* lists, int32_t kind, int64_t* counts,
                            int64_t capacity, int64_t* n, int64_t* total) {
    static constexpr Offset Work::*kinds[] = {&Work::p2p,
                                              &Work::p2p_close,
                                              &Work::m2l,
                                              &Work::m2p,
                                              &Work::p2l,
                                              &Work::p2m,
                                              &Work::l2p,
                                              &Work::m2m,
                                              &Work::l2l,
                                              &Work::from_sep_smaller_entries,
                                              &Work::from_sep_bigger_entries};
    return guarded_with_runtime(__func__, [&] {
        const conn_lists& ours = built_lists(lists);
        if (kind < CONN_WORK_P2P || kind > CONN_WORK_FROM_SEP_BIGGER_ENTRIES)
            throw Error(Status::argument,
                        "kind = " + std::to_string(kind) + ", must be one of CONN_WORK_*");
        required(n, "n");
        if (!ours.work) ours.work = count_work(*ours.lists);
        *n = ours.lists->nboxes();
        if (total != nullptr) *total = ours.work->total.*kinds[kind];
        if (counts == nullptr) return;
        check_capacity(capacity, *n);
        for (Offset b = 0; b < *n; ++b) counts[b] = ours.work->boxes(b).*kinds[kind];
    });
}
