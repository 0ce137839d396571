// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/search/search.hpp>

#include "cells.hpp"
#include "device/device_search.hpp"
#include "direct.hpp"
#include "groups.hpp"

namespace connectivity {

const char* name_of(SearchMethod method) {
    switch (method) {
        case SearchMethod::automatic: return "automatic";
        case SearchMethod::brute: return "brute";
        case SearchMethod::cells: return "cells";
        case SearchMethod::groups: return "groups";
        case SearchMethod::device: return "device";
    }
    return "unknown";
}

template <int Dim>
struct Search<Dim>::State {
    detail::GroupSearch<Dim> groups;
    detail::DeviceSearch<Dim> device;

    Offset scratch_bytes() const { return groups.scratch_bytes() + device.bytes(); }
};

template <int Dim>
Search<Dim>::Search() : state_(std::make_unique<State>()) {}
template <int Dim>
Search<Dim>::~Search() = default;
template <int Dim>
Search<Dim>::Search(Search&&) noexcept = default;
template <int Dim>
Search<Dim>& Search<Dim>::operator=(Search&&) noexcept = default;

namespace {

struct Choice {
    SearchMethod method;
    std::string reason;
};

/// Does the device search run on what is no host?
constexpr bool has_device = !detail::device::is_host<Kokkos::DefaultExecutionSpace>;

/// Brute force while a block of the group search would hold all nodes anyway; groups beyond: cells
/// never overtook them. A device, where there is one, once its dozens of launches and copies cost
/// less than the search itself.
Choice choose(SearchMethod asked, Offset n) {
    constexpr Offset few = 48, enough_for_device = 10000;
    if (asked != SearchMethod::automatic)
        return {asked, std::string(name_of(asked)) + ": asked for"};
    if (n <= few)
        return {SearchMethod::brute, "brute: " + std::to_string(n) + " nodes, at most " +
                                         std::to_string(few) + " are tested all with all"};
    if (has_device && n >= enough_for_device)
        return {SearchMethod::device, "device: " + std::to_string(n) + " nodes, at least " +
                                          std::to_string(enough_for_device) + ", and Kokkos has " +
                                          Kokkos::DefaultExecutionSpace::name()};
    return {SearchMethod::groups,
            "groups: " + std::to_string(n) + " nodes, more than " + std::to_string(few)};
}

/// A traversal keeps no rows, and a device has no other way to hand them over.
Choice choose_traversal(SearchMethod asked, Offset n) {
    const Choice choice = choose(asked, n);
    if (choice.method != SearchMethod::device) return choice;
    return {SearchMethod::groups, "groups: a device cannot hand over rows that are not stored"};
}

void announce(Report& report, const char* product, const char* asked_by,
              const std::string& reason) {
    const bool asked = *asked_by != 0;
    report.entry(product) = {product, asked_by, asked ? reason : "", asked, false, 0, 0};
}

}  // namespace

template <int Dim>
void Search<Dim>::run(const SearchNodes<Dim>& nodes, const SlotLayout& layout,
                      const SearchRequest& request, Csr& rows, Csr& half_rows, Report& report) {
    const detail::Products products{rows, half_rows};
    const Choice choice = choose(request.method, nodes.n);
    const bool device = choice.method == SearchMethod::device,
               ordered = device || choice.method == SearchMethod::groups;
    auto& group_search = state_->groups;
    const Offset scratch_before = state_->scratch_bytes();

    // Entries are made before the work: nothing may fail once the new lists are out.
    announce(report, "rows", request.rows ? "caller" : "", choice.reason);
    announce(report, "pairs", request.half_rows ? "caller" : "",
             request.rows ? "found with the rows" : choice.reason);
    announce(report, "scratch", ordered ? "search" : "",
             device ? "nodes, candidates and lists of the kernels"
                    : "rows wait here until all are counted");
    if (ordered && !request.ordered) group_search.update_order(nodes, report);
    if (!ordered && !request.ordered) announce(report, "order", "", "");

    const Stopwatch watch;
    switch (choice.method) {
        case SearchMethod::brute:
            detail::DirectBuild<Dim, detail::AllNodes>({nodes.n}, nodes, layout, request)
                .run(products);
            break;
        case SearchMethod::cells: {
            const detail::Cells<Dim> cells(nodes);
            detail::DirectBuild<Dim, detail::Cells<Dim>>(cells, nodes, layout, request)
                .run(products);
            break;
        }
        case SearchMethod::device:
            state_->device.run(nodes, group_search.order(), layout, request, products, report);
            break;
        default: group_search.run(nodes, layout, request, products, report);
    }
    if (!request.rows) rows.clear();
    if (!request.half_rows) half_rows.clear();
    if (request.rows || request.half_rows)
        report.entry(request.rows ? "rows" : "pairs").ms = watch.ms();
    report.entry("rows").bytes = rows.bytes();
    report.entry("pairs").bytes = half_rows.bytes();
    report.entry("order").bytes = group_search.order_bytes();
    report.entry("scratch").bytes = state_->scratch_bytes();
    report.entry("scratch").reused = state_->scratch_bytes() == scratch_before && ordered;
}

template <int Dim>
void Search<Dim>::visit(const SearchNodes<Dim>& nodes, const SlotLayout& layout,
                        const SearchRequest& request, RowFunction f, Report& report) {
    const Choice choice = choose_traversal(request.method, nodes.n);
    auto& group_search = state_->groups;
    // Entries are made before the work: the host has seen all rows when it ends.
    announce(report, "traversal", "caller", choice.reason);
    for (const char* held : {"order", "scratch"}) report.entry(held);
    const Stopwatch watch;
    if (choice.method == SearchMethod::brute) {
        detail::DirectBuild<Dim, detail::AllNodes>({nodes.n}, nodes, layout, request).visit(f);
    } else if (choice.method == SearchMethod::cells) {
        const detail::Cells<Dim> cells(nodes);
        detail::DirectBuild<Dim, detail::Cells<Dim>>(cells, nodes, layout, request).visit(f);
    } else {
        Report of_order;
        group_search.update_order(nodes, of_order);
        report.entry("traversal").reused = of_order.entry("order").reused;
        group_search.visit(nodes, layout, request, f);
    }
    report.entry("traversal").ms = watch.ms();
    report.entry("order").bytes = group_search.order_bytes();
    report.entry("scratch").bytes = state_->scratch_bytes();
}

template <int Dim>
View<Slot> Search<Dim>::spatial_order(const SearchNodes<Dim>& nodes, Report& report) {
    state_->groups.update_order(nodes, report);
    report.entry("order").asked_by = "caller";
    return state_->groups.spatial_order();
}

template <int Dim>
Offset Search<Dim>::bytes() const {
    return state_->groups.order_bytes() + state_->scratch_bytes();
}

template class Search<1>;
template class Search<2>;
template class Search<3>;

}  // namespace connectivity
