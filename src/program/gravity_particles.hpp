// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Internal nodes of a file as particles that attract each other.

#include <connectivity/gravity/particles.hpp>
#include <connectivity/io/gravity_file.hpp>
#include <connectivity/io/snapshot.hpp>

namespace connectivity::program {

/// Lists end to end, ghosts left out.
struct GravityInput {
    GravityLists lists;
    int dim = 3;
    View<double> positions;  ///< [n][dim]
    View<double> mass;       ///< [n]
    View<double> softening;  ///< [n]; empty if no list has any

    Offset n() const { return static_cast<Offset>(mass.size()); }
    GravityParticles particles() const;
    /// Rows [first, last) of list k.
    std::pair<Offset, Offset> rows(std::size_t k) const;
};

/// Reads these lists. Throws Error: format (a list with nodes has no masses), too_many, and what
/// the reader throws.
GravityInput read_gravity_input(SnapshotReader& reader, const std::vector<std::string>& names);

}  // namespace connectivity::program
