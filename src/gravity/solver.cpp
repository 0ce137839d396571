// SPDX-License-Identifier: BSD-3-Clause
#include "solver.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <connectivity/base/parallel.hpp>

namespace connectivity::detail {

namespace {

/// Near sums in single precision are wrong by about 1e-6 of the sum of their terms.
constexpr double float32_tolerance = 3e-5;
/// Share of the tolerance that the far images of a periodic box may take.
constexpr double lattice_share = 1e-2;
/// The 99th percentile of a few hundred is uncertain: what is found is to be below this share.
constexpr double safe_share = 0.45;
constexpr int most_repeats = 4;

/// Plummer's law softens the near images of the box, the others are Newton's; so the forces depend
/// on where the box ends by a share of about 30 (e / L)², measured.
void check_softening(const Frame& frame, const GravityOptions& options) {
    if (!frame.periodic || options.softening != Softening::plummer) return;
    const double side = *std::min_element(frame.box.begin(), frame.box.end());
    const double longest = side * std::sqrt(options.tolerance / 30);
    if (frame.max_softening <= longest) return;
    throw Error(Status::argument,
                "the longest softening is " + number(frame.max_softening * frame.length) +
                    ", must be at most " + number(longest * frame.length) +
                    " in this periodic box, for a tolerance of " + number(options.tolerance));
}

/// Storage for n values: the old one if it is large enough and nobody else holds it.
View<double> spare(const View<double>& old, const char* label, Offset n) {
    if (n <= static_cast<Offset>(old.size()) && old.use_count() <= 1) return old;
    return allocate<double>(label, n);
}

/// Arrays as long as the particles: the frame's, sums, results. What cells need is checked later.
void check_budget(Offset n, const GravityOptions& options) {
    const Offset doubles = 5 + 4 + 4 + (options.error_bound ? 2 : 0);
    const Offset bytes = std::max<Offset>(n, 0) * doubles * static_cast<Offset>(sizeof(double));
    if (n > max_slots || options.budget.allows(bytes)) return;  // too many is another error
    throw Error(Status::budget, "gravity of " + std::to_string(n) + " particles needs " +
                                    human_bytes(bytes) + " and more, the budget allows " +
                                    human_bytes(options.budget.allowed()));
}

/// A solution with these is good to a per cent: lengths of forces for Acceptance::acceleration.
TreeSettings rough_settings(Softening softening) {
    TreeSettings settings;
    settings.order = 3;
    settings.epsilon = 0.3;
    settings.softening = softening;
    settings.softening_share = 1e-2;
    return settings;
}

}  // namespace

PairLaw Solver::law(const GravityOptions& options) const {
    if (!(frame_.max_softening > 0)) return PairLaw::newton;
    return options.softening == Softening::plummer ? PairLaw::plummer : PairLaw::sph_exa;
}

void Solver::make_lattice(double tolerance) {
    images_ = Images{};
    if (!frame_.periodic) {
        lattice_.reset();
        return;
    }
    const double accuracy = std::clamp(tolerance * lattice_share, 1e-10, 1e-5);
    if (lattice_ == nullptr || !lattice_->serves(frame_.box, accuracy))
        lattice_ = std::make_unique<LatticeField>(frame_.box, accuracy);
    const auto& near = lattice_->near_images();
    images_.n = static_cast<int>(near.size());
    images_.shift.clear();
    for (const auto& image : near)
        for (int d = 0; d < 3; ++d) images_.shift.push_back(image[d] * frame_.box[d]);
    const double* const x = frame_.x.data();
    lattice_->gather({x, x + frame_.n, x + 2 * frame_.n, frame_.mass.data(), frame_.n});
}

/// What is not summed over images, at all particles in the order of the sums.
void Solver::add_lattice() {
    const Stopwatch watch;
    const Offset n = frame_.n;
    const double* x[3];
    for (int d = 0; d < 3; ++d)
        x[d] = user_ids_ == nullptr ? frame_.x.data() + d * n : tree_.bodies().x[d];
    const Sums sums = sums_.sums();
    lattice_->add({x[0], x[1], x[2], n}, {sums.p, sums.ax, sums.ay, sums.az});
    report_.entry("lattice").ms += watch.ms();
}

void Solver::solve_direct(const GravityOptions& options, GravityInfo& info) {
    const Stopwatch watch;
    const Offset n = frame_.n;
    const double* const x = frame_.x.data();
    sums_.resize(n);
    const Sums sums = sums_.sums();
    Kokkos::deep_copy(View<double>(sums.p, static_cast<std::size_t>(4 * n)), 0.0);
    for (int image = 0; image < images_.n; ++image) {
        const double* const s = images_.shift.data() + 3 * image;
        direct_sum(law(options),
                   {x, x + n, x + 2 * n, frame_.mass.data(), frame_.softening.data(), n},
                   {.n = n, .shift = {-s[0], -s[1], -s[2]}}, {sums.p, sums.ax, sums.ay, sums.az},
                   scratch_);
    }
    user_ids_ = nullptr;
    info.method = GravityMethod::direct;
    info.n_near = n * n * images_.n;
    report_.entry("direct").ms += watch.ms();
}

TreeSettings Solver::first_settings(const GravityOptions& o) const {
    TreeSettings s;
    s.form = o.method == GravityMethod::walk ? FarForm::cell_to_particles : FarForm::cell_to_cell;
    s.order = o.order.value_or(usual_order(s.form, o.tolerance));
    s.acceptance = o.acceptance.value_or(Acceptance::field);
    s.symmetric = o.symmetric;
    s.softening = o.softening;
    s.float32_by_hand = o.near == NearPrecision::float32;
    s.float32 = s.float32_by_hand || (o.near == NearPrecision::automatic && !o.symmetric &&
                                      !o.error_bound && o.tolerance >= float32_tolerance);
    s.epsilon = o.epsilon.value_or(usual_epsilon(s, o.tolerance));
    // A far cell gives a small part of a force: where a sample tells, the first trial is loose.
    const bool fitted = !o.epsilon && o.n_samples > 0;
    s.softening_share = (fitted ? 30 : 0.3) * o.tolerance / s.epsilon;
    return s;
}

void Solver::find_weakest(const GravityOptions& options, const TreeSettings& settings) {
    if (settings.acceptance != Acceptance::acceleration) return;
    const Offset n = frame_.n;
    scratch_.resize(static_cast<std::size_t>(n));
    if (options.previous_acceleration.size() > 0) {
        const long double unit = static_cast<long double>(options.constant) * frame_.mass_unit /
                                 frame_.length / frame_.length;
        for (Offset i = 0; i < n; ++i)
            scratch_[i] = static_cast<double>(options.previous_acceleration(i) / unit);
    } else {
        tree_.sum_all(rough_settings(options.softening), sums_.sums());
        user_ids_ = tree_.user_ids();
        if (lattice_ != nullptr) add_lattice();
        for (Offset k = 0; k < n; ++k) scratch_[tree_.user_ids()[k]] = sums_.acceleration(k);
    }
    tree_.set_weakest(scratch_.data());
}

TreeWork Solver::sum_until_reached(const GravityOptions& options, TreeSettings& settings,
                                   GravityInfo& info) {
    for (int k = 0;; ++k) {
        const TreeWork work = tree_.sum_all(settings, sums_.sums());
        if (sample_.n() == 0) return work;
        const SampleErrors errors = sample_.errors_among(sums_);
        info.acceleration = errors.acceleration;
        info.field = errors.field;
        info.potential = errors.potential;
        const double excess = errors.feared / options.tolerance;
        info.reached = errors.acceleration.p99 <= options.tolerance;
        if (excess <= safe_share || options.epsilon || k + 1 == most_repeats) return work;
        settings.epsilon = std::max(settings.epsilon * 0.3 / excess, least_epsilon);
        settings.float32 = settings.float32_by_hand;
    }
}

bool Solver::solve_by_cells(const GravityOptions& options, GravityInfo& info) {
    TreeSettings settings = first_settings(options);
    tree_.plant(frame_, options.leaf.value_or(usual_leaf(settings)), images_, options.budget);
    sums_.resize(frame_.n);
    find_weakest(options, settings);
    const Stopwatch watch;
    const bool may_fit = !options.epsilon && options.n_samples > 0;
    sample_.draw(tree_.bodies(), law(options), images_, lattice_.get(), options.n_samples,
                 options.seed);
    report_.entry("sample").ms += watch.ms();
    if (may_fit) {
        const Stopwatch fit;
        const TreeWork promised = fit_epsilon(tree_, sample_, options.tolerance, settings, trial_);
        report_.entry("fit").ms += fit.ms();
        const auto n = static_cast<double>(frame_.n);
        if (options.method == GravityMethod::automatic &&
            cost_of(settings, promised, frame_.n) > n * n * images_.n)
            return false;
    } else if (sample_.n() > 0) {
        trial_.resize(sample_.n());
        tree_.sum_some(settings, sample_.places(), trial_.sums());
        tree_.measure_scales(sample_.field(), sample_.potential());
    }
    const TreeWork work = sum_until_reached(options, settings, info);
    user_ids_ = tree_.user_ids();
    if (options.error_bound) tree_.bound_errors(settings, bounds_.data());
    info.method = settings.form == FarForm::cell_to_cell ? GravityMethod::fmm : GravityMethod::walk;
    info.order = settings.order;
    info.acceptance = settings.acceptance;
    info.epsilon = settings.epsilon;
    info.near = settings.float32 ? NearPrecision::float32 : NearPrecision::float64;
    info.n_samples = sample_.n();
    info.n_near = static_cast<Offset>(work.near_pairs);
    info.n_far = static_cast<Offset>(work.far_pairs);
    return true;
}

/// Sums of finite particles are finite; in the host's units they may not be.
void Solver::check_finite(long double force, long double potential) const {
    const Sums sums = sums_.sums();
    const auto check = [&](const double* values, long double unit, const char* what) {
        for (Offset k = 0; k < frame_.n; ++k) {
            if (std::isfinite(static_cast<double>(values[k] * unit))) continue;
            const Offset i = user_ids_ == nullptr ? k : user_ids_[k];
            throw Error(Status::nonfinite, std::string(what) + " of particle " + std::to_string(i) +
                                               " is " + number(values[k]) + " times 10^" +
                                               std::to_string(static_cast<int>(std::log10(unit))) +
                                               ", must be below 1.8e308");
        }
    };
    check(sums.p, potential, "the potential");
    for (const double* const a : {sums.ax, sums.ay, sums.az}) check(a, force, "the acceleration");
}

void Solver::hand_over(const GravityOptions& options, const GravityInfo& info, Solution& solution) {
    const Stopwatch watch;
    const Offset n = frame_.n;
    // A long double holds products that are in range only together.
    const long double potential =
        static_cast<long double>(options.constant) * frame_.mass_unit / frame_.length;
    const long double force = potential / frame_.length;
    if (n > 0) check_finite(force, potential);
    auto a = spare(solution.acceleration, "gravity/acceleration", 3 * n);
    auto p = spare(solution.potential, "gravity/potential", n);
    const auto bound = spare(solution.bound, "gravity/error_bound", options.error_bound ? n : 0);
    const bool has_bound = options.error_bound;
    const Sums sums = sums_.sums();
    const std::int32_t* const ids = user_ids_;
    const double* const bounds = bounds_.data();
    report_.entry("hand over").ms = 0;
    Report report = report_;  // a copy may fail, so it is made before anything is changed
    Kokkos::parallel_for("gravity/hand_over", Kokkos::RangePolicy<HostExec>(0, n),
                         [=](const Offset k) {
                             const Offset i = ids == nullptr ? k : ids[k];
                             a(3 * i) = static_cast<double>(force * sums.ax[k]);
                             a(3 * i + 1) = static_cast<double>(force * sums.ay[k]);
                             a(3 * i + 2) = static_cast<double>(force * sums.az[k]);
                             p(i) = static_cast<double>(-potential * sums.p[k]);
                             if (has_bound) bound(i) = static_cast<double>(force * bounds[k]);
                         });
    HostExec().fence();
    solution.n = n;
    solution.acceleration = a;
    solution.potential = p;
    solution.bound = bound;
    solution.has_bound = has_bound;
    solution.info = info;
    report.entry("hand over").ms = watch.ms();
    solution.report = std::move(report);
}

Offset Solver::bytes() const {
    return tree_.bytes() + sums_.bytes() + trial_.bytes() +
           static_cast<Offset>((frame_.x.size() + frame_.mass.size() + frame_.softening.size() +
                                scratch_.capacity()) *
                               sizeof(double)) +
           (lattice_ != nullptr ? lattice_->bytes() : 0);
}

/// Trees are limited in depth, which direct sums are not.
bool Solver::can_solve_by_cells(const GravityOptions& options, GravityInfo& info) {
    try {
        return solve_by_cells(options, info);
    } catch (const Error& error) {
        if (error.status() != Status::too_many || options.method != GravityMethod::automatic) throw;
        return false;
    }
}

/// Joins the report of the cells; every entry is there because it was done.
void Solver::report_bytes() {
    tree_.report_bytes();
    for (const auto& entry : tree_.report().entries()) report_.entry(entry.product) = entry;
    const auto of = [](const View<double>& view) {
        return static_cast<Offset>(view.size() * sizeof(double));
    };
    report_.entry("frame").bytes = of(frame_.x) + of(frame_.mass) + of(frame_.softening);
    report_.entry("sums").bytes = sums_.bytes() + trial_.bytes() + of(bounds_);
    if (lattice_ != nullptr) report_.entry("lattice").bytes = lattice_->bytes();
    for (const char* name : {"frame", "sums", "sample", "fit", "tree", "cells", "moments", "lists",
                             "far", "near", "lattice", "direct"}) {
        if (report_.find(name) == nullptr) continue;
        report_.entry(name).built = true;
        report_.entry(name).asked_by = "solve";
    }
}

void Solver::solve(const GravityParticles& particles, const GravityOptions& options,
                   Solution& solution) {
    report_ = Report();
    tree_.report() = Report();
    check_budget(particles.n, options);
    const Stopwatch watch;
    make_frame(particles, options, frame_);
    report_.entry("frame").ms = watch.ms();
    check_softening(frame_, options);
    make_lattice(options.tolerance);
    ensure_capacity(bounds_, "gravity/bounds", options.error_bound ? frame_.n : 0);
    if (options.error_bound) Kokkos::deep_copy(bounds_, 0.0);
    GravityInfo info;
    const bool direct = options.method == GravityMethod::direct || frame_.n < 2 ||
                        (options.method == GravityMethod::automatic && !options.order &&
                         frame_.n < direct_below(options.tolerance));
    if (direct || !can_solve_by_cells(options, info)) solve_direct(options, info);
    if (lattice_ != nullptr) add_lattice();
    report_bytes();
    hand_over(options, info, solution);
}

}  // namespace connectivity::detail
