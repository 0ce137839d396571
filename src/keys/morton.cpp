// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/keys/morton.hpp>

namespace connectivity {

template <int Dim>
KeyBox<Dim> bounding_key_box(ConstView<double> positions) {
    const auto n = static_cast<Offset>(positions.size()) / Dim;
    KeyBox<Dim> box{};
    if (n == 0) return box;
    for (int d = 0; d < Dim; ++d) {
        Kokkos::MinMaxScalar<double> range{};
        Kokkos::parallel_reduce(
            "keys/bounding_box", Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
            [=](const Offset i, Kokkos::MinMaxScalar<double>& r) {
                const double x = positions(i * Dim + d);
                if (x < r.min_val) r.min_val = x;
                if (x > r.max_val) r.max_val = x;
            },
            Kokkos::MinMax<double>(range));
        box.lo[d] = range.min_val;
        box.hi[d] = range.max_val;
    }
    return box;
}

template <int Dim>
View<std::uint64_t> morton_keys(ConstView<double> positions, const KeyBox<Dim>& box) {
    const auto n = static_cast<Offset>(positions.size()) / Dim;
    auto keys = allocate<std::uint64_t>("keys/morton", n);
    Kokkos::parallel_for("keys/morton",
                         Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
                         [=](const Offset i) { keys(i) = box.key(&positions(i * Dim)); });
    HostExec().fence();
    return keys;
}

#define CONNECTIVITY_INSTANTIATE(Dim)                              \
    template KeyBox<Dim> bounding_key_box<Dim>(ConstView<double>); \
    template View<std::uint64_t> morton_keys<Dim>(ConstView<double>, const KeyBox<Dim>&);
CONNECTIVITY_INSTANTIATE(1)
CONNECTIVITY_INSTANTIATE(2)
CONNECTIVITY_INSTANTIATE(3)
#undef CONNECTIVITY_INSTANTIATE

}  // namespace connectivity
