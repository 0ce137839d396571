// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Writer of the result of `connectivity gravity`: accelerations and potentials in HDF5.
///
///     /gravity/acceleration [n, 3] float64, /gravity/potential [n] float64: internal nodes, lists
///     end to end
///     /gravity attrs: method, order, acceptance, epsilon, near, tolerance, reached 0|1, constant,
///         softening, symmetric 0|1, n_samples, error_{rms,p99,max} of |a|, field_error_*,
///         potential_error_*, n_near, n_far, phases, seconds [n_phases]
///     attrs: list_names, n_internal [n_lists], list_offset and row_offset [n_lists+1], command,
///     library_version
///
/// Node a of list k is row row_offset[k] + a; list_offset counts ghosts, too.

#include <map>
#include <string>
#include <vector>

#include <connectivity/gravity/gravity.hpp>

namespace connectivity {

const std::map<std::string, GravityMethod>& gravity_method_names();  ///< automatic is "auto"
const std::map<std::string, Acceptance>& acceptance_names();
const std::map<std::string, NearPrecision>& near_precision_names();
const std::map<std::string, Softening>& softening_names();

/// Whose accelerations they are: of list k the nodes [0, n_internal[k]) of n[k].
struct GravityLists {
    std::vector<std::string> names;
    std::vector<Offset> n, n_internal;
};

/// Atomic: `path` appears whole or not at all. `options` are those of the solution. Throws
/// Error{file}.
void write_gravity_file(const std::string& path, const Gravity& gravity,
                        const GravityOptions& options, const GravityLists& lists,
                        const std::string& command);

}  // namespace connectivity
