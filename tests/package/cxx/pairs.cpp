// SPDX-License-Identifier: BSD-3-Clause
// The lattice of ../c/pairs.c through the C++ interface: 3 m²(m-1) + 6 m (m-1)² pairs.
#include <array>
#include <connectivity/map/connectivity_map.hpp>
#include <iostream>

using namespace connectivity;

int main(int argc, char** argv) {
    constexpr Offset m = 10, n = m * m * m;
    constexpr Offset expected = 3 * m * m * (m - 1) + 6 * m * (m - 1) * (m - 1);
    Kokkos::ScopeGuard kokkos(argc, argv);

    View<double> x("x", 3 * n), h("h", n);
    for (Offset i = 0; i < n; ++i) {
        x(3 * i) = static_cast<double>(i % m);
        x(3 * i + 1) = static_cast<double>(i / m % m);
        x(3 * i + 2) = static_cast<double>(i / m / m);
        h(i) = 0.75;
    }
    ConnectivityMap map;
    map.rebuild(std::array{NodeList::with_h("lattice", 3, n, x, h, 2.0)}, MapOptions{});
    Offset ends = 0;
    for (Offset row = 0; row < n; ++row)
        for (Slot j : map.rows()[row]) ends += j != row;
    std::cout << map.pairs().size() << " pairs\n";
    return map.pairs().size() != expected || ends != 2 * expected;
}
