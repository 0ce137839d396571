// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the packages of a host need from the map, collected: something is built if anybody asks for
/// it, and the report says who.

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>

#include <connectivity/map/map_options.hpp>

namespace connectivity {

enum class Need {
    rows,
    pairs,
    ghost_rows,
    overlap,
    intersection,             ///< common neighbours between the nodes of a pair
    unfiltered_intersection,  ///< all common neighbours; wins over `intersection`
    key_order,
    spatial_order
};
inline constexpr int n_needs = 8;

class Requirements {
public:
    /// Asking twice is asking once.
    Requirements& add(std::string_view package, std::initializer_list<Need> needs);

    bool has(Need need) const { return !asked_by_[static_cast<std::size_t>(need)].empty(); }

    /// Names of the packages, "sph, damage"; empty if nobody asked.
    const std::string& asked_by(Need need) const {
        return asked_by_[static_cast<std::size_t>(need)];
    }

    /// `base` (domain, budget, method, skin, ...) with exactly the products that were asked for.
    MapOptions options(MapOptions base = {}) const;

private:
    std::array<std::string, n_needs> asked_by_;
};

}  // namespace connectivity
