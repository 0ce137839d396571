// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// From node lists to what the search reads: one checking pass, supports as squared radii, lists
/// laid end to end.
///
/// A single list is read where it lies. Several lists, and tensors that a skin widens, are written
/// into storage that is reused from build to build.

#include <span>

#include <connectivity/map/node_list.hpp>
#include <connectivity/search/predicate.hpp>

namespace connectivity {

/// Storage kept between builds.
struct PreparedStorage {
    View<double> positions, reach2, H;
    Offset bytes() const {
        return static_cast<Offset>((positions.size() + reach2.size() + H.size()) * sizeof(double));
    }
};

/// Checks every value, widens supports by `skin` >= 0 and lays the lists end to end. Throws
/// Error{nonfinite | support | not_spd | half_box} with the first offending node in slot order and
/// the number of nodes that offend in the same way.
template <int Dim>
SearchNodes<Dim> prepare_nodes(std::span<const NodeList> lists, const Domain& domain,
                               PreparedStorage& storage, double skin = 0);

}  // namespace connectivity
