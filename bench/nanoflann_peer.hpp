// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// nanoflann, used as well as its interface allows.
///
/// A kd-tree with leaves of 32 over a copy of the points in the tree order of the build before;
/// queries in that order, by all threads; results in per-thread buffers, then counted and copied
/// into compressed sparse rows. Pairs: the node with the larger (R, number) owns a pair, so one
/// gather per node finds each pair once; half rows are left unsorted. Rows: for a constant R one
/// gather per node, sorted; for a variable R the owned pairs are mirrored, then sorted.

#include "contestants.hpp"

namespace connectivity::bench {

/// Form::both is not offered. Throws std::invalid_argument.
std::unique_ptr<Contestant> make_nanoflann(const Input& input, Form form);

}  // namespace connectivity::bench
