// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Random search problems that mix everything the library promises: several node lists, ghosts,
/// scalar and tensor supports, periodic axes, offsets, coincident and boundary positions.

#include <support/case.hpp>

namespace connectivity::test {

struct CaseKind {
    int dim = 3;
    bool periodic = false;  ///< at least one periodic axis
    int max_nodes = 200;
    int min_nodes = 0;
};

/// The same case for the same seed and kind.
Case random_case(std::uint64_t seed, const CaseKind& kind);

class Random;

/// Packed H of an ellipsoid with the given half axes (times the kernel extent), randomly rotated.
/// Writes n_symmetric(dim) values.
void rotated_tensor(int dim, const double (&axes)[3], Random& random, double* packed);

/// n nodes anywhere in the unit cube, all with the same h.
Case cloud(int n, std::uint64_t seed, double h = 0.1);

}  // namespace connectivity::test
