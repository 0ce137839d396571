// SPDX-License-Identifier: BSD-3-Clause
#include "tree_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <connectivity/base/parallel.hpp>

#include "base/first_exception.hpp"
#include "error_bound.hpp"
#include "upward.hpp"

namespace connectivity::detail {

namespace {

/// A walk's group: targets that share a list. More make lists longer, fewer make more of them.
constexpr std::int32_t group_size = 64;

/// Pairs of particles that take as long as one expansion, by order, measured; see WalkRule.
double near_pairs(const TreeSettings& s) {
    const double speed = s.float32 ? 1.5 : 1;
    const double p = s.order;
    return s.form == FarForm::cell_to_cell ? speed * (10 + 1.2 * p * p)
                                           : speed * (1 + 0.15 * p * p);
}

PairLaw law_of(const TreeSettings& settings, const TreeBodies& bodies) {
    if (bodies.softening == nullptr) return PairLaw::newton;
    return settings.softening == Softening::plummer ? PairLaw::plummer : PairLaw::sph_exa;
}

}  // namespace

void TreeSum::plant(const Frame& frame, std::int32_t leaf, const Images& images,
                    const Budget& budget) {
    TreeInput input;
    input.sources = ParticleArray::separate(frame.x.data(), frame.n);
    TreeOptions options;
    options.max_particles_in_box = leaf;
    options.coincident = Coincident::leaf;
    options.hulls = Hulls::never;
    options.budget = budget_ = budget;
    Stopwatch watch;
    tree_.build(input, options);
    const TreeView& view = tree_.view();
    ensure_capacity(mass_, "gravity/sorted_masses", frame.n);
    const bool softened = frame.softening.size() > 0 && frame.max_softening > 0;
    ensure_capacity(softening_, "gravity/sorted_softening", softened ? frame.n : 0);
    const std::int32_t* const ids = view.user_source_ids.data();
    Kokkos::parallel_for("gravity/sort", Kokkos::RangePolicy<HostExec>(0, frame.n),
                         [&](const Offset i) {
                             mass_(i) = frame.mass(ids[i]);
                             if (softened) softening_(i) = frame.softening(ids[i]);
                         });
    HostExec().fence();
    bodies_.n = frame.n;
    for (int d = 0; d < 3; ++d) bodies_.x[d] = view.sources.positions.data() + d * frame.n;
    bodies_.mass = mass_.data();
    bodies_.softening = softened ? softening_.data() : nullptr;
    report_.entry("tree").ms += watch.ms();
    const Stopwatch cells_watch;
    make_cells(view, bodies_, cells_);
    cells_.order = cells_.degree = 0;
    images_ = images;
    has_weakest_ = false;
    report_.entry("cells").ms += cells_watch.ms();
}

void TreeSum::set_weakest(const double* accelerations) {
    ensure_capacity(weakest_, "gravity/weakest", cells_.n);
    const std::int32_t* const ids = user_ids();
    for_each_upward("gravity/weakest", cells_, [&](CellId c) {
        double least = std::numeric_limits<double>::infinity();
        if (cells_.is_leaf(c))
            for (std::int32_t i = cells_.first(c); i < cells_.first(c) + cells_.count(c); ++i)
                least = std::min(least, accelerations[ids[i]]);
        else
            for (CellId b = cells_.first_child(c); b < cells_.first_child(c) + cells_.n_children(c);
                 ++b)
                least = std::min(least, weakest_(b));
        weakest_(c) = least;
    });
    has_weakest_ = true;
}

/// Lists are not known before they are made, and small beside the expansions.
void TreeSum::check_budget(const TreeSettings& settings) const {
    const Offset n_expansions = settings.form == FarForm::cell_to_cell ? 2 : 1;
    const Offset bytes = n_expansions * cells_.n * expansion_stride(settings.order) *
                         static_cast<Offset>(sizeof(double));
    if (budget_.allows(bytes)) return;
    throw Error(Status::budget, "gravity: expansions of order " + std::to_string(settings.order) +
                                    " in " + std::to_string(cells_.n) + " cells need " +
                                    human_bytes(bytes) + ", the budget allows " +
                                    human_bytes(budget_.allowed()));
}

void TreeSum::prepare(const TreeSettings& settings) {
    check_budget(settings);
    const Stopwatch watch;
    const int degree = far_degree(settings.form, settings.order);
    if (cells_.degree != degree) make_rho(bodies_, degree, cells_);
    if (cells_.order != settings.order) make_moments(bodies_, settings.order, cells_);
    report_.entry("moments").ms += watch.ms();
}

bool TreeSum::is_unit(CellId c, FarForm form) const {
    return cells_.is_leaf(c) ||
           (form == FarForm::cell_to_particles && cells_.count(c) <= group_size);
}

void TreeSum::take_units(FarForm form) {
    take_all(cells_, set_);
    items_.clear();
    for (CellId c = 0; c < cells_.n; ++c)
        if (is_unit(c, form) && (c == 0 || !is_unit(cells_.parent(c), form)))
            items_.push_back({c, cells_.first(c), cells_.count(c), cells_.first(c)});
    // In tree order, so that items that follow each other share sources.
    std::sort(items_.begin(), items_.end(),
              [](const Item& a, const Item& b) { return a.first < b.first; });
}

void TreeSum::take_particles(FarForm form, const std::vector<std::int32_t>& particles) {
    take_paths(cells_, particles, set_);
    items_.clear();
    for (const std::int32_t i : particles) {
        CellId c = 0;
        while (!is_unit(c, form)) {
            c = cells_.first_child(c);
            while (i >= cells_.first(c) + cells_.count(c)) ++c;
        }
        items_.push_back({c, i, 1, static_cast<std::int64_t>(items_.size())});
    }
}

FarChoice TreeSum::far_choice(const TreeSettings& settings) const {
    FarChoice choice = settings.far_choice();
    choice.weakest = has_weakest_ ? weakest_.data() : nullptr;
    return choice;
}

void TreeSum::make_lists(const TreeSettings& settings) {
    const Stopwatch watch;
    WalkRule rule;
    rule.near_pairs = near_pairs(settings);
    rule.group = group_size;
    rule.active = set_.mask();
    test_.set(cells_, far_choice(settings));
    lists_.build(cells_, test_, rule, images_);
    report_.entry("lists").ms += watch.ms();
    if (settings.form == FarForm::cell_to_particles) return;
    const Stopwatch far_watch;
    unpacked_.resize(static_cast<std::size_t>(n_workers()));
    make_locals(cells_, lists_, images_, set_, unpacked_, locals_);
    report_.entry("far").ms += far_watch.ms();
}

void TreeSum::add_far(const TreeSettings& settings, const Item& item, int worker,
                      const Sums& sums) {
    const std::int32_t i = item.first;
    const Points points{bodies_.x[0] + i, bodies_.x[1] + i, bodies_.x[2] + i, item.n};
    const Fields fields{sums.p, sums.ax, sums.ay, sums.az};
    if (settings.form == FarForm::cell_to_cell)
        return expansion_kernels().l2p(settings.order, cells_.expansion(item.unit, locals_.data()),
                                       points, fields);
    const Offset* const offsets = lists_.far().offset_data();
    const Offset first = offsets[item.unit], n = offsets[item.unit + 1] - first;
    expansion_kernels().m2p(settings.order, cells_.arrays(),
                            unpacked_[worker].of(lists_.far().value_data() + first, n, images_),
                            points, fields);
}

void TreeSum::sum_items(const TreeSettings& settings, const Sums& sums) {
    const Stopwatch watch;
    near_.resize(static_cast<std::size_t>(n_workers()));
    for (NearSum& near : near_)
        near.begin({&bodies_, &cells_, &test_, &lists_, &images_, law_of(settings, bodies_),
                    settings.float32});
    unpacked_.resize(near_.size());
    near_pairs_.assign(near_.size(), 0);
    FirstException failure;
    for_each_dynamic("gravity/near", static_cast<Offset>(items_.size()), [&](int worker, Offset k) {
        if (failure.any()) return;
        const Item& item = items_[k];
        const Sums own = sums.at(item.at);
        for (double* const to : {own.p, own.ax, own.ay, own.az}) std::fill_n(to, item.n, 0.0);
        try {
            near_[worker].collect(item.unit);
            near_pairs_[worker] += near_[worker].n_sources() * item.n;
            near_[worker].add(item.first, item.n, own);
            add_far(settings, item, worker, own);
        } catch (...) {
            failure.keep();
        }
    });
    failure.rethrow("gravity, for its lists,");
    report_.entry("near").ms += watch.ms();
}

/// Sums over items are those over all particles, or scaled to them.
TreeWork TreeSum::measure_work(FarForm form) const {
    const Offset* const far = lists_.far().offset_data();
    double n = 0, near = 0, far_pairs = 0;
    for (const std::int64_t pairs : near_pairs_) near += static_cast<double>(pairs);
    for (const Item& item : items_) {
        n += item.n;
        if (form == FarForm::cell_to_particles) {
            far_pairs += double(item.n) * static_cast<double>(far[item.unit + 1] - far[item.unit]);
            continue;
        }
        for (CellId c = item.unit;; c = cells_.parent(c)) {
            far_pairs +=
                double(item.n) / cells_.count(c) * static_cast<double>(far[c + 1] - far[c]);
            if (c == 0) break;
        }
    }
    const double scale = n > 0 ? static_cast<double>(bodies_.n) / n : 0;
    return {near * scale, far_pairs * scale};
}

TreeWork TreeSum::sum_all(const TreeSettings& settings, const Sums& sums) {
    prepare(settings);
    take_units(settings.form);
    make_lists(settings);
    sum_items(settings, sums);
    return measure_work(settings.form);
}

TreeWork TreeSum::sum_some(const TreeSettings& settings, const std::vector<std::int32_t>& particles,
                           const Sums& sums) {
    prepare(settings);
    take_particles(settings.form, particles);
    make_lists(settings);
    sum_items(settings, sums);
    return measure_work(settings.form);
}

void TreeSum::measure_scales(std::vector<double>& field, std::vector<double>& potential) const {
    field.assign(items_.size(), 0.0);
    potential.assign(items_.size(), 0.0);
    const auto add = [&](std::size_t k, double mass, double x, double y, double z, int image) {
        const std::int32_t i = items_[k].first;
        const double* const shift = images_.shift.data() + 3 * image;
        const double dx = x + shift[0] - bodies_.x[0][i], dy = y + shift[1] - bodies_.x[1][i],
                     dz = z + shift[2] - bodies_.x[2][i];
        const double r2 = dx * dx + dy * dy + dz * dz;
        if (r2 == 0) return;
        field[k] += std::abs(mass) / r2;
        potential[k] += std::abs(mass) / std::sqrt(r2);
    };
    const Csr &near = lists_.near(), &far = lists_.far();
    for_each_dynamic("gravity/scales", static_cast<Offset>(items_.size()), [&](int, Offset k) {
        for (CellId a = items_[k].unit;; a = cells_.parent(a)) {
            for (Offset e = near.offset_data()[a]; e < near.offset_data()[a + 1]; ++e) {
                const Slot s = near.value_data()[e];
                const CellId b = Source::cell(s);
                for (std::int32_t j = cells_.first(b); j < cells_.first(b) + cells_.count(b); ++j)
                    add(k, bodies_.mass[j], bodies_.x[0][j], bodies_.x[1][j], bodies_.x[2][j],
                        Source::image(s));
            }
            for (Offset e = far.offset_data()[a]; e < far.offset_data()[a + 1]; ++e) {
                const CellId b = Source::cell(far.value_data()[e]);
                add(k, cells_.mass(b), cells_.x(0, b), cells_.x(1, b), cells_.x(2, b),
                    Source::image(far.value_data()[e]));
            }
            if (a == 0) break;
        }
    });
}

void TreeSum::bound_errors(const TreeSettings& settings, double* bounds) {
    detail::bound_errors(cells_, lists_, images_, far_choice(settings), bounds_);
    for (const Item& item : items_) std::fill_n(bounds + item.first, item.n, bounds_(item.unit));
}

/// What each phase holds.
void TreeSum::report_bytes() {
    const auto held = [&](const char* entry, Offset bytes) {
        if (report_.find(entry) != nullptr) report_.entry(entry).bytes = bytes;
    };
    const auto of = [](const View<double>& view) {
        return static_cast<Offset>(view.size() * sizeof(double));
    };
    held("tree", tree_.bytes() + tree_.scratch_bytes() + of(mass_) + of(softening_));
    held("cells", cells_.bytes() - of(cells_.moments));
    held("moments", of(cells_.moments));
    held("lists", lists_.bytes() + test_.bytes());
    held("far", of(locals_));
}

Offset TreeSum::bytes() const {
    return tree_.bytes() + tree_.scratch_bytes() + cells_.bytes() + test_.bytes() + lists_.bytes() +
           static_cast<Offset>((mass_.size() + softening_.size() + weakest_.size() +
                                locals_.size() + bounds_.size()) *
                               sizeof(double));
}

}  // namespace connectivity::detail
