// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Every cloud the benchmark knows: W1-W7 of tests/support/workloads.hpp at any size, and the hard
/// scenes A1 ... A16, which a search method may fail on.
///
/// A1 4096 coincident nodes. A2 a plane tilted in space. A3 two clusters 1e-9 wide, 1 apart, and
/// A3base, the same nodes in clusters 1e-3 wide. A4 one node at 1e30, A4base without it. A8
/// flat tensors of axis ratio 1e6, tilted at random, wider than the cloud. A10 a lattice whose
/// second neighbours lie exactly on the boundary. A14 a lattice 1e5 away from the origin. A16 one
/// node that sees all, A16base without it. Scenes with a base are to be compared with it.

#include <string>
#include <vector>

#include <support/workloads.hpp>

namespace connectivity::bench {

struct Cloud : test::Workload {
    std::vector<double> H;  ///< [n * n_symmetric(dim)] packed, extent 1; empty: R counts
    bool moves = true;      ///< false where a displacement would destroy what is hard about it
};

/// "W1", "W3@1e4", "A4". Throws std::invalid_argument for another name.
Cloud make_cloud(const std::string& name);

inline constexpr const char* hard_scenes[] = {"A1", "A2",  "A3",  "A3base", "A4",     "A4base",
                                              "A8", "A10", "A14", "A16",    "A16base"};

/// Ellipsoids of axis ratio 2 with the volume of the balls and random axes, packed: extent 1.
std::vector<double> stretched(const test::Workload& w);

/// Positions after a displacement of 0.05 of each node's support in a random direction; `k` tells
/// one displacement from another.
std::vector<double> displaced(const test::Workload& w, int k);

}  // namespace connectivity::bench
