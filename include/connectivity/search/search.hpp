// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Neighbour search: from nodes and supports to sorted rows and half rows, exact and complete.
///
/// Four methods give the same bits. `brute` tests every pair; `cells` hashes nodes into a grid of
/// the largest support; `groups` sorts nodes into blocks of a tree by support class and position
/// and tests blocks against candidates with vector code, any double decision inside a proven error
/// band; `device` does the same in double as kernels of Kokkos' default execution space, a GPU
/// where there is one, from the order of `groups`. `automatic` chooses and says why in the report.
///
/// Rows: for every stored slot the ascending slots of its neighbours, cut by target list: row r,
/// list l is segment r * n_lists + l. Half rows: for every slot the partners after it; a slot
/// without a row names only stored partners. So each pair with at least one stored row stands in
/// exactly one half row.

#include <memory>
#include <string>

#include <connectivity/base/budget.hpp>
#include <connectivity/base/csr.hpp>
#include <connectivity/base/report.hpp>
#include <connectivity/search/layout.hpp>
#include <connectivity/search/predicate.hpp>
#include <connectivity/search/row_function.hpp>

namespace connectivity {

enum class SearchMethod { automatic, brute, cells, groups, device };

const char* name_of(SearchMethod method);

/// What is to be found.
struct SearchRequest {
    bool rows = true;
    bool half_rows = true;  ///< needs SearchMode::gather_scatter
    SearchMode mode = SearchMode::gather_scatter;
    SearchMethod method = SearchMethod::automatic;
    Budget budget;
    bool ordered = false;  ///< spatial_order() was called just before for these very nodes
};

/// A searcher keeps its order of the nodes and its scratch memory from build to build.
template <int Dim>
class Search {
public:
    Search();
    ~Search();
    Search(Search&&) noexcept;
    Search& operator=(Search&&) noexcept;

    /// Fills `rows` and `half_rows` as asked; what is not asked for is cleared. Strong guarantee:
    /// on an exception both are as before. Throws Error{budget} with the bytes needed, allowed, and
    /// the worst node; Error{memory}.
    void run(const SearchNodes<Dim>& nodes, const SlotLayout& layout, const SearchRequest& request,
             Csr& rows, Csr& half_rows, Report& report);

    /// Hands every row (request.rows) or else every half row to f, and stores none: whole rows of
    /// all stored slots, half rows of all slots, empty ones too, each once, in any order, from
    /// several threads at once, with worker < n_workers(). Where f throws, the search stops and
    /// the first of these exceptions comes out as HostException. There is no traversal on a
    /// device, whose rows would have to be stored: `groups` does it. Throws Error{memory},
    /// std::bad_alloc.
    void visit(const SearchNodes<Dim>& nodes, const SlotLayout& layout,
               const SearchRequest& request, RowFunction f, Report& report);

    /// Slots in an order that keeps neighbours close in memory, [n]: the one that `groups` works
    /// in. Call it right before `run`, tell by SearchRequest::ordered, and the work is done once.
    /// Throws Error{memory}.
    View<Slot> spatial_order(const SearchNodes<Dim>& nodes, Report& report);

    /// Bytes of order and scratch memory held.
    Offset bytes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

extern template class Search<1>;
extern template class Search<2>;
extern template class Search<3>;

}  // namespace connectivity
