// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What all but the near images of a periodic box, and the background, do to particles in the box.
///
/// Sum over near images of 1/r plus this field is Ewald's potential G with conducting surroundings
/// and mean 0 over the box; a particle feels its own images, too. Method: moments of the cells of a
/// regular grid, lattice sums of all orders from each cell to each other, local expansions.
///
/// Invariants: the same bits for any number of threads; sum m a = 0 to round-off; steady state
/// allocates nothing. Cost: P2M and L2P of every particle, and eight pairs of cells in the time of
/// one; tables are made once for a shape.

#include "expansion_kernels.hpp"
#include "lattice_plan.hpp"

namespace connectivity::detail {

class LatticeField {
public:
    /// Box lengths; accelerations will be wrong by at most accuracy * sum |m| / V^(2/3). Throws
    /// Error{box, memory}.
    LatticeField(const std::array<double, 3>& lengths, double accuracy);
    LatticeField(const std::array<double, 3>& lengths, LatticePlan plan);

    /// Was it made for this?
    bool serves(const std::array<double, 3>& lengths, double accuracy) const {
        return lengths == lengths_ && accuracy == accuracy_;
    }
    const LatticePlan& plan() const { return plan_; }
    /// Shifts of the box in sides, {0, 0, 0} first: images which the caller sums by pairs.
    const std::vector<LatticePlan::Image>& near_images() const { return plan_.near; }

    /// Takes the sources, at finite positions in [0, length]. Throws Error{memory}.
    void gather(const Bodies& sources);
    /// Adds to potentials (sum m/r) and accelerations of targets in the box. Throws Error{memory}.
    void add(const Points& targets, const Fields& fields);

    Offset bytes() const;

private:
    void make_tables();
    void make_moments(const Bodies& sources);
    void place_moments();
    void make_locals();
    /// Adds what acts on cell `octant` and its reflections to locals [coefficients][8].
    void sum_cells(int octant, double* locals) const;
    int reflected(int cell, int reflection) const;
    Expansion expansion_at(int cell, double* coefficients) const;

    std::array<double, 3> lengths_;
    double accuracy_ = 0;
    LatticePlan plan_;
    double scale_ = 0;   ///< of expansions: radius of a cell
    double square_ = 0;  ///< 2 pi / (3 V) in units of the scale
    std::int64_t stride_ = 0;
    View<double> sums_;   ///< [cells][stride] lattice sums by |i|, |j|, |k|
    View<double> signs_;  ///< [8][stride] of coefficients under reflections
    GridSort sort_;
    View<double> partials_;    ///< [chunks][stride + 8]
    View<double> moments_;     ///< [cells][stride + 8]; behind the coefficients sum m r²
    View<double> lanes_;       ///< [cells][coefficients][8]: moments of all reflections
    View<std::uint8_t> used_;  ///< [cells] has a reflection with particles?
    View<double> locals_;      ///< [cells][stride]
    double mass_ = 0, dipole_[3] = {}, second_ = 0;  ///< about the box's centre, in scales
};

}  // namespace connectivity::detail
