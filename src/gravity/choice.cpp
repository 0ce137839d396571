// SPDX-License-Identifier: BSD-3-Clause
#include "choice.hpp"

#include <algorithm>
#include <cmath>

namespace connectivity::detail {

namespace {

constexpr double aim = 0.35, too_low = 0.2, too_high = 0.55;  // of the tolerance
constexpr int most_trials = 6;
constexpr double least_epsilon = 1e-15, most_epsilon = 1e4;

}  // namespace

std::int32_t usual_leaf(const TreeSettings& settings) {
    if (settings.form == FarForm::cell_to_particles) return 16;
    return std::clamp(8 + 6 * settings.order, 24, 96);
}

int usual_order(FarForm form, double tolerance) {
    const double digits = -std::log10(tolerance);
    if (form == FarForm::cell_to_particles)
        return std::clamp(static_cast<int>(std::lround(1.2 * digits)), 2, max_gravity_order);
    return std::clamp(static_cast<int>(std::lround(0.5 + 1.6 * digits)), 3, max_gravity_order);
}

double usual_epsilon(const TreeSettings& settings, double tolerance) {
    if (settings.acceptance == Acceptance::geometric)
        return std::min(0.9, std::pow(tolerance, 1.0 / settings.order));
    const double p = settings.order;
    const double share = 1e-3 + 0.3 * std::exp(-0.6 * p);  // p99 over epsilon
    return aim * tolerance / share;
}

Offset direct_below(double tolerance) {
    const double digits = -std::log10(tolerance);
    return static_cast<Offset>(600 + 500 * digits);
}

double cost_of(const TreeSettings& settings, const TreeWork& work, Offset n) {
    const double p = settings.order, coefficients = (p + 1) * (p + 1);
    const double near = work.near_pairs * (settings.float32 ? 0.4 : 1);
    if (settings.form == FarForm::cell_to_particles)
        return near + work.far_pairs * (1 + 0.12 * coefficients);
    return near + work.far_pairs * (20 + 1.5 * coefficients) +
           static_cast<double>(n) * (10 + 0.8 * coefficients);
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
