// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// When a cell's expansion may stand for its particles: the criteria of gravity/options.hpp as
/// tests of the squared distance of two centres, a few multiplications each.
///
/// Invariants: a cell is never accepted by particles that may be in it (r_A + r_B < R; for groups
/// of particles r_A + r_B < R, too), nor where the softening of a pair would still matter.

#include <algorithm>
#include <cmath>

#include <connectivity/gravity/options.hpp>

#include "cells.hpp"

namespace connectivity::detail {

/// What acts on what: expansions on expansions, or expansions on the particles of a group.
enum class FarForm { cell_to_cell, cell_to_particles };

struct FarChoice {
    FarForm form = FarForm::cell_to_cell;
    Acceptance acceptance = Acceptance::field;
    int order = 2;
    double epsilon = 1e-3;
    bool symmetric = false;
    Softening softening = Softening::plummer;
    double softening_error =
        1e-5;  ///< relative error of a pair that may come of neglected softening
    const double* weakest = nullptr;  ///< [n_cells] smallest |a| in a cell, for `acceleration`
};

/// Degree q of rho: both forms neglect (q + 1) t^q first, t being rho's share of the distance.
inline int far_degree(FarForm form, int order) {
    return form == FarForm::cell_to_particles ? order + 1 : order;
}

class FarTest {
public:
    FarTest(const Cells& cells, const FarChoice& choice)
        : k_(cells),
          c_(choice),
          radius_(cells.radius.data()),
          rho_(cells.rho.data()),
          softening_(cells.softened ? cells.max_softening.data() : nullptr) {
        exponent_ = far_degree(c_.form, c_.order);
        first_term_ = (exponent_ + 1) / c_.epsilon;
        open_ = std::pow(first_term_, 1.0 / exponent_);
        wide_ = c_.acceptance == Acceptance::geometric ? 1 / c_.epsilon : 1;
        soft_ = std::sqrt(1.5 / c_.softening_error);
    }

    /// May b's expansion act on a? d2: squared distance of their centres.
    bool operator()(CellId a, CellId b, double d2) const {
        const double touch = wide_ * (radius_[a] + radius_[b]);
        if (!(d2 > touch * touch)) return false;
        if (softening_ != nullptr && !unsoftened(a, b, d2)) return false;
        if (c_.acceptance == Acceptance::geometric) return true;
        return is_accurate(a, b, d2) && (!c_.symmetric || is_accurate(b, a, d2));
    }

private:
    bool is_accurate(CellId a, CellId b, double d2) const {
        const bool particles = c_.form == FarForm::cell_to_particles;
        if (c_.acceptance == Acceptance::field) {
            const double r =
                particles ? radius_[a] + open_ * rho_[b] : open_ * (radius_[a] + rho_[b]);
            return d2 > r * r;
        }
        double ratio, power = 1;
        if (particles) {
            const double near = std::sqrt(d2) - radius_[a];
            ratio = rho_[b] / near;
        } else {
            ratio = (radius_[a] + rho_[b]) / std::sqrt(d2);
        }
        for (int k = exponent_; k > 0; k >>= 1, ratio *= ratio)
            if ((k & 1) != 0) power *= ratio;
        return first_term_ * power * k_.mass(b) < c_.weakest[a] * d2;
    }
    bool unsoftened(CellId a, CellId b, double d2) const {
        if (c_.softening == Softening::sph_exa) {
            const double reach = radius_[a] + radius_[b] + softening_[a] + softening_[b];
            return d2 > reach * reach;
        }
        const double reach = soft_ * std::max(softening_[a], softening_[b]);
        return d2 > reach * reach;
    }

    const Cells& k_;
    FarChoice c_;
    const double *radius_, *rho_, *softening_;
    int exponent_;
    double first_term_, open_, wide_, soft_;
};

}  // namespace connectivity::detail
