// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// How far nodes have drifted since their lists were built with a skin, and what that is measured
/// against.
///
/// Why no pair is missed while drift <= skin. Let i see j now: their distance r is at most
/// reach_i = K h_i. Each node has moved by at most d, and the shortest distance obeys the triangle
/// inequality, on periodic axes too, so when the lists were built it was
///     r_old <= r + 2 d <= reach_i + 2 d <= old reach_i + growth + 2 d <= old reach_i + skin,
/// which is what the search tested then. For tensors read "i's ellipsoid" for "ball of reach_i":
/// the new one lies within `growth` of the old one, and the one that was tested holds every point
/// within `skin` of the old one.
///
/// Rounding: distances, displacements, h differences and reaches are wrong by a few units of
/// roundoff relative to the reach, which the tested supports include (support.hpp). Wrapping adds
/// an error relative to the box and to positions, which may be many boxes away; it is added to the
/// drift if any node moved at all: if none did, all distances have their old bits.
///
/// Cost: one pass that reads positions and supports, old and new; allocates nothing.

#include <span>
#include <vector>

#include <connectivity/base/box.hpp>
#include <connectivity/map/node_list.hpp>

namespace connectivity {

/// Positions and supports of the lists that a map was built from.
class DriftReference {
public:
    /// Takes the room that `keep` needs. Throws Error{memory}; what is kept stays.
    void reserve(std::span<const NodeList> lists);
    /// Copies the lists; call `reserve` for them just before. Cannot fail.
    void keep(std::span<const NodeList> lists, const Domain& domain);
    /// Forgets everything and gives the memory back.
    void clear() { *this = DriftReference(); }

    /// Held, with what `reserve` took.
    Offset bytes() const {
        return static_cast<Offset>((positions_.size() + supports_.size() + next_positions_.size() +
                                    next_supports_.size()) *
                                   sizeof(double));
    }

    /// Twice the largest displacement plus the largest growth of a support. Infinite if nothing is
    /// kept, if the lists differ from the kept ones in number or shape, or if a value is bad.
    double drift(std::span<const NodeList> lists) const;

private:
    struct Shape {
        int dim;
        Offset n, n_internal;
        bool has_tensor;
        double kernel_extent;
        bool operator==(const Shape&) const = default;
    };
    static Shape shape_of(const NodeList& list) {
        return {list.dim(), list.n(), list.n_internal(), list.has_tensor(), list.kernel_extent()};
    }
    bool has_shape_of(std::span<const NodeList> lists) const;

    template <int Dim>
    double drift_in(std::span<const NodeList> lists) const;

    std::vector<Shape> shapes_, next_shapes_;
    View<double> positions_, supports_;            // lists laid end to end; h or H
    View<double> next_positions_, next_supports_;  // of `reserve`, where the room is too small
    Domain domain_;
};

}  // namespace connectivity
