// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/neighbour_query.hpp>

#include <cmath>
#include <variant>

#include "map_impl.hpp"
#include "near_shape.hpp"
#include "support.hpp"

namespace connectivity {

struct NeighbourQuery::State {
    int dim;
    double extent;  // largest of all lists
    Domain domain;
    std::variant<NodeTree<1>, NodeTree<2>, NodeTree<3>> tree;
};

NeighbourQuery::NeighbourQuery() = default;
NeighbourQuery::~NeighbourQuery() = default;
NeighbourQuery::NeighbourQuery(NeighbourQuery&&) noexcept = default;
NeighbourQuery& NeighbourQuery::operator=(NeighbourQuery&&) noexcept = default;

namespace {

using detail::query_box, detail::query_plane;
using detail::refuse, detail::sorted, detail::nodes_near_box, detail::nodes_near_plane;

/// Who asks: a node, or a place with a support.
template <int Dim>
struct Asker {
    double x[Dim];
    double reach2 = -1;
    const double* H = nullptr;  // null: scalar
    Slot self = -1;
};

template <int Dim>
bool are_neighbours(const SearchNodes<Dim>& nodes, const Asker<Dim>& from, Slot j,
                    SearchMode mode) {
    Significance<Dim> see = significance(nodes);
    if (from.self >= 0) return from.self != j && see(from.self, j, mode);
    double r[Dim];
    for (int d = 0; d < Dim; ++d) {
        r[d] = from.x[d] - see.positions[Offset{j} * Dim + d];
        if (see.periods.any) r[d] = see.periods.wrap(r[d], d);
    }
    const double r2 = see.squared(r);
    const bool is_seen = mode != SearchMode::gather && see.sees(j, r, r2);
    if (is_seen || mode == SearchMode::scatter) return is_seen;
    if (from.H == nullptr) return r2 <= from.reach2;
    see.H = from.H;
    return see.eta2(0, r) <= see.extent2;
}

template <int Dim>
void check_slot(const SearchNodes<Dim>& nodes, Slot slot) {
    if (slot < 0 || slot >= nodes.n)
        refuse("query: slot " + std::to_string(slot) + ", must be in [0, " +
               std::to_string(nodes.n) + ")");
}

template <int Dim>
Asker<Dim> asker(const SearchNodes<Dim>& nodes, double, Slot node) {
    check_slot(nodes, node);
    Asker<Dim> from;
    for (int d = 0; d < Dim; ++d) from.x[d] = nodes.positions(Offset{node} * Dim + d);
    from.reach2 = nodes.reach2(node);
    from.self = node;
    return from;
}

template <int Dim>
Asker<Dim> asker(const SearchNodes<Dim>& nodes, double extent, const QueryPoint& point) {
    Asker<Dim> from;
    for (int d = 0; d < Dim; ++d) {
        from.x[d] = point.x[d];
        if (!std::isfinite(from.x[d]))
            throw Error(Status::nonfinite, "query: coordinate " + std::to_string(d) + " is " +
                                               number(from.x[d]) + ", must be finite");
    }
    double reach = 0;
    if (point.H.empty()) {
        if (!(point.h >= 0) || !std::isfinite(point.h))
            throw Error(Status::support,
                        "query: h = " + number(point.h) + ", must be finite and >= 0");
        from.reach2 = scalar_reach2(point.h, extent);
        reach = extent * point.h;
    } else {
        if (point.H.size() != static_cast<std::size_t>(n_symmetric(Dim)))
            refuse("query: H has " + std::to_string(point.H.size()) + " components, must have " +
                   std::to_string(n_symmetric(Dim)));
        const auto support = tensor_support<Dim>(point.H.data(), HalfWidths::all);
        if (!support.positive_definite)
            throw Error(Status::not_spd, "query: H must be finite and positive definite");
        from.H = point.H.data();
        reach = extent * support.radius;
        from.reach2 = reach * reach * (1 + 1e-14);
        reach = extent * *std::max_element(support.half_width, support.half_width + Dim);
    }
    for (int d = 0; d < Dim; ++d)
        if (const double length = nodes.periods.length[d]; length > 0 && reach > length / 2)
            throw Error(Status::half_box, "query: the support reaches " + number(reach) +
                                              ", more than half the length of periodic axis " +
                                              std::to_string(d) + ", " + number(length / 2));
    return from;
}

/// f(slot) for all that may be near the asker.
template <int Dim, class F>
void for_candidates(const NodeTree<Dim>& tree, const typename NodeTree<Dim>::Box& box,
                    SearchMode mode, double slack, const F& f) {
    const auto near = tree.nearness(mode, slack);
    tree.walk([&](const auto& other) { return near(box, other); }, f);
}

template <int Dim, class F>
void for_neighbours(const NodeTree<Dim>& tree, const Asker<Dim>& from, SearchMode mode,
                    const F& f) {
    for_candidates(tree, tree.box_at(from.x, from.reach2), mode, tree.slack_at(from.x),
                   [&](Slot j) {
                       if (are_neighbours(tree.nodes(), from, j, mode)) f(j);
                   });
}

/// The group around a place: that of the node, or the first whose box holds the place.
template <int Dim>
Offset group_of(const NodeTree<Dim>& tree, const Asker<Dim>& from) {
    if (from.self >= 0) return tree.leaf_of(from.self);
    const auto place = tree.box_at(from.x, 0);
    Offset leaf = -1;
    const auto holds = [&](const auto& box) {
        for (int d = 0; d < Dim; ++d)
            if (!(box.lo[d] <= place.lo[d] && place.lo[d] <= box.hi[d])) return false;
        return leaf < 0;
    };
    tree.walk(holds, [&](Slot slot) {
        if (leaf < 0) leaf = tree.leaf_of(slot);
    });
    return leaf;
}

template <int Dim>
QueryCandidates candidates_of(const NodeTree<Dim>& tree, const Asker<Dim>& from, SearchMode mode) {
    QueryCandidates out;
    auto group = tree.box_at(from.x, from.reach2);
    const double slack = tree.slack_at(from.x);
    for_candidates(tree, group, mode, slack, [&](Slot j) { out.refine.push_back(j); });
    if (from.self >= 0) out.refine.push_back(from.self);  // a blind node is not near itself
    if (const Offset leaf = group_of(tree, from); leaf >= 0) {
        tree.visit_leaf(leaf, [&](Slot j) { out.master.push_back(j); });
        group.add(tree.leaf_box(leaf));
    }
    for_candidates(tree, group, mode, slack, [&](Slot j) { out.coarse.push_back(j); });
    for (auto* list : {&out.master, &out.refine}) {
        *list = sorted(std::move(*list));
        list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    out.coarse.insert(out.coarse.end(), out.refine.begin(), out.refine.end());
    out.coarse = sorted(std::move(out.coarse));
    out.coarse.erase(std::unique(out.coarse.begin(), out.coarse.end()), out.coarse.end());
    return out;
}

double largest_extent(std::span<const NodeList> lists) {
    double extent = 0;
    for (const NodeList& list : lists) extent = std::max(extent, list.kernel_extent());
    return extent;
}

}  // namespace

void NeighbourQuery::update(std::span<const NodeList> lists, const Domain& domain) {
    check_lists("query", lists);
    const int dim = lists[0].dim();
    domain.check(dim);
    const double extent = largest_extent(lists);
    run_kernels("query", [&] {
        if (dim == 1)
            state_.reset(new State{dim, extent, domain, NodeTree<1>(lists, domain)});
        else if (dim == 2)
            state_.reset(new State{dim, extent, domain, NodeTree<2>(lists, domain)});
        else
            state_.reset(new State{dim, extent, domain, NodeTree<3>(lists, domain)});
    });
}

const NeighbourQuery::State& NeighbourQuery::built() const {
    if (!state_) throw Error(Status::not_built, "query: no nodes yet, call update first");
    return *state_;
}

int NeighbourQuery::dim() const { return built().dim; }

Offset NeighbourQuery::n_slots() const {
    return std::visit([](const auto& tree) { return tree.nodes().n; }, built().tree);
}

namespace {

template <class State, class Who>
std::vector<Slot> neighbours_in(const State& state, const Who& who, SearchMode mode) {
    return std::visit(
        [&](const auto& tree) {
            std::vector<Slot> out;
            for_neighbours(tree, asker(tree.nodes(), state.extent, who), mode,
                           [&](Slot j) { out.push_back(j); });
            return sorted(std::move(out));
        },
        state.tree);
}

template <class State, class Who>
Offset count_in(const State& state, const Who& who, SearchMode mode) {
    return std::visit(
        [&](const auto& tree) {
            Offset n = 0;
            for_neighbours(tree, asker(tree.nodes(), state.extent, who), mode, [&](Slot) { ++n; });
            return n;
        },
        state.tree);
}

template <class State, class Who>
QueryCandidates candidates_in(const State& state, const Who& who, SearchMode mode) {
    return std::visit(
        [&](const auto& tree) {
            return candidates_of(tree, asker(tree.nodes(), state.extent, who), mode);
        },
        state.tree);
}

}  // namespace

std::vector<Slot> NeighbourQuery::neighbours(Slot node, SearchMode mode) const {
    return neighbours_in(built(), node, mode);
}
std::vector<Slot> NeighbourQuery::neighbours(const QueryPoint& point, SearchMode mode) const {
    return neighbours_in(built(), point, mode);
}
Offset NeighbourQuery::count(Slot node, SearchMode mode) const {
    return count_in(built(), node, mode);
}
Offset NeighbourQuery::count(const QueryPoint& point, SearchMode mode) const {
    return count_in(built(), point, mode);
}
QueryCandidates NeighbourQuery::candidates(Slot node, SearchMode mode) const {
    return candidates_in(built(), node, mode);
}
QueryCandidates NeighbourQuery::candidates(const QueryPoint& point, SearchMode mode) const {
    return candidates_in(built(), point, mode);
}

std::vector<Slot> NeighbourQuery::near_box(std::span<const double> lo, std::span<const double> hi,
                                           SearchMode mode) const {
    return std::visit(
        [&](const auto& tree) {
            return nodes_near_box(tree, query_box(tree.nodes(), lo, hi), mode);
        },
        built().tree);
}

std::vector<Slot> NeighbourQuery::near_plane(std::span<const double> point,
                                             std::span<const double> normal, double distance,
                                             SearchMode mode) const {
    return std::visit(
        [&]<int Dim>(const NodeTree<Dim>& tree) {
            return nodes_near_plane(tree, query_plane<Dim>(point, normal, distance), distance,
                                    mode);
        },
        built().tree);
}

std::array<double, 3> NeighbourQuery::periodic_shift(Slot i, Slot j) const {
    return std::visit(
        [&]<int Dim>(const NodeTree<Dim>& tree) {
            const SearchNodes<Dim>& nodes = tree.nodes();
            check_slot(nodes, i), check_slot(nodes, j);
            std::array<double, 3> shift{};
            for (int d = 0; d < Dim; ++d)
                if (const double length = nodes.periods.length[d]; length > 0)
                    shift[d] = std::rint((nodes.positions(Offset{i} * Dim + d) -
                                          nodes.positions(Offset{j} * Dim + d)) /
                                         length);
            return shift;
        },
        built().tree);
}

}  // namespace connectivity
