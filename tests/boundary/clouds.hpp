// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Clouds in a box, rotated into any orientation, and the boundaries of that box.

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <connectivity/boundary/boundaries.hpp>
#include <support/case.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {

/// An orthonormal frame: axis d of a box points along row d.
using Frame = std::array<std::array<double, 3>, 3>;

inline constexpr Frame upright{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

inline Frame rotated_frame(int dim, Random& random) {
    Frame f = upright;
    for (int a = 0; a < dim; ++a)
        for (int b = a + 1; b < dim; ++b) {
            const double angle = random.uniform(0, 6.283185307179586);
            for (int d = 0; d < 3; ++d) {
                const double p = f[a][d], q = f[b][d];
                f[a][d] = std::cos(angle) * p - std::sin(angle) * q;
                f[b][d] = std::sin(angle) * p + std::cos(angle) * q;
            }
        }
    return f;
}

/// From coordinates in the frame to those of the world.
inline std::array<double, 3> to_world(const Frame& f, const std::array<double, 3>& y) {
    std::array<double, 3> x{0, 0, 0};
    for (int a = 0; a < 3; ++a)
        for (int d = 0; d < 3; ++d) x[d] += f[a][d] * y[a];
    return x;
}

struct Box {
    int dim = 3;
    std::array<double, 3> lo{0, 0, 0}, hi{1, 1, 1};
    Frame frame = upright;

    Plane face(int axis, bool upper) const {
        std::array<double, 3> y = lo, normal = frame[axis];
        if (upper) y[axis] = hi[axis];
        if (upper)
            for (double& component : normal) component = -component;
        const auto x = to_world(frame, y);
        const auto n = static_cast<std::size_t>(dim);
        return Plane(dim, {x.data(), n}, {normal.data(), n});
    }
};

inline void add_periodic(Boundaries& boundaries, const Box& box, int axis) {
    boundaries.add(Boundary::periodic("axis " + std::to_string(axis), box.face(axis, false),
                                      box.face(axis, true)));
}

inline void add_walls(Boundaries& boundaries, const Box& box, int axis) {
    for (const bool upper : {false, true})
        boundaries.add(Boundary::reflecting((upper ? "upper " : "lower ") + std::to_string(axis),
                                            box.face(axis, upper)));
}

/// n nodes in the box in each list, all internal, supports K h up to `largest`; some lists with
/// tensors, some nodes on the faces, some blind.
inline Case cloud_in_box(const Box& box, int n, double largest, Random& random) {
    Case c;
    c.dim = box.dim;
    c.lists.resize(static_cast<std::size_t>(1 + random.below(3)));
    for (ListData& list : c.lists) list.extent = random.pick({1.0, 2.0, 3.0});
    const double K = c.kernel_extent();
    for (ListData& list : c.lists) {
        list.tensor = random.chance(0.5);
        for (int i = 0; i < n; ++i) {
            std::array<double, 3> y{0, 0, 0};
            for (int d = 0; d < c.dim; ++d)
                y[d] = random.chance(0.03)   ? (random.chance(0.5) ? box.lo[d] : box.hi[d])
                       : random.chance(0.03) ? box.lo[d]
                                             : random.uniform(box.lo[d], box.hi[d]);
            const auto x = to_world(box.frame, y);
            list.x.insert(list.x.end(), x.begin(), x.begin() + c.dim);
            const double support = largest * (random.chance(0.1) ? 1.0 : random.uniform(0.05, 0.4));
            if (list.tensor) {
                double packed[6];
                const double axes[3] = {support / K, support / K * random.uniform(0.1, 1.0),
                                        support / K * random.uniform(0.1, 1.0)};
                rotated_tensor(c.dim, axes, random, packed);
                list.H.insert(list.H.end(), packed, packed + n_symmetric(c.dim));
            } else {
                list.h.push_back(random.chance(0.03) ? 0.0 : support / K);
            }
        }
        list.n_internal = n;
    }
    return c;
}

/// The nodes of lists as plain vectors.
inline Case copy_of(const std::vector<NodeList>& lists) {
    const auto values = [](const ConstView<double>& view) {
        return std::vector<double>(view.data(), view.data() + view.size());
    };
    Case c;
    c.dim = lists[0].dim();
    for (const NodeList& list : lists)
        c.lists.push_back({list.name(), list.n_internal(), values(list.positions()),
                           values(list.h()), values(list.H()), list.has_tensor(),
                           list.kernel_extent()});
    return c;
}

/// |H r| / K or |r| / (K h) of a node of a case and a vector from it, in long double.
inline long double eta_over_K(const Case& c, std::size_t list, Offset node,
                              const std::array<double, 3>& r) {
    const ListData& data = c.lists[list];
    const int dim = c.dim;
    long double sum = 0;
    if (!data.tensor) {
        for (int d = 0; d < dim; ++d) sum += static_cast<long double>(r[d]) * r[d];
        const long double h = data.h[static_cast<std::size_t>(node)];
        return h > 0 ? std::sqrt(sum) / (c.kernel_extent() * h) : HUGE_VALL;
    }
    const double* packed = data.H.data() + node * n_symmetric(dim);
    long double H[3][3];
    for (int a = 0, k = 0; a < dim; ++a)
        for (int b = a; b < dim; ++b, ++k) H[a][b] = H[b][a] = packed[k];
    for (int a = 0; a < dim; ++a) {
        long double component = 0;
        for (int b = 0; b < dim; ++b) component += H[a][b] * r[b];
        sum += component * component;
    }
    return std::sqrt(sum) / c.kernel_extent();
}

}  // namespace connectivity::test
