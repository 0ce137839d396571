// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/boundary/boundaries.hpp>

#include <limits>

#include <connectivity/base/kokkos_shim.hpp>
#include <connectivity/base/runtime.hpp>

#include "launch.hpp"
#include "selection.hpp"
#include "state.hpp"

namespace connectivity {

Boundaries::Boundaries(int dim)
    : dim_(dim), state_(std::make_unique<State>()), spare_(std::make_unique<State>()) {
    if (dim < 1 || dim > 3)
        throw Error(Status::argument,
                    "boundaries: dim = " + std::to_string(dim) + ", must be 1, 2 or 3");
}
Boundaries::~Boundaries() = default;
Boundaries::Boundaries(Boundaries&&) noexcept = default;
Boundaries& Boundaries::operator=(Boundaries&&) noexcept = default;

const std::vector<NodeList>& Boundaries::lists() const { return state_->lists; }
const GhostLists& Boundaries::ghosts() const { return state_->ghosts; }
int Boundaries::boundary_of(int way) const {
    return state_->ways.at(static_cast<std::size_t>(way)).boundary;
}

int Boundaries::add(Boundary boundary) {
    const auto refuse = [&](const std::string& what) {
        throw Error(Status::argument, "boundary \"" + boundary.name() + "\": " + what);
    };
    if (boundary.dim() != dim_)
        refuse("dim = " + std::to_string(boundary.dim()) + ", must be that of the others, " +
               std::to_string(dim_));
    for (const Boundary& other : boundaries_)
        for (const OneWay& old : other.ways())
            for (const OneWay& way : boundary.ways()) {
                const int alignment = way.enter.alignment(old.enter);
                if (alignment > 0)
                    refuse("its plane is parallel to one of \"" + other.name() +
                           "\" and faces the same way");
                if (alignment < 0 && !(way.enter.distance(old.enter) > 0))
                    refuse("its plane must face that of \"" + other.name() +
                           "\" from the inside; the other is at distance " +
                           number(way.enter.distance(old.enter)));
            }
    boundaries_.push_back(std::move(boundary));
    return size() - 1;
}

double Boundaries::gap_to_facing_plane(const Plane& plane) const {
    double gap = std::numeric_limits<double>::infinity();
    for (const Boundary& boundary : boundaries_)
        for (const OneWay& way : boundary.ways())
            if (plane.alignment(way.enter) < 0) gap = std::min(gap, plane.distance(way.enter));
    return gap;
}

void Boundaries::check_lists(const char* call, std::span<const NodeList> lists) const {
    if (lists.empty())
        throw Error(Status::argument, std::string(call) + ": 0 node lists, must be at least 1");
    for (std::size_t k = 0; k < lists.size(); ++k)
        if (lists[k].dim() != dim_)
            throw Error(Status::argument, std::string(call) + ": node list " + std::to_string(k) +
                                              " (\"" + lists[k].name() +
                                              "\") has dim = " + std::to_string(lists[k].dim()) +
                                              ", the boundaries have " + std::to_string(dim_));
}

void Boundaries::make_spare(std::span<const NodeList> lists, const MapOptions& options) {
    check_lists("make", lists);
    detail::launch("make ghosts", [&] {
        const shim::ProfilingRegion region("boundary/make");
        State& state = *spare_;
        state.take(lists);
        for (int b = 0; b < size(); ++b) {
            std::vector<Offset> n_before;
            for (const auto& list : state.nodes) n_before.push_back(list.n);
            for (int way = 0; way < (*this)[b].n_ways(); ++way) {
                state.ghosts.begin_way((*this)[b].may_cull());
                state.ways.push_back({b, (*this)[b].map(way)});
                if ((*this)[b].ways().empty())
                    append_given(b);
                else if (dim_ == 1)
                    append_way<1>(b, way, n_before, options);
                else if (dim_ == 2)
                    append_way<2>(b, way, n_before, options);
                else
                    append_way<3>(b, way, n_before, options);
                state.append_images();
            }
        }
        state.ghosts.finish();
        state.make_lists();
    });
}

/// The second way of a periodic boundary leaves out the ghosts of the first: n_before.
template <int Dim>
void Boundaries::append_way(int boundary, int way, const std::vector<Offset>& n_before,
                            const MapOptions& options) {
    const OneWay& one_way = (*this)[boundary].ways()[static_cast<std::size_t>(way)];
    detail::Selection<Dim> selection(
        (*this)[boundary].name(), one_way, gap_to_facing_plane(one_way.enter),
        {spare_->kernel_extent(), options.overlap ? 2.0 : 1.0, options.skin});
    Offset total = 0;
    for (const Offset n : n_before) total += n;
    detail::grow(scratch_, "boundary/distances", 0, total);
    Offset first = 0;
    for (std::size_t k = 0; k < n_before.size(); first += n_before[k++])
        selection.read(spare_->nodes[k], static_cast<int>(k), n_before[k], scratch_.data() + first);
    first = 0;
    for (std::size_t k = 0; k < n_before.size(); first += n_before[k++])
        selection.select(static_cast<int>(k), n_before[k], scratch_.data() + first, spare_->ghosts);
}

void Boundaries::append_given(int boundary) {
    std::vector<Slot> controls;
    for (std::size_t k = 0; k < spare_->nodes.size(); ++k) {
        const Offset n = spare_->nodes[k].n;
        controls.clear();
        (*this)[boundary].controls()(static_cast<int>(k), n, controls);
        for (const Slot control : controls)
            if (control < 0 || control >= n)
                throw Error(Status::argument, "boundary \"" + (*this)[boundary].name() +
                                                  "\": node list " + std::to_string(k) +
                                                  ", control " + std::to_string(control) +
                                                  ", must be in [0, " + std::to_string(n) + ")");
        std::copy(controls.begin(), controls.end(),
                  spare_->ghosts.append(static_cast<int>(k), static_cast<Offset>(controls.size())));
    }
}

void Boundaries::publish(double ms) {
    std::swap(state_, spare_);
    auto& entry = report_.entry("ghosts");
    entry.asked_by = boundaries_.empty() ? "" : "caller";
    entry.reason = std::to_string(size()) + " boundaries";
    entry.built = true;
    entry.bytes =
        state_->bytes() + spare_->bytes() + static_cast<Offset>(scratch_.size() * sizeof(double));
    entry.ms = ms;
    report_.counter("ghosts_made") = state_->ghosts.n_ghosts();
    report_.counter("ghosts_culled") = 0;
}

void Boundaries::make(std::span<const NodeList> lists, const MapOptions& options) {
    const Stopwatch making;
    make_spare(lists, options);
    publish(making.ms());
}

void Boundaries::clear() {
    std::vector<Offset> n_internal;
    for (auto& list : state_->nodes) n_internal.push_back(list.n = list.n_internal);
    state_->ghosts.reset(n_internal);
    state_->ways.clear();
    state_->make_lists();
}

void Boundaries::update(ConnectivityMap& map, std::span<const NodeList> lists,
                        const MapOptions& options, const GhostOptions& ghosts) {
    const Stopwatch making;
    make_spare(lists, options);
    const double ms = making.ms();
    map.rebuild(spare_->lists, options);
    publish(ms);
    if (ghosts.cull && !options.stores_all_rows() && options.skin == 0 &&
        (options.rows || options.pairs))
        cull(map, ghosts.rule);
}

void Boundaries::update(ConnectivityMap& map, std::span<const NodeList> lists,
                        const Requirements& requirements, const MapOptions& base,
                        const GhostOptions& ghosts) {
    update(map, lists, requirements.options(base), ghosts);
    constexpr std::pair<Need, const char*> products[] = {
        {Need::rows, "rows"},       {Need::pairs, "pairs"},
        {Need::overlap, "overlap"}, {Need::intersection, "intersection"},
        {Need::key_order, "order"}, {Need::spatial_order, "order"}};
    for (const auto& [need, product] : products) {
        const ReportEntry* const built = map.report().find(product);
        if (built == nullptr || !requirements.has(need)) continue;
        report_.entry(product) = *built;
        report_.entry(product).asked_by = requirements.asked_by(need);
    }
}

void Boundaries::refresh(std::span<const NodeList> lists) {
    check_lists("refresh", lists);
    State& state = *state_;
    bool same = lists.size() == state.nodes.size();
    for (std::size_t k = 0; same && k < lists.size(); ++k)
        same = lists[k].n_internal() == state.nodes[k].n_internal &&
               lists[k].has_tensor() == state.nodes[k].tensor;
    if (!same)
        throw Error(Status::argument,
                    "refresh: the number of lists, their internal nodes and their kind of support "
                    "must be those of the last update");
    detail::launch("refresh ghosts", [&] {
        for (std::size_t k = 0; k < lists.size(); ++k) state.nodes[k].move(lists[k]);
        for (int way = 0; way < state.ghosts.n_ways(); ++way)
            for (std::size_t k = 0; k < lists.size(); ++k)
                state.nodes[k].place(state.ghosts.block(way, static_cast<int>(k)),
                                     state.ways[static_cast<std::size_t>(way)].map);
    });
}

RigidMap Boundaries::image(int list, Offset ghost) const {
    const GhostLists& ghosts = state_->ghosts;
    if (list < 0 || list >= ghosts.n_lists() || ghost < ghosts.n_internal(list) ||
        ghost >= ghosts.n(list))
        throw Error(Status::argument, "image: list " + std::to_string(list) + ", node " +
                                          std::to_string(ghost) + " is no ghost");
    RigidMap map;
    for (int way = ghosts.n_ways() - 1; way >= 0; --way) {
        const GhostBlock& block = ghosts.block(way, list);
        if (ghost < block.first || ghost >= block.first + block.n) continue;
        map = state_->ways[static_cast<std::size_t>(way)].map.then(map);
        ghost = block.storage(ghost - block.first);
    }
    return map;
}

}  // namespace connectivity
