// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/search/search.hpp>

#include "cells.hpp"
#include "direct.hpp"

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
struct Search<Dim>::State {};

template <int Dim>
Search<Dim>::Search() : state_(std::make_unique<State>()) {}
template <int Dim>
Search<Dim>::~Search() = default;
template <int Dim>
Search<Dim>::Search(Search&&) noexcept = default;
template <int Dim>
Search<Dim>& Search<Dim>::operator=(Search&&) noexcept = default;

template <int Dim>
void Search<Dim>::run(const SearchNodes<Dim>& nodes, const SlotLayout& layout, const SearchRequest& request, Csr& rows,
                      Csr& half_rows, Report& report) {
    const Stopwatch watch;
    const detail::Products products{rows, half_rows};
    SearchMethod method = request.method;
    if (method == SearchMethod::automatic) method = nodes.n <= 128 ? SearchMethod::brute : SearchMethod::cells;
    if (method == SearchMethod::brute) {
        detail::DirectBuild<Dim, detail::AllNodes>({nodes.n}, nodes, layout, request).run(products);
    } else {
        const detail::Cells<Dim> cells(nodes);
        detail::DirectBuild<Dim, detail::Cells<Dim>>(cells, nodes, layout, request).run(products);
    }
    if (!request.rows) rows.clear();
    if (!request.half_rows) half_rows.clear();
    auto& entry = report.entry("rows");
    entry.built = request.rows;
    entry.bytes = rows.bytes();
    entry.ms = watch.ms();
}

template <int Dim>
View<Slot> Search<Dim>::spatial_order(const SearchNodes<Dim>& nodes, const SlotLayout&) {
    auto order = allocate<Slot>("search/order", nodes.n);
    for (Offset i = 0; i < nodes.n; ++i) order(i) = static_cast<Slot>(i);
    return order;
}

template <int Dim>
Offset Search<Dim>::bytes() const {
    return 0;
}

template class Search<1>;
template class Search<2>;
template class Search<3>;

}  // namespace connectivity
