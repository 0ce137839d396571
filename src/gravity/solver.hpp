// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// One solution after another: chooses, sums, checks on the sample, and hands over.
///
/// Invariant: a solution is changed by the last step alone, which cannot fail.

#include <memory>

#include "choice.hpp"
#include "lattice_field.hpp"

namespace connectivity::detail {

struct Solution {
    Offset n = 0;
    View<double> acceleration;  ///< [n][3]
    View<double> potential;     ///< [n]
    View<double> bound;         ///< [n] where asked for
    bool has_bound = false;
    GravityInfo info;
    Report report;
};

class Solver {
public:
    void solve(const GravityParticles& particles, const GravityOptions& options,
               Solution& solution);
    Offset bytes() const;

private:
    void make_lattice(double tolerance);
    void add_lattice();
    void solve_direct(const GravityOptions& options, GravityInfo& info);
    /// false: direct summation would be faster.
    bool solve_by_cells(const GravityOptions& options, GravityInfo& info);
    bool can_solve_by_cells(const GravityOptions& options, GravityInfo& info);
    TreeSettings first_settings(const GravityOptions& options) const;
    void find_weakest(const GravityOptions& options, const TreeSettings& settings);
    TreeWork sum_until_reached(const GravityOptions& options, TreeSettings& settings,
                               GravityInfo& info);
    void report_bytes();
    void check_finite(long double force, long double potential) const;
    void hand_over(const GravityOptions& options, const GravityInfo& info, Solution& solution);
    PairLaw law(const GravityOptions& options) const;

    Frame frame_;
    TreeSum tree_;
    Sample sample_;
    SumArrays sums_, trial_;
    View<double> bounds_;  ///< [n] where asked for, in the order of the sums
    Images images_;
    std::unique_ptr<LatticeField> lattice_;
    const std::int32_t* user_ids_ = nullptr;  ///< of sums; null: in the host's order
    std::vector<double> scratch_;
    Report report_;
};

/// Settings that contradict each other or the particles. Throws Error{argument, unsupported}.
void check_options(const GravityParticles& particles, const GravityOptions& options);

}  // namespace connectivity::detail
