// SPDX-License-Identifier: BSD-3-Clause
#include "choice.hpp"

#include <algorithm>
#include <cmath>

namespace connectivity::detail {

namespace {

constexpr double aim = 0.22, too_low = 0.13, too_high = 0.35;  // of the tolerance
constexpr int most_trials = 8;
constexpr double most_epsilon = 1e4, most_angle = 0.95;

}  // namespace

std::int32_t usual_leaf(const TreeSettings& settings) {
    return settings.form == FarForm::cell_to_particles ? 32 : settings.float32 ? 48 : 24;
}

int usual_order(FarForm form, double tolerance) {
    const double digits = -std::log10(tolerance);
    if (form == FarForm::cell_to_particles) {
        // The quadrupole has a kernel of its own, which is worth two orders.
        const int order = static_cast<int>(std::lround(1.2 * digits));
        return std::clamp(digits < 4.5 ? 2 : order, 2, max_gravity_order);
    }
    const int order = static_cast<int>(std::lround(3.2 + 1.65 * digits));
    // Of the orders above 12 those of M2L that are fast are 14 and 16.
    const int fast = order <= 12 ? order : digits < 10 ? std::min(order / 2 * 2, 16) : order;
    return std::clamp(fast, 3, max_gravity_order);
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
    return static_cast<Offset>(3000 + 1000 * std::pow(std::max(digits, 0.0), 1.47));
}

double cost_of(const TreeSettings& settings, const TreeWork& work, Offset n) {
    const double p = settings.order + 1, coefficients = p * p;
    // Short lists and copies of sources make near pairs dearer than those of a direct sum.
    const double near = work.near_pairs * (settings.float32 ? 1.1 : 1.6);
    if (settings.form == FarForm::cell_to_particles)
        return near + work.far_pairs * (settings.order <= 2 ? 3 : 0.8 * coefficients);
    return near + work.far_pairs * (10 + 0.13 * coefficients * p) +
           static_cast<double>(n) * (20 + 0.8 * coefficients);
}

namespace {

/// Where epsilon is looked for: errors grow with it, about in proportion (with an angle: as its
/// power), but in steps where there are few cells.
class Bracket {
public:
    Bracket(double least, double most, double slope) : least_(least), most_(most), slope_(slope) {}

    void add(double epsilon, double error) {
        (error > too_high ? above_ : below_) = {epsilon, error};
    }
    /// The best one known: the largest whose error is low enough, or else the smallest.
    double best() const { return below_.epsilon > 0 ? below_.epsilon : above_.epsilon; }
    /// The next to be tried; `best` again where nothing is left.
    double next() const {
        const bool both = below_.epsilon > 0 && above_.epsilon > 0;
        const Trial& from = below_.epsilon > 0 ? below_ : above_;
        double slope = slope_;
        if (both && below_.error > 0)
            slope =
                std::log(above_.error / below_.error) / std::log(above_.epsilon / below_.epsilon);
        const double step = from.error > 0 ? std::log(aim / from.error) / slope : std::log(1e3);
        double epsilon = from.epsilon * std::exp(std::clamp(step, std::log(1e-4), std::log(1e3)));
        if (both) {
            const double width = std::log(above_.epsilon / below_.epsilon);
            if (width < 0.05) return below_.epsilon;
            epsilon = std::clamp(epsilon, below_.epsilon * std::exp(0.2 * width),
                                 below_.epsilon * std::exp(0.8 * width));
        }
        return std::clamp(epsilon, least_, most_);
    }

private:
    struct Trial {
        double epsilon = 0, error = 0;
    };
    Trial below_, above_;
    double least_, most_, slope_;
};

}  // namespace

namespace {

/// Errors that float32 makes do not fall with epsilon. false: they do not fall; nothing is fitted.
bool fit_at_precision(TreeSum& tree, Sample& sample, double tolerance, TreeSettings& settings,
                      SumArrays& trial, TreeWork& work) {
    const bool angle = settings.acceptance == Acceptance::geometric;
    const bool may_give_up = settings.float32 && !settings.float32_by_hand;
    Bracket bracket(least_epsilon, angle ? most_angle : most_epsilon, angle ? settings.order : 1);
    double last_epsilon = 0, last_error = 0;
    for (int k = 0;; ++k) {
        work = tree.sum_some(settings, sample.places(), trial.sums());
        if (k == 0) tree.measure_scales(sample.field(), sample.potential());
        const double error = sample.errors(trial).feared / tolerance;
        if (error >= too_low && error <= too_high) return true;
        if (may_give_up && error > too_high && settings.epsilon < 0.7 * last_epsilon &&
            error > 0.7 * last_error)
            return false;
        bracket.add(last_epsilon = settings.epsilon, last_error = error);
        const double next = k + 1 < most_trials ? bracket.next() : bracket.best();
        if (next == settings.epsilon) return true;
        settings.epsilon = next;
        if (k + 1 == most_trials) {
            work = tree.sum_some(settings, sample.places(), trial.sums());
            return true;
        }
    }
}

}  // namespace

TreeWork fit_epsilon(TreeSum& tree, Sample& sample, double tolerance, TreeSettings& settings,
                     SumArrays& trial) {
    trial.resize(sample.n());
    TreeWork work;
    if (!fit_at_precision(tree, sample, tolerance, settings, trial, work)) {
        settings.float32 = false;
        settings.epsilon = usual_epsilon(settings, tolerance);
        fit_at_precision(tree, sample, tolerance, settings, trial, work);
    }
    return work;
}

}  // namespace connectivity::detail
