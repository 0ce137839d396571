// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Gravity by cells: tree walk or fast multipole method, for all particles or a sample of them,
/// with settings that somebody else chose.
///
/// Invariants: a particle's sums are the same but for rounding whether all are asked for or a
/// sample. Nothing is allocated before `plant`; arrays are kept for the next time.

#include <connectivity/base/report.hpp>
#include <connectivity/tree/box_tree.hpp>

#include "frame.hpp"
#include "locals.hpp"
#include "near.hpp"

namespace connectivity::detail {

/// Everything there is to choose.
struct TreeSettings {
    FarForm form = FarForm::cell_to_cell;
    int order = 6;
    Acceptance acceptance = Acceptance::field;
    double epsilon = 1e-2;
    bool float32 = false;
    bool float32_by_hand = false;
    bool symmetric = false;
    /// Relative error of a far pair's force for want of softening, as a share of epsilon: with it
    /// that error is fitted to a tolerance.
    double softening_share = 1e-3;
    Softening softening = Softening::plummer;

    FarChoice far_choice() const {
        FarChoice choice;
        choice.form = form;
        choice.acceptance = acceptance;
        choice.order = order;
        choice.epsilon = epsilon;
        choice.symmetric = symmetric;
        choice.softening = softening;
        choice.softening_error = softening_share * epsilon;
        return choice;
    }
};

/// Work of a sum over all particles; an estimate of it where only some were summed.
struct TreeWork {
    double near_pairs = 0;  ///< of particles
    double far_pairs = 0;   ///< of cells, or of particle and cell
};

class TreeSum {
public:
    /// Tree and cells of these particles. The budget holds for all that is summed later, too.
    /// Throws as BoxTree::build does.
    void plant(const Frame& frame, std::int32_t leaf, const Images& images,
               const Budget& budget = {});
    /// Smallest |a| in each cell, from lengths in the host's order; for Acceptance::acceleration.
    void set_weakest(const double* accelerations);

    /// Sums [n] in tree order.
    TreeWork sum_all(const TreeSettings& settings, const Sums& sums);
    /// Sums of some particles, given by ascending places in tree order.
    TreeWork sum_some(const TreeSettings& settings, const std::vector<std::int32_t>& particles,
                      const Sums& sums);

    /// After `sum_some`: sums of |m|/r² and |m|/r at the same particles, with the mass of a far
    /// cell at its centre.
    void measure_scales(std::vector<double>& field, std::vector<double>& potential) const;

    /// After `sum_all`: bounds [n] of the errors of accelerations, in tree order; error_bound.hpp.
    void bound_errors(const TreeSettings& settings, double* bounds);

    const Cells& cells() const { return cells_; }
    const TreeBodies& bodies() const { return bodies_; }
    const std::int32_t* user_ids() const { return tree_.view().user_source_ids.data(); }
    Report& report() { return report_; }
    void report_bytes();
    Offset bytes() const;

private:
    /// Consecutive particles of one unit, the cell whose near lists they share, and where their
    /// sums go.
    struct Item {
        CellId unit;
        std::int32_t first, n;
        std::int64_t at;
    };
    bool is_unit(CellId c, FarForm form) const;
    void take_units(FarForm form);
    void take_particles(FarForm form, const std::vector<std::int32_t>& particles);
    void check_budget(const TreeSettings& settings) const;
    void prepare(const TreeSettings& settings);
    void make_lists(const TreeSettings& settings);
    void sum_items(const TreeSettings& settings, const Sums& sums);
    void add_far(const TreeSettings& settings, const Item& item, int worker, const Sums& sums);
    FarChoice far_choice(const TreeSettings& settings) const;
    TreeWork measure_work(FarForm form) const;

    BoxTree tree_;
    Budget budget_;
    TreeBodies bodies_;
    View<double> mass_, softening_, weakest_;
    bool has_weakest_ = false;
    Cells cells_;
    FarTest test_;
    CellLists lists_;
    CellSet set_;
    Images images_;
    View<double> locals_, bounds_;
    std::vector<Item> items_;
    std::vector<NearSum> near_;  ///< one a worker
    std::vector<UnpackedList> unpacked_;
    std::vector<std::int64_t> near_pairs_;  ///< of particles, one a worker
    Report report_;
};

}  // namespace connectivity::detail
