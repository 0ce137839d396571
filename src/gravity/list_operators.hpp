// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The operators of list_evaluation.hpp in solid harmonics, on particles and boxes in units in
/// which no power of a distance leaves the range of a double.
///
/// Invariants: lengths and masses are the tree's and the host's divided by powers of two, so that
/// the root's side and the sum of |m| are in (0.5, 1]. The scale of a box's expansions is a power
/// of two not below half its diagonal. Two operators on different boxes touch different memory.

#include <connectivity/gravity/list_sums.hpp>

#include "expansion_kernels.hpp"
#include "list_evaluation.hpp"
#include "near.hpp"

namespace connectivity::detail {

class ListOperators {
public:
    /// Everything but expansions and sums: checked, sorted, in the units. Throws as
    /// ListSums::evaluate.
    void prepare(const TreeView& tree, const ListMasses& masses, const ListSumOptions& options);

    void release_tree() { tree_ = {}; }

    double length() const { return length_; }
    double mass_unit() const { return mass_unit_; }
    Sums sums() const;  ///< tree order
    Offset bytes() const;

    void clear_moments(BoxId b);
    void p2m(BoxId b);
    void m2m(BoxId b, const BoxEntries& children);
    void clear_local(BoxId b);
    void m2l(BoxId b, const BoxEntries& sources);
    void p2l(int worker, BoxId b, const SourceRuns& sources);
    void l2l(BoxId b, const BoxEntries& children);
    void begin_targets(BoxId b);
    void l2p(BoxId b);
    void p2p(int worker, BoxId b, const SourceRuns& sources);
    void m2p(BoxId b, const BoxEntries& sources);

private:
    struct Own {
        std::int32_t first, n;
    };
    static Own own(const TreeParticles& particles, BoxId b) {
        return {particles.box_starts(b), particles.box_counts_nonchild(b)};
    }
    void choose_units(double total_mass);
    void sort_particles(const ListMasses& masses);
    void place_boxes();
    void reserve(const Budget& budget);
    Expansion moments(BoxId b) const { return expansion(b, moments_); }
    Expansion local(BoxId b) const { return expansion(b, locals_); }
    Expansion expansion(BoxId b, const View<double>& all) const;
    CellArrays boxes() const;
    CellList list(const BoxEntries& entries) const {
        return {entries.boxes, entries.n, entries.images, shifts_.data()};
    }
    Points targets(Own own) const;
    Fields fields(Own own) const;
    const double* target_softening() const;  ///< null for newton
    const double* gather(int worker, const SourceRuns& sources, std::int64_t& stride);
    void add_coincident(BoxId b, const SourceRuns& sources, const double* rows,
                        std::int64_t stride) const;

    TreeView tree_;
    int order_ = 0;
    std::int64_t stride_ = 0;
    PairLaw law_ = PairLaw::newton;
    double length_ = 1, mass_unit_ = 1;
    View<double> sources_;           ///< [4 or 5][n_sources]: x, y, z, mass, softening
    View<double> targets_;           ///< [3 or 4][n_targets]; empty where they are the sources
    View<double> boxes_;             ///< [4][n_boxes]: x, y, z, scale
    View<double> moments_, locals_;  ///< [n_boxes][stride]
    View<double> sums_;              ///< [4][n_targets]: p, ax, ay, az
    std::array<double, 3 * 27> shifts_{};
    std::vector<std::vector<double>> rows_;  ///< [workers] gathered sources
};

}  // namespace connectivity::detail
