// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A clustered cloud of nodes in a periodic unit box: a uniform background and Plummer spheres of
/// many sizes.
///
/// The k-th number of a seed is mix(seed + (k + 1)·0x9E3779B97F4A7C15) with the finaliser of
/// splitmix64; node p takes numbers 4p ... 4p + 3. So a cloud is the same for any number of
/// threads, and a larger one of the same seed begins at the same places.

#include <cstdint>

#include <connectivity/io/snapshot.hpp>

namespace connectivity::program {

/// n nodes of mass 1/n, list "cloud", 3D, kernel extent 2. h is such that the distribution expects
/// 60 others within the support, or the support is 0.45 of the box; so a node has 60 neighbours in
/// gather and about 80 in gather-scatter. Throws Error: argument (n < 1), too_many, memory.
ListData make_cloud(Offset n, std::uint64_t seed);

/// The box of the cloud: [0, 1] on each axis, periodic.
Domain cloud_domain();

}  // namespace connectivity::program
