// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Chains of operators of expansions between two balls, and how far they are from the series that
/// each must be.

#include <algorithm>
#include <utility>

#include "expansion_reference.hpp"

namespace connectivity::test {

using detail::ExpansionKernels;

constexpr double round_off = 4e-15;

/// Largest error of potentials and gradients at the targets, each relative to the sum of the sizes
/// of what was added.
struct Errors {
    Real p = 0, a = 0;
    Real p_scale = 0, a_scale = 0;
    void add(Real wrong_p, const Vec& wrong_a, Real size_p, Real size_a) {
        p = std::max(p, std::abs(wrong_p));
        a = std::max(a, norm(wrong_a));
        p_scale = std::max(p_scale, size_p);
        a_scale = std::max(a_scale, size_a);
        if (!std::isfinite(wrong_p) || !std::isfinite(norm(wrong_a))) p = a = 1e300L;
    }
    double worst() const { return static_cast<double>(std::max(p / p_scale, a / a_scale)); }
};

/// How the exact value of the pair (target, source) is cut.
template <class Series>
inline double worst_error(const Field& field, const Cloud& targets, const Cloud& sources,
                          Series series) {
    Errors errors;
    for (std::size_t i = 0; i < targets.x.size(); ++i) {
        Real p = field.p[i], size_p = 0, size_a = 0;
        Vec a{field.ax[i], field.ay[i], field.az[i]};
        for (std::size_t j = 0; j < sources.x.size(); ++j) {
            const auto [pair_p, pair_a] = series(targets.at(i), sources.at(j));
            p -= sources.m[j] * pair_p;
            a = a - Real(sources.m[j]) * pair_a;
            size_p += std::abs(Real(sources.m[j]) * pair_p);
            size_a += std::abs(Real(sources.m[j])) * norm(pair_a);
        }
        errors.add(p, a, size_p, size_a);
    }
    return errors.worst();
}

/// Moments about `from`, seen at the target.
inline auto cut_moments(int order, Vec from) {
    return [=](const Vec& target, const Vec& source) {
        const Term t = legendre_series(order, source - from, target - from);
        return std::pair{t.p, t.large};
    };
}

/// A local expansion about `to` of a particle.
inline auto cut_local(int order, Vec to) {
    return [=](const Vec& target, const Vec& source) {
        const Term t = legendre_series(order, target - to, source - to);
        return std::pair{t.p, t.small};
    };
}

/// Moments about `from` to a local expansion about `to`: degrees n + k <= order of both offsets.
inline auto cut_both(int order, Vec from, Vec to) {
    return [=](const Vec& target, const Vec& source) {
        const Term t = legendre_series(order, (source - from) - (target - to), to - from);
        return std::pair{t.p, Real(-1) * t.small};
    };
}

inline std::vector<Vec> directions() {
    std::vector<Vec> all;
    for (const Real s : {1, -1})
        for (int axis = 0; axis < 3; ++axis) {
            Vec d{};
            d[axis] = s;
            all.push_back(d);
        }
    for (const Real tiny : {1e-300L, 1e-161L, 1e-155L, 1e-31L, 1e-20L, 1e-8L})
        for (const Real s : {1, -1}) {
            all.push_back({tiny, 0, s});
            all.push_back({-tiny / 2, tiny, s});
            all.push_back({s, tiny, -tiny});
        }
    all.push_back((1 / norm({3, -5, 7})) * Vec{3, -5, 7});
    all.push_back((1 / norm({-2, 3, -1})) * Vec{-2, 3, -1});
    all.push_back({Real(0.6), Real(-0.8), 0});
    return all;
}

/// Largest difference of coefficients, in units of the power of their degree.
inline double moments_difference(int order, const detail::Expansion& a,
                                 const detail::Expansion& b) {
    std::vector<double> difference(static_cast<std::size_t>(detail::n_coefficients(order))),
        wrong(static_cast<std::size_t>(order + 1)), power(wrong.size());
    for (std::size_t i = 0; i < difference.size(); ++i)
        difference[i] = a.coefficients[i] - b.coefficients[i];
    detail::expansion_power(order, difference.data(), wrong.data());
    detail::expansion_power(order, b.coefficients, power.data());
    double worst = 0;
    for (std::size_t n = 0; n < wrong.size(); ++n) worst = std::max(worst, wrong[n] / power[n]);
    return worst;
}

struct Chain {
    Cells cells;
    Cloud sources, targets;
    std::int32_t from, to;
    /// Source and target balls in a direction from each other; radii are `open` of the distance.
    Chain(int order, const Vec& direction, double r_source, double r_target, double distance = 1,
          int n = 21)
        : cells(order) {
        const Vec centre{0, 0, 0};
        const Vec target = Real(distance) * direction;
        sources = ball(n, centre, r_source, 1);
        targets = ball(n, target, r_target, 2);
        from = cells.add(centre, r_source);
        to = cells.add(target, r_target);
    }
};

inline double moments_to_points(const ExpansionKernels& k, Chain& c) {
    Field field(c.targets.size());
    k.p2m(c.cells.order, c.sources.bodies(), c.cells.cell(c.from));
    k.m2p(c.cells.order, c.cells.arrays(), list_of({c.from}), c.targets.points(), field.out());
    return worst_error(field, c.targets, c.sources,
                       cut_moments(c.cells.order, c.cells.centre(c.from)));
}

inline double moments_to_local(const ExpansionKernels& k, Chain& c) {
    Field field(c.targets.size());
    k.p2m(c.cells.order, c.sources.bodies(), c.cells.cell(c.from));
    const std::vector<std::int32_t> list{c.from};
    k.m2l(c.cells.order, c.cells.arrays(), list_of(list), c.cells.cell(c.to));
    k.l2p(c.cells.order, c.cells.cell(c.to), c.targets.points(), field.out());
    return worst_error(field, c.targets, c.sources,
                       cut_both(c.cells.order, c.cells.centre(c.from), c.cells.centre(c.to)));
}

inline double particles_to_local(const ExpansionKernels& k, Chain& c) {
    Field field(c.targets.size());
    k.p2l(c.cells.order, c.sources.bodies(), c.cells.cell(c.to));
    k.l2p(c.cells.order, c.cells.cell(c.to), c.targets.points(), field.out());
    return worst_error(field, c.targets, c.sources, cut_local(c.cells.order, c.cells.centre(c.to)));
}

}  // namespace connectivity::test
