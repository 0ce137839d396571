// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What expansions must give, in long double: the series of Legendre polynomials cut at an order,
/// which knows no harmonics, turns or scales; and cells to try the operators on.

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "gravity/expansion_kernels.hpp"

namespace connectivity::test {

using Real = long double;
using Vec = std::array<Real, 3>;

inline Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec operator*(Real f, const Vec& a) { return {f * a[0], f * a[1], f * a[2]}; }
inline Real dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Real norm(const Vec& a) { return std::sqrt(dot(a, a)); }

/// Potential, and its gradient in the small and in the large vector.
struct Term {
    Real p = 0;
    Vec small{}, large{};
};

/// sum_n<=order |w|^n / |R|^(n+1) P_n(cos): 1 / |R - w| cut at an order.
inline Term legendre_series(int order, const Vec& w, const Vec& R) {
    const Real r = norm(R), c = dot(w, R) / r;  // |w| cos
    const Real w2 = dot(w, w);
    // h_n = |w|^n P_n and its derivatives by c and w2, by the recurrence of P_n
    Real h0 = 1, h1 = c, dc0 = 0, dc1 = 1, dw0 = 0, dw1 = 0, scale = 1 / r;
    Term sum;
    for (int n = 0; n <= order; ++n, scale /= r) {
        const Vec dc_dw = (1 / r) * R, dc_dR = (1 / r) * w - (c / (r * r)) * R;
        sum.p += scale * h0;
        sum.small = sum.small + (scale * dc0) * dc_dw + (2 * scale * dw0) * w;
        sum.large = sum.large + (scale * dc0) * dc_dR - ((n + 1) * scale * h0 / (r * r)) * R;
        const Real a = Real(2 * n + 3) / (n + 2), b = Real(n + 1) / (n + 2);
        const Real h2 = a * c * h1 - b * w2 * h0, dc2 = a * (h1 + c * dc1) - b * w2 * dc0,
                   dw2 = a * c * dw1 - b * (h0 + w2 * dw0);
        h0 = h1, h1 = h2, dc0 = dc1, dc1 = dc2, dw0 = dw1, dw1 = dw2;
    }
    return sum;
}

inline std::vector<const detail::ExpansionKernels*> all_expansion_kernels() {
    std::vector<const detail::ExpansionKernels*> all{&detail::portable_expansion_kernels};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        all.push_back(&detail::avx2_expansion_kernels);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
        all.push_back(&detail::avx512_expansion_kernels);
#endif
    return all;
}

struct Cloud {
    std::vector<double> x, y, z, m;
    void add(const Vec& at, double mass) {
        x.push_back(static_cast<double>(at[0]));
        y.push_back(static_cast<double>(at[1]));
        z.push_back(static_cast<double>(at[2]));
        m.push_back(mass);
    }
    Vec at(std::size_t i) const { return {x[i], y[i], z[i]}; }
    std::int64_t size() const { return static_cast<std::int64_t>(x.size()); }
    detail::Bodies bodies() const { return {x.data(), y.data(), z.data(), m.data(), size()}; }
    detail::Points points() const { return {x.data(), y.data(), z.data(), size()}; }
};

/// n points in a ball, a third of the masses negative.
inline Cloud ball(int n, const Vec& centre, double radius, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Cloud cloud;
    while (cloud.size() < n) {
        const Vec r{uniform(random), uniform(random), uniform(random)};
        if (norm(r) <= 1) cloud.add(centre + Real(radius) * r, uniform(random) + 0.35);
    }
    return cloud;
}

/// Potential and gradient at points.
struct Field {
    std::vector<double> p, ax, ay, az;
    explicit Field(std::int64_t n)
        : p(static_cast<std::size_t>(n)), ax(p.size()), ay(p.size()), az(p.size()) {}
    detail::Fields out() { return {p.data(), ax.data(), ay.data(), az.data()}; }
};

/// Cells with moments of an order.
struct Cells {
    int order;
    std::vector<double> x, y, z, scale, coefficients;
    explicit Cells(int order_) : order(order_) {}

    std::int32_t add(const Vec& centre, double s) {
        x.push_back(static_cast<double>(centre[0]));
        y.push_back(static_cast<double>(centre[1]));
        z.push_back(static_cast<double>(centre[2]));
        scale.push_back(s);
        coefficients.resize(coefficients.size() +
                            static_cast<std::size_t>(detail::expansion_stride(order)));
        return static_cast<std::int32_t>(x.size() - 1);
    }
    detail::CellArrays arrays() const {
        return {x.data(),
                y.data(),
                z.data(),
                scale.data(),
                coefficients.data(),
                detail::expansion_stride(order)};
    }
    detail::Expansion cell(std::int32_t c) {
        const auto k = static_cast<std::size_t>(c);
        return {{x[k], y[k], z[k]},
                scale[k],
                coefficients.data() + c * detail::expansion_stride(order)};
    }
    Vec centre(std::int32_t c) const {
        const auto k = static_cast<std::size_t>(c);
        return {x[k], y[k], z[k]};
    }
};

inline detail::CellList list_of(const std::vector<std::int32_t>& ids) {
    return {ids.data(), static_cast<std::int64_t>(ids.size()), nullptr, nullptr};
}

}  // namespace connectivity::test
