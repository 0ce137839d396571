// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/search/search.hpp>

#include "cells.hpp"
#include "direct.hpp"
#include "groups.hpp"

namespace connectivity {

const char* name_of(SearchMethod method) {
    switch (method) {
        case SearchMethod::automatic: return "automatic";
        case SearchMethod::brute: return "brute";
        case SearchMethod::cells: return "cells";
        case SearchMethod::groups: return "groups";
    }
    return "unknown";
}

template <int Dim>
struct Search<Dim>::State {
    detail::GroupSearch<Dim> groups;
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

/// Brute force while a block of the group search would hold all nodes anyway; groups beyond: cells
/// never overtook them.
Choice choose(SearchMethod asked, Offset n) {
    constexpr Offset few = 48;
    if (asked != SearchMethod::automatic)
        return {asked, std::string(name_of(asked)) + ": asked for"};
    if (n <= few)
        return {SearchMethod::brute, "brute: " + std::to_string(n) + " nodes, at most " +
                                         std::to_string(few) + " are tested all with all"};
    return {SearchMethod::groups,
            "groups: " + std::to_string(n) + " nodes, more than " + std::to_string(few)};
}

void report_product(Report& report, const char* name, bool asked, const std::string& reason,
                    const Csr& list, double ms) {
    report.entry(name) = {name,  asked ? "caller" : "", asked ? reason : "", asked,
                          false, list.bytes(),          asked ? ms : 0};
}

}  // namespace

template <int Dim>
void Search<Dim>::run(const SearchNodes<Dim>& nodes, const SlotLayout& layout,
                      const SearchRequest& request, Csr& rows, Csr& half_rows, Report& report) {
    const Stopwatch watch;
    const detail::Products products{rows, half_rows};
    const Choice choice = choose(request.method, nodes.n);
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
        default: state_->groups.run(nodes, layout, request, products, report);
    }
    if (!request.rows) rows.clear();
    if (!request.half_rows) half_rows.clear();
    const double ms = watch.ms();
    report_product(report, "rows", request.rows, choice.reason, rows, ms);
    report_product(report, "pairs", request.half_rows,
                   request.rows ? "found with the rows" : choice.reason, half_rows,
                   request.rows ? 0 : ms);
}

template <int Dim>
View<Slot> Search<Dim>::spatial_order(const SearchNodes<Dim>& nodes, Report& report) {
    return state_->groups.spatial_order(nodes, report);
}

template <int Dim>
Offset Search<Dim>::bytes() const {
    return state_->groups.bytes();
}

template class Search<1>;
template class Search<2>;
template class Search<3>;

}  // namespace connectivity
