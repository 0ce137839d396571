// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The standard workloads W1-W7 of neighbour search: the same points on every machine, with known
/// pair counts; and the same clouds at any other size, density kept.
///
/// What they are: conformance/workloads.h.

#include <string>
#include <vector>

#include <connectivity/base/types.hpp>

namespace connectivity::test {

struct Workload {
    std::string name;
    int dim = 3;
    Offset n = 0;
    std::vector<double> x;  ///< [n * dim], shuffled
    std::vector<double> R;  ///< [n] support radii
    bool constant_R = true;
    Offset n_pairs = -1;  ///< exact number of unique gather-or-scatter pairs; -1: not documented
    std::uint64_t hash = 0,
                  wanted_hash = 0;  ///< of the points before the shuffle, always three components

    /// Whether this machine made the documented points. W3 and W5 use cos, sin and cbrt: other
    /// mathematics libraries may round them differently.
    bool is_standard() const { return hash == wanted_hash; }
};

/// "W1" ... "W7", or a size behind it: "W1@1e4", "W3@4e6". Throws std::invalid_argument for another
/// name.
Workload make_workload(const std::string& name);

inline constexpr const char* all_workloads[] = {"W1", "W2", "W3", "W4", "W5", "W6", "W7"};

}  // namespace connectivity::test
