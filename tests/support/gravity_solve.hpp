// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Scenes through the public class Gravity, and how far its forces are from a reference.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/gravity/gravity.hpp>
#include <support/gravity_brute.hpp>

namespace connectivity::test {

/// A scene as arrays of type Real; a float one rounds the scene's numbers.
template <class Real = double>
class SceneArrays {
public:
    explicit SceneArrays(const GravityScene& scene)
        : m_(scene.m.begin(), scene.m.end()), e_(scene.e.begin(), scene.e.end()) {
        for (std::size_t i = 0; i < scene.x.size(); ++i)
            for (const auto* const axis : {&scene.x, &scene.y, &scene.z})
                x_.push_back(static_cast<Real>((*axis)[i]));
    }
    GravityParticles particles() const {
        GravityParticles p;
        p.type = sizeof(Real) == 4 ? CoordinateType::float32 : CoordinateType::float64;
        p.n = static_cast<Offset>(m_.size());
        p.positions = x_.data();
        p.particle_stride = 3;
        p.masses = m_.data();
        if (!e_.empty()) p.softening = e_.data();
        return p;
    }
    /// What the library sees: the rounded numbers.
    GravityScene scene() const {
        GravityScene s;
        for (std::size_t i = 0; i < m_.size(); ++i)
            s.add(x_[3 * i], x_[3 * i + 1], x_[3 * i + 2], m_[i]);
        s.e.assign(e_.begin(), e_.end());
        return s;
    }

private:
    std::vector<Real> x_, m_, e_;
};

inline void solve(Gravity& gravity, const GravityScene& scene, const GravityOptions& options) {
    start_runtime();
    const SceneArrays<> arrays(scene);
    gravity.solve(arrays.particles(), options);
}

inline Gravity solved(const GravityScene& scene, const GravityOptions& options) {
    Gravity gravity;
    solve(gravity, scene, options);
    return gravity;
}

/// Both as positive sums over sources, like the reference.
struct Forces {
    explicit Forces(const Gravity& g)
        : a(g.acceleration().data(), g.acceleration().data() + 3 * g.n()),
          p(g.potential().data(), g.potential().data() + g.n()) {
        for (double& value : p) value = -value;
    }
    const double* operator[](std::int64_t i) const { return a.data() + 3 * i; }

    std::vector<double> a, p;
};

inline long double distance(const BruteSum& sum, const double* a) {
    return distance(sum, a[0], a[1], a[2]);
}

/// Rounding of sums of terms: no share of a force, where forces cancel.
constexpr double rounding = 2e-14;

/// Errors as shares of |a|, of sum |m|/r² and of sum |m|/r, each less the rounding of the sums.
struct Deviations {
    Deviations(const Forces& forces, const std::vector<std::int64_t>& targets,
               const std::vector<BruteSum>& expected) {
        for (std::size_t k = 0; k < targets.size(); ++k) {
            const BruteSum& sum = expected[k];
            const auto i = static_cast<std::size_t>(targets[k]);
            const long double error = distance(sum, forces[targets[k]]);
            const auto share = [](long double of, long double size, long double total) {
                const long double excess = of - rounding * total;
                if (!(excess > 0)) return std::isnan(of) ? HUGE_VAL : 0.0;
                return static_cast<double>(excess / size);
            };
            acceleration.push_back(share(error, length(sum), sum.size_a));
            field.push_back(share(error, sum.size_a, sum.size_a));
            potential.push_back(share(std::abs(forces.p[i] - sum.p), sum.size_p, sum.size_p));
        }
        for (auto* const errors : {&acceleration, &field, &potential})
            std::sort(errors->begin(), errors->end());
    }
    static double p99(const std::vector<double>& errors) {
        const auto n = static_cast<double>(errors.size());
        return errors.empty() ? 0 : errors[static_cast<std::size_t>(std::ceil(0.99 * n)) - 1];
    }
    static double rms(const std::vector<double>& errors) {
        double squares = 0;
        for (const double e : errors) squares += e * e;
        return errors.empty() ? 0 : std::sqrt(squares / static_cast<double>(errors.size()));
    }
    static double max(const std::vector<double>& errors) {
        return errors.empty() ? 0 : errors.back();
    }

    std::vector<double> acceleration, field, potential;  ///< ascending
};

inline GravityOptions to_tolerance(double tolerance,
                                   GravityMethod method = GravityMethod::automatic) {
    GravityOptions options;
    options.method = method;
    options.tolerance = tolerance;
    return options;
}

inline GravityOptions by_hand(GravityMethod method, int order, double epsilon,
                              Acceptance acceptance = Acceptance::field) {
    GravityOptions options;
    options.method = method;
    options.order = order;
    options.epsilon = epsilon;
    options.acceptance = acceptance;
    options.near = NearPrecision::float64;
    return options;
}

inline Domain periodic_box(double x = 1, double y = 1, double z = 1) {
    Domain domain;
    domain.periodic = {true, true, true};
    domain.hi = {x, y, z};
    return domain;
}

inline const char* name_of(GravityMethod method) {
    constexpr const char* names[] = {"automatic", "direct", "walk", "fmm"};
    return names[static_cast<int>(method)];
}

}  // namespace connectivity::test
