// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Boundaries: where the domain ends, and what lies beyond.
///
/// A reflecting boundary is one plane, its ghosts are mirror images. A periodic one is two planes
/// that face each other, nodes close to one are copied to beyond the other. A given one leaves the
/// choice of nodes to the host. Planes may have any orientation. Corners are complete where planes
/// meet at right angles; elsewhere the ghosts in a corner are those of this order of boundaries.

#include <functional>
#include <string>
#include <vector>

#include <connectivity/base/types.hpp>
#include <connectivity/boundary/plane.hpp>
#include <connectivity/boundary/rigid_map.hpp>

namespace connectivity {

/// One way across a boundary: nodes close to `enter`, inside, get images beyond `exit`.
struct OneWay {
    Plane enter, exit;
    RigidMap map;
};

/// Names the nodes of a list that get ghosts: appends ids in [0, n) in the order of their ghosts. n
/// counts the ghosts of boundaries before this one.
using ControlFunction = std::function<void(int list, Offset n, std::vector<Slot>& controls)>;

class Boundary {
public:
    static Boundary reflecting(std::string name, const Plane& plane);

    /// Normals point into the domain, so they are opposite; nodes are shifted by the distance of
    /// the planes along the normal. Throws Error{argument} if the planes are not parallel or do not
    /// face each other.
    static Boundary periodic(std::string name, const Plane& one, const Plane& other);

    /// The host's own choice of nodes, mapped by `map`.
    static Boundary given(std::string name, int dim, const RigidMap& map, ControlFunction controls);

    /// Ghosts of this boundary are never culled.
    Boundary& keep_all_ghosts() {
        may_cull_ = false;
        return *this;
    }

    const std::string& name() const { return name_; }
    int dim() const { return dim_; }
    bool may_cull() const { return may_cull_; }
    const std::vector<OneWay>& ways() const { return ways_; }  ///< empty for a given boundary
    const RigidMap& map(int way) const {
        return ways_.empty() ? given_map_ : ways_[static_cast<std::size_t>(way)].map;
    }
    int n_ways() const { return ways_.empty() ? 1 : static_cast<int>(ways_.size()); }
    const ControlFunction& controls() const { return controls_; }

private:
    Boundary(std::string name, int dim) : name_(std::move(name)), dim_(dim) {}

    std::string name_;
    int dim_;
    bool may_cull_ = true;
    std::vector<OneWay> ways_;
    RigidMap given_map_;
    ControlFunction controls_;
};

}  // namespace connectivity
