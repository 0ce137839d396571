// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A sample of particles whose forces are known by direct summation: what errors are measured with.
///
/// One particle is drawn from each of equal stretches of the tree's order, so that every region is
/// there in proportion; which one, a seed decides. Cost: n_samples times the particles (and
/// images).

#include <connectivity/gravity/gravity.hpp>

#include "direct.hpp"
#include "lattice_field.hpp"
#include "tree_sum.hpp"

namespace connectivity::detail {

/// Errors of one sum against the sample, each [n_samples] and summarised.
struct SampleErrors {
    GravityErrors acceleration, field, potential;

    /// The 99th percentile of acceleration as it is to be feared. That of a sample is a rank among
    /// its few largest: were more than one particle in a hundred above a bound, all of a sample of
    /// 300 would be below it in one case of twenty, all but one in one of five, whatever the
    /// distribution. So the largest counts, too, at 0.7; of many particles one may be far off
    /// because its force cancels, and the largest but one counts, at 0.6.
    double feared = 0;
};

/// Separate arrays p, ax, ay, az of one length.
class SumArrays {
public:
    void resize(Offset n);
    Sums sums() const;
    double acceleration(Offset i) const;
    const double* p() const { return values_.data(); }
    double a(int axis, Offset i) const { return values_((axis + 1) * n_ + i); }
    Offset bytes() const { return static_cast<Offset>(values_.size() * sizeof(double)); }

private:
    Offset n_ = 0;
    View<double> values_;
};

class Sample {
public:
    /// Draws, and sums directly over the images. `lattice`, if not null, has gathered all
    /// particles; what it adds is part of the forces that errors are compared with, not of the
    /// errors. Throws Error{memory}.
    void draw(const TreeBodies& bodies, PairLaw law, const Images& images, LatticeField* lattice,
              int n_samples, std::uint64_t seed);

    Offset n() const { return static_cast<Offset>(places_.size()); }
    const std::vector<std::int32_t>& places() const {
        return places_;
    }  ///< in tree order, ascending
    /// sum |m|/r² and sum |m|/r at the sample's particles, to a few per cent: what errors are
    /// measured against where forces cancel. Room for them; somebody else finds them.
    std::vector<double>& field() { return field_; }
    std::vector<double>& potential() { return potential_; }

    /// Of sums over the images at the sample's particles.
    SampleErrors errors(const SumArrays& sums);
    /// Of sums at all particles, in tree order.
    SampleErrors errors_among(const SumArrays& all);

private:
    template <class Total, class Difference>
    double tail(const Total& total, const Difference& difference);
    template <class Place>
    SampleErrors compare(const SumArrays& sums, const Place& place);

    Offset n_particles_ = 0;
    std::vector<std::int32_t> places_;
    SumArrays exact_, far_;  ///< over the images, and what the lattice adds
    std::vector<double> field_, potential_;
    std::vector<double> scratch_, error_;
};

}  // namespace connectivity::detail
