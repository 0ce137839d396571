// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// When a cell's expansion may stand for its particles: the criteria of gravity/options.hpp as
/// tests of the squared distance of two centres.
///
/// Invariants: a cell is never accepted by particles that may be in it (r_A + r_B < R), nor where
/// the softening of a pair would still matter. Cost: three products a pair, 64 bytes a cell.

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
    /// Relative error of a pair's force that may come of neglected softening.
    double softening_error = 1e-5;
    const double* weakest = nullptr;  ///< [n_cells] smallest |a| in a cell, for `acceleration`
};

/// Degree q of rho: both forms neglect (q + 1) t^q first, t being rho's share of the distance.
inline int far_degree(FarForm form, int order) {
    return form == FarForm::cell_to_particles ? order + 1 : order;
}

/// What a walk asks of a cell, together.
struct alignas(64) WalkCell {
    double x[3];
    double radius;
    double as_target, as_source;  ///< R must be above the sum of the target's and the source's
    std::int32_t first, count;    ///< particles
    std::int32_t first_child, n_children;
};

class FarTest {
public:
    /// Takes up what the choice says of these cells, which must outlive its use. Throws
    /// Error{memory}.
    void set(const Cells& cells, const FarChoice& choice);

    const WalkCell& operator[](CellId c) const { return walk_.data()[c]; }
    FarForm form() const { return c_.form; }
    Offset bytes() const { return static_cast<Offset>(walk_.size() * sizeof(WalkCell)); }
    /// May b's expansion act on a? d2: squared distance of their centres.
    bool operator()(CellId a, CellId b, double d2) const {
        const WalkCell &t = (*this)[a], &s = (*this)[b];
        const double touch = t.radius + s.radius, reach = t.as_target + s.as_source;
        if (!(d2 > touch * touch) || !(d2 > reach * reach)) return false;
        return is_plain_ || is_accurate(a, b, d2);
    }

private:
    bool is_accurate(CellId a, CellId b, double d2) const;
    bool is_weak(CellId a, CellId b, double d2) const;
    bool is_unsoftened(CellId a, CellId b, double d2) const;

    const Cells* k_ = nullptr;
    FarChoice c_;
    View<WalkCell> walk_;
    bool is_plain_ = true;  ///< reach says all
    int degree_ = 0;
    double first_term_ = 0, soft_ = 0;
};

}  // namespace connectivity::detail
