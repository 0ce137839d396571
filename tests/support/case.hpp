// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A search problem as plain vectors: what tests generate, brute force reads and the library is
/// given.

#include <string>
#include <vector>

#include <connectivity/map/connectivity_map.hpp>

namespace connectivity::test {

struct ListData {
    std::string name = "nodes";
    Offset n_internal = 0;
    std::vector<double> x;  ///< [n * dim]
    std::vector<double> h;  ///< [n], or empty
    std::vector<double> H;  ///< [n * n_symmetric(dim)], or empty
    bool tensor = false;    ///< which of the two it is
    double extent = 2;
};

struct Case {
    int dim = 3;
    std::vector<ListData> lists;
    Domain domain;
    bool ghost_rows = false;
    SearchMode mode = SearchMode::gather_scatter;
    std::string text;  ///< what it is and how to make it again

    Offset n(std::size_t list) const { return static_cast<Offset>(lists[list].x.size()) / dim; }
    Offset n_slots() const;
    /// Largest extent of all lists, empty ones too.
    double kernel_extent() const;
};

/// One list of scalar nodes, all internal, open.
Case scalar_case(int dim, std::vector<double> x, std::vector<double> h, double extent = 2);

/// The same with one h for all.
Case uniform_case(int dim, std::vector<double> x, double h, double extent = 2);

/// The same with packed tensors.
Case tensor_case(int dim, std::vector<double> x, std::vector<double> H, double extent = 1);

/// Node lists that share the memory of the case, which has to outlive them. Starts the runtime.
std::vector<NodeList> node_lists(const Case& c);

/// Everything the case asks for: rows, and pairs where the mode has them.
MapOptions map_options(const Case& c, SearchMethod method = SearchMethod::automatic);

void rebuild(ConnectivityMap& map, const Case& c, SearchMethod method = SearchMethod::automatic);

inline constexpr SearchMethod all_methods[] = {SearchMethod::brute, SearchMethod::cells,
                                               SearchMethod::groups, SearchMethod::device,
                                               SearchMethod::automatic};

}  // namespace connectivity::test
