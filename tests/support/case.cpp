// SPDX-License-Identifier: BSD-3-Clause
#include <support/case.hpp>

#include <algorithm>

#include <connectivity/base/runtime.hpp>

namespace connectivity::test {

Offset Case::n_slots() const {
    Offset sum = 0;
    for (std::size_t k = 0; k < lists.size(); ++k) sum += n(k);
    return sum;
}

double Case::kernel_extent() const {
    double largest = 0;
    for (const ListData& list : lists) largest = std::max(largest, list.extent);
    return largest;
}

namespace {
Case one_list(int dim, std::vector<double> x, double extent) {
    Case c;
    c.dim = dim;
    c.lists.resize(1);
    c.lists[0].x = std::move(x);
    c.lists[0].extent = extent;
    c.lists[0].n_internal = c.n(0);
    return c;
}

ConstView<double> wrap(const std::vector<double>& values) {
    return ConstView<double>(values.data(), values.size());
}
}  // namespace

Case scalar_case(int dim, std::vector<double> x, std::vector<double> h, double extent) {
    Case c = one_list(dim, std::move(x), extent);
    c.lists[0].h = std::move(h);
    return c;
}

Case uniform_case(int dim, std::vector<double> x, double h, double extent) {
    const std::size_t n = x.size() / static_cast<std::size_t>(dim);
    return scalar_case(dim, std::move(x), std::vector<double>(n, h), extent);
}

Case tensor_case(int dim, std::vector<double> x, std::vector<double> H, double extent) {
    Case c = one_list(dim, std::move(x), extent);
    c.lists[0].H = std::move(H);
    c.lists[0].tensor = true;
    return c;
}

std::vector<NodeList> node_lists(const Case& c) {
    start_runtime();
    std::vector<NodeList> lists;
    for (const ListData& list : c.lists)
        lists.push_back(list.tensor ? NodeList::with_H(list.name, c.dim, list.n_internal,
                                                       wrap(list.x), wrap(list.H), list.extent)
                                    : NodeList::with_h(list.name, c.dim, list.n_internal,
                                                       wrap(list.x), wrap(list.h), list.extent));
    return lists;
}

MapOptions map_options(const Case& c, SearchMethod method) {
    MapOptions options;
    options.pairs = c.mode == SearchMode::gather_scatter;
    options.ghost_rows = c.ghost_rows;
    options.mode = c.mode;
    options.method = method;
    options.domain = c.domain;
    return options;
}

void rebuild(ConnectivityMap& map, const Case& c, SearchMethod method) {
    map.rebuild(node_lists(c), map_options(c, method));
}

}  // namespace connectivity::test
