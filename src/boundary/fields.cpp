// SPDX-License-Identifier: BSD-3-Clause
// Fields of the host over nodes: the ghosts' part, and nodes that left the domain.
#include <cmath>

#include <connectivity/base/parallel.hpp>
#include <connectivity/boundary/boundaries.hpp>

#include "launch.hpp"
#include "state.hpp"

namespace connectivity {

namespace {

int components(const HostField& field, int dim) {
    switch (field.kind) {
        case FieldKind::vector: return dim;
        case FieldKind::tensor: return n_symmetric(dim);
        default: return field.n_components;
    }
}

void check_size(const char* call, const HostField& field, int dim, Offset n) {
    const int per_node = components(field, dim);
    if (per_node < 1)
        throw Error(Status::argument, std::string(call) + ": n_components = " +
                                          std::to_string(per_node) + ", must be at least 1");
    if (static_cast<Offset>(field.values.size()) != n * per_node)
        throw Error(Status::argument, std::string(call) + ": a field of " +
                                          std::to_string(field.values.size()) +
                                          " values, must be " + std::to_string(per_node) +
                                          " for each of " + std::to_string(n) + " nodes");
}

/// The value of node `to` is that of node `from`, mapped.
template <int Dim>
void map_value(const HostField& field, const RigidMap& map, Offset from, Offset to) {
    const int per_node = components(field, Dim);
    const double* const in = field.values.data() + from * per_node;
    double* const out = field.values.data() + to * per_node;
    if (field.kind == FieldKind::vector)
        map.vector<Dim>(in, out);
    else if (field.kind == FieldKind::tensor)
        map.tensor<Dim>(in, out);
    else
        for (int c = 0; c < per_node; ++c) out[c] = in[c];
}

template <int Dim>
void fill_block(const GhostBlock& block, const RigidMap& map, const HostField& field) {
    for (Offset k = 0; k < block.n; ++k)
        map_value<Dim>(field, map, block.storage(k), block.first + k);
}

/// Whether `x` is on the wrong side of a plane.
template <int Dim>
bool is_outside(const Plane& plane, const double* x) {
    return plane.distance<Dim>(x) < -plane.rounding<Dim>(x);
}

/// The map that takes a node outside back across a plane: for a shift as many as are needed.
template <int Dim>
RigidMap way_back(const OneWay& way, const double* x) {
    RigidMap map = way.map;
    if (!map.is_shift()) return map;
    const double length = way.enter.distance(way.exit);
    const double times = std::max(1.0, std::ceil(-way.enter.distance<Dim>(x) / length));
    for (double& component : map.t) component *= times;
    return map;
}

constexpr int max_crossings = 64;

}  // namespace

void Boundaries::fill_ghosts(int list, const HostField& field) const {
    const GhostLists& ghosts = state_->ghosts;
    if (list < 0 || list >= ghosts.n_lists())
        throw Error(Status::argument, "fill_ghosts: list " + std::to_string(list) +
                                          ", must be in [0, " + std::to_string(ghosts.n_lists()) +
                                          ")");
    check_size("fill_ghosts", field, dim_, ghosts.n(list));
    for (int way = 0; way < ghosts.n_ways(); ++way) {
        const GhostBlock& block = ghosts.block(way, list);
        const RigidMap& map = state_->ways[static_cast<std::size_t>(way)].map;
        if (dim_ == 1)
            fill_block<1>(block, map, field);
        else if (dim_ == 2)
            fill_block<2>(block, map, field);
        else
            fill_block<3>(block, map, field);
    }
}

Offset Boundaries::move_inside(const View<double>& positions,
                               std::span<const HostField> fields) const {
    if (static_cast<Offset>(positions.size()) % dim_ != 0)
        throw Error(Status::argument,
                    "move_inside: " + std::to_string(positions.size()) +
                        " coordinates are no multiple of dim = " + std::to_string(dim_));
    for (const HostField& field : fields)
        check_size("move_inside", field, dim_, static_cast<Offset>(positions.size()) / dim_);
    switch (dim_) {
        case 1: return move_inside_in<1>(positions, fields);
        case 2: return move_inside_in<2>(positions, fields);
        default: return move_inside_in<3>(positions, fields);
    }
}

template <int Dim>
Offset Boundaries::move_inside_in(const View<double>& positions,
                                  std::span<const HostField> fields) const {
    Offset moved = 0;
    for (Offset i = 0; i < static_cast<Offset>(positions.size()) / Dim; ++i) {
        double* const x = positions.data() + i * Dim;
        for (int d = 0; d < Dim; ++d)
            if (!std::isfinite(x[d]))
                throw Error(Status::nonfinite, "move_inside: node " + std::to_string(i) +
                                                   ", position[" + std::to_string(d) +
                                                   "] = " + number(x[d]) + ", must be finite");
        int crossings = 0;
        for (bool again = true; again;) {
            again = false;
            for (const Boundary& boundary : boundaries_)
                for (const OneWay& way : boundary.ways()) {
                    if (!is_outside<Dim>(way.enter, x)) continue;
                    const RigidMap back = way_back<Dim>(way, x);
                    back.position<Dim>(x, x);
                    for (const HostField& field : fields) map_value<Dim>(field, back, i, i);
                    again = true;
                    ++crossings;
                }
            if (crossings > max_crossings)
                throw Error(Status::argument, "move_inside: node " + std::to_string(i) +
                                                  " is not inside after " +
                                                  std::to_string(crossings) + " crossings");
        }
        moved += crossings > 0 ? 1 : 0;
    }
    return moved;
}

}  // namespace connectivity
