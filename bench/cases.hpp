// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The cases of the rebuild benchmark and their names.
///
/// <who>/<workload>/<form>/<threads>[/<extra>]: steady state at the standard size unless the extra
/// part says something else, words joined by "-": a size (1e4), `first` (build), and a variant of
/// ours: `3lists` (nodes dealt to three lists), `tensor` (ellipsoids of axis ratio 2), a search
/// method instead of the automatic choice, or a host's whole step, rebuild and one loop over the
/// pairs, with nodes as they come (`step`) or in spatial order (`reordered`), or one of 100 steps
/// on average, with a skin of s mean supports (`skin<s>`), or one sum of a field over pairs at its
/// nodes, without a build (`sumatomic`, `sumrows`, `sumcolours`), or rows, pairs and one product
/// more (`key` order, `overlap`, `intersection`, in the form `both`). Cases that differ by who and
/// variant only are a group, measured in turns in one process.

#include <string>
#include <vector>

namespace connectivity::bench {

struct CaseName {
    std::string who, workload, form, threads, size, variant;
    bool first = false;

    std::string cloud() const { return size.empty() ? workload : workload + "@" + size; }
    std::string group() const;
    std::string name() const;
};

/// All cases, those of a group next to each other.
std::vector<CaseName> all_cases();

/// Those whose name matches an extended regular expression; a leading "-" inverts it.
std::vector<CaseName> selected_cases(const std::string& filter);

}  // namespace connectivity::bench
