// SPDX-License-Identifier: BSD-3-Clause
#include "far_test.hpp"

namespace connectivity::detail {

namespace {

/// (q + 1) t^q < epsilon, solved for 1 / t.
double opening(const FarChoice& c, int degree) {
    if (c.acceptance == Acceptance::geometric) return 1 / c.epsilon;
    if (c.acceptance == Acceptance::acceleration) return 0;
    return std::pow((degree + 1) / c.epsilon, 1.0 / degree);
}

}  // namespace

void FarTest::set(const Cells& cells, const FarChoice& choice) {
    ensure_capacity(walk_, "gravity/walk", cells.n);
    k_ = &cells;
    c_ = choice;
    is_plain_ =
        choice.acceptance != Acceptance::acceleration && !choice.symmetric && !cells.softened;
    degree_ = far_degree(choice.form, choice.order);
    first_term_ = (degree_ + 1) / choice.epsilon;
    soft_ = std::sqrt(1.5 / choice.softening_error);
    const double open = opening(c_, degree_);
    const bool by_angle = c_.acceptance == Acceptance::geometric;
    const bool particles = c_.form == FarForm::cell_to_particles;
    for (CellId c = 0; c < cells.n; ++c) {
        const double r = cells.radius(c);
        walk_(c) = {{cells.x(0, c), cells.x(1, c), cells.x(2, c)},
                    r,
                    particles && !by_angle ? r : open * r,
                    open * (by_angle ? r : cells.rho(c)),
                    cells.first(c),
                    cells.count(c),
                    cells.first_child(c),
                    cells.n_children(c)};
    }
}

bool FarTest::is_accurate(CellId a, CellId b, double d2) const {
    if (k_->softened && !is_unsoftened(a, b, d2)) return false;
    if (c_.acceptance == Acceptance::acceleration)
        return is_weak(a, b, d2) && (!c_.symmetric || is_weak(b, a, d2));
    if (!c_.symmetric) return true;
    const double back = (*this)[b].as_target + (*this)[a].as_source;
    return d2 > back * back;
}

/// A light cell may be so near that the terms beyond the first neglected ones matter: they fall no
/// faster than t = (r_A + r_B) / R, and sum to at most 1 / (1 - t)² of it.
bool FarTest::is_weak(CellId a, CellId b, double d2) const {
    const bool particles = c_.form == FarForm::cell_to_particles;
    const double own = k_->radius(a), r = particles ? std::sqrt(d2) - own : std::sqrt(d2);
    const double near = particles ? 0 : own, tail = 1 - (near + k_->radius(b)) / r;
    double ratio = (near + k_->rho(b)) / r, power = 1;
    for (int q = degree_; q > 0; q >>= 1, ratio *= ratio)
        if ((q & 1) != 0) power *= ratio;
    return first_term_ * power * k_->mass(b) < c_.weakest[a] * r * r * tail * tail;
}

/// Plummer's force differs from Newton's by 3/2 e²/r²; SPH-EXA's is Newton's outside.
bool FarTest::is_unsoftened(CellId a, CellId b, double d2) const {
    const double ea = k_->max_softening(a), eb = k_->max_softening(b);
    const double reach = c_.softening == Softening::sph_exa
                             ? k_->radius(a) + k_->radius(b) + ea + eb
                             : soft_ * std::max(ea, eb);
    return d2 > reach * reach;
}

}  // namespace connectivity::detail
