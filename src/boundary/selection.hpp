// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Which nodes get a ghost across a plane: node by node, and none is missing.
///
/// Let c be a node at distance d >= 0 from the plane it enters, i an internal node at distance e >=
/// 0 from the plane its image leaves: they are at least d + e apart. If c sees i, its reach along
/// the normal is at least d; if i sees it, the reach of i is at least d + e. So c gets an image if
/// its own reach is >= d, or if the largest (reach - e) of all internal nodes is. The same argument
/// holds at a corner, for images of images, where planes meet at right angles. Reach is K h, or
/// K sqrt(n·H^-2·n), plus the skin, twice as much for overlap, rounded up. Cost: one pass over all
/// nodes, and 8 bytes a node of scratch memory.

#include <limits>
#include <string>
#include <vector>

#include <connectivity/boundary/boundary.hpp>

#include "ghost_nodes.hpp"

namespace connectivity::detail {

/// How far supports reach.
struct Reach {
    double kernel_extent = 2;  ///< maximum over all lists
    double supports = 1;       ///< how many supports deep ghosts are
    double skin = 0;
};

template <int Dim>
class Selection {
public:
    /// gap: distance to the nearest plane that faces this one. `name` is the boundary's, for
    /// messages.
    Selection(const std::string& name, const OneWay& way, double gap, const Reach& reach)
        : name_(name), way_(way), gap_(gap), reach_(reach) {}

    /// First, for every list: reads its first n nodes. Throws Error: nonfinite, argument for an
    /// internal node outside, half_box for a support that reaches across the gap; memory.
    void read(const GhostNodes& nodes, int list, Offset n, double* scratch);

    /// Then, for every list: appends the controls.
    void select(int list, Offset n, const double* scratch, GhostLists& ghosts) const;

private:
    /// Where a node is: distances from the planes it enters and leaves by, the latter rounded down.
    struct Place {
        double distance, rounding, beyond, reach;
    };
    /// What a chunk of nodes asks for.
    struct Found {
        bool refused = false;
        double pull = -std::numeric_limits<double>::infinity();
    };
    static bool is_inside(const Place& place) { return place.distance + place.rounding >= 0; }
    bool is_refused(const Place& place) const { return !(is_inside(place) && place.reach < gap_); }
    Place place_of(const GhostNodes& nodes, Offset node) const;
    Found read_chunk(const GhostNodes& nodes, Offset first, Offset last, double* scratch) const;
    [[noreturn]] void refuse(const GhostNodes& nodes, int list) const;

    const std::string& name_;
    const OneWay& way_;
    double gap_;
    Reach reach_;
    double pull_ = -std::numeric_limits<double>::infinity();
};

}  // namespace connectivity::detail
