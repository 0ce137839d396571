// SPDX-License-Identifier: BSD-3-Clause
#include "choice.hpp"

#include <algorithm>
#include <cmath>

namespace connectivity::detail {

namespace {

constexpr double aim = 0.3, too_low = 0.18, too_high = 0.45;  // of the tolerance
constexpr int most_trials = 6;
constexpr double least_epsilon = 1e-15, most_epsilon = 1e4;

}  // namespace

std::int32_t usual_leaf(const TreeSettings& settings) {
    return settings.form == FarForm::cell_to_particles ? 32 : 24;
}

int usual_order(FarForm form, double tolerance) {
    const double digits = -std::log10(tolerance);
    if (form == FarForm::cell_to_particles) {
        // The quadrupole has a kernel of its own, which is worth two orders.
        const int order = static_cast<int>(std::lround(1.2 * digits));
        return std::clamp(digits < 4.5 ? 2 : order, 2, max_gravity_order);
    }
    const int order = static_cast<int>(std::lround(3 + 1.6 * digits));
    // Above 12 the even orders of M2L are the fast ones.
    return std::clamp(order <= 12 ? order : order / 2 * 2, 3, max_gravity_order);
}

double usual_epsilon(const TreeSettings& settings, double tolerance) {
    if (settings.acceptance == Acceptance::geometric)
        return std::min(0.9, 1.3 * std::pow(tolerance, 1.0 / settings.order));
    // Errors add up with all signs: the 99th percentile is a small share of epsilon, the smaller
    // the higher the order.
    const double p = settings.order;
    const double share =
        settings.form == FarForm::cell_to_particles ? 0.02 : 5e-4 + 0.5 * std::exp(-0.9 * p);
    return std::min(2.0, aim * tolerance / share);
}

Offset direct_below(double tolerance) {
    const double digits = -std::log10(tolerance);
    return static_cast<Offset>(600 + 500 * digits);
}

double cost_of(const TreeSettings& settings, const TreeWork& work, Offset n) {
    const double p = settings.order + 1, coefficients = p * p;
    // Short lists and copies of sources make near pairs dearer than those of a direct sum.
    const double near = work.near_pairs * (settings.float32 ? 0.8 : 1.6);
    if (settings.form == FarForm::cell_to_particles)
        return near + work.far_pairs * (settings.order <= 2 ? 3 : 0.8 * coefficients);
    return near + work.far_pairs * (10 + 0.13 * coefficients * p) +
           static_cast<double>(n) * (20 + 0.8 * coefficients);
}

TreeWork fit_epsilon(TreeSum& tree, Sample& sample, double tolerance, TreeSettings& settings,
                     SumArrays& trial) {
    trial.resize(sample.n());
    double last_epsilon = 0, last_error = 0;
    const bool angle = settings.acceptance == Acceptance::geometric;
    for (int k = 0;; ++k) {
        const TreeWork work = tree.sum_some(settings, sample.places(), trial.sums());
        if (k == 0) tree.measure_scales(sample.field(), sample.potential());
        const double error = sample.errors(trial).acceleration.p99 / tolerance;
        if ((error >= too_low && error <= too_high) || k + 1 == most_trials) return work;
        // log(error) is nearly linear in log(epsilon).
        double slope = angle ? settings.order : 1;
        if (k > 0 && error > 0 && last_error > 0 && settings.epsilon != last_epsilon)
            slope =
                std::clamp(std::log(error / last_error) / std::log(settings.epsilon / last_epsilon),
                           0.3 * slope, 3 * slope);
        last_epsilon = settings.epsilon;
        last_error = error;
        const double factor = error > 0 ? std::pow(aim / error, 1 / slope) : 1e3;
        settings.epsilon = std::clamp(settings.epsilon * std::clamp(factor, 1e-4, 1e3),
                                      least_epsilon, angle ? 0.95 : most_epsilon);
        if (settings.epsilon == last_epsilon) return work;
    }
}

}  // namespace connectivity::detail
