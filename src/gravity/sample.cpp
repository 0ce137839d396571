// SPDX-License-Identifier: BSD-3-Clause
#include "sample.hpp"

#include <algorithm>
#include <cmath>

namespace connectivity::detail {

namespace {

constexpr Offset many_particles = 5000;

/// Steele, Lea & Flood's splitmix64: numbers that depend on the place alone.
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}

double length(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

/// Ascending order is made of the errors.
GravityErrors summarise(std::vector<double>& errors) {
    if (errors.empty()) return {};
    std::sort(errors.begin(), errors.end());
    double squares = 0;
    for (const double e : errors) squares += e * e;
    const auto n = static_cast<double>(errors.size());
    const auto rank = static_cast<std::size_t>(std::ceil(0.99 * n)) - 1;
    return {std::sqrt(squares / n), errors[rank], errors.back()};
}

/// An error as a share of something that may be 0, then of something that is 0 only with it.
double share(double error, double of, double otherwise) {
    if (error == 0) return 0;
    return error / (of > 0 ? of : otherwise);
}

}  // namespace

void SumArrays::resize(Offset n) {
    ensure_capacity(values_, "gravity/sums", 4 * n);
    n_ = n;
}

Sums SumArrays::sums() const {
    double* const v = values_.data();
    return {v, v + n_, v + 2 * n_, v + 3 * n_};
}

double SumArrays::acceleration(Offset i) const { return length(a(0, i), a(1, i), a(2, i)); }

void Sample::draw(const TreeBodies& bodies, PairLaw law, const Images& images,
                  LatticeField* lattice, int n_samples, std::uint64_t seed) {
    const Offset n = std::min<Offset>(n_samples, bodies.n);
    n_particles_ = bodies.n;
    places_.resize(static_cast<std::size_t>(n));
    for (Offset k = 0; k < n; ++k) {
        const Offset first = k * bodies.n / n, last = (k + 1) * bodies.n / n;
        const std::uint64_t random = mixed(mixed(seed) + static_cast<std::uint64_t>(k));
        places_[k] = static_cast<std::int32_t>(
            first + static_cast<Offset>(random % static_cast<std::uint64_t>(last - first)));
    }
    exact_.resize(n);
    const Sums sums = exact_.sums();
    for (double* const to : {sums.p, sums.ax, sums.ay, sums.az}) std::fill_n(to, n, 0.0);
    const NearSources<double> sources{bodies.x[0], bodies.x[1],      bodies.x[2],
                                      bodies.mass, bodies.softening, bodies.n};
    for (int image = 0; image < images.n; ++image) {
        const double* const s = images.shift.data() + 3 * image;
        direct_sum(law, sources, {.which = places_.data(), .n = n, .shift = {-s[0], -s[1], -s[2]}},
                   {sums.p, sums.ax, sums.ay, sums.az}, scratch_);
    }
    far_.resize(n);
    const Sums far = far_.sums();
    for (double* const to : {far.p, far.ax, far.ay, far.az}) std::fill_n(to, n, 0.0);
    if (lattice == nullptr) return;
    scratch_.resize(3 * places_.size());
    for (int d = 0; d < 3; ++d)
        for (Offset k = 0; k < n; ++k) scratch_[d * n + k] = bodies.x[d][places_[k]];
    lattice->add({scratch_.data(), scratch_.data() + n, scratch_.data() + 2 * n, n},
                 {far.p, far.ax, far.ay, far.az});
}

/// The largest error but for particles whose force nearly cancels, as a share of the force that one
/// in ten falls short of; see SampleErrors::feared.
template <class Total, class Difference>
double Sample::tail(const Total& total, const Difference& difference) {
    if (places_.empty()) return 0;
    for (Offset k = 0; k < n(); ++k) error_[k] = total(k);
    const auto tenth = error_.begin() + n() / 10;
    std::nth_element(error_.begin(), tenth, error_.end());
    const double least = *tenth;
    for (Offset k = 0; k < n(); ++k)
        error_[k] = share(difference(k), std::max(total(k), least), field_[k]);
    std::sort(error_.begin(), error_.end());
    const bool many = n_particles_ > many_particles && n() > 1;
    return many ? 0.6 * error_.end()[-2] : 0.7 * error_.back();
}

template <class Place>
SampleErrors Sample::compare(const SumArrays& sums, const Place& place) {
    SampleErrors errors;
    error_.resize(places_.size());
    const auto of_each = [&](const auto& error) {
        for (Offset k = 0; k < n(); ++k) error_[k] = error(k);
        return summarise(error_);
    };
    const auto difference = [&](Offset k) {
        return length(sums.a(0, place(k)) - exact_.a(0, k), sums.a(1, place(k)) - exact_.a(1, k),
                      sums.a(2, place(k)) - exact_.a(2, k));
    };
    const auto total = [&](Offset k) {
        return length(exact_.a(0, k) + far_.a(0, k), exact_.a(1, k) + far_.a(1, k),
                      exact_.a(2, k) + far_.a(2, k));
    };
    errors.acceleration =
        of_each([&](Offset k) { return share(difference(k), total(k), field_[k]); });
    errors.feared = std::max(errors.acceleration.p99, tail(total, difference));
    errors.field = of_each([&](Offset k) { return share(difference(k), field_[k], 1); });
    errors.potential = of_each([&](Offset k) {
        return share(std::abs(sums.p()[place(k)] - exact_.p()[k]), potential_[k], 1);
    });
    return errors;
}

SampleErrors Sample::errors(const SumArrays& sums) {
    return compare(sums, [](Offset k) { return k; });
}

SampleErrors Sample::errors_among(const SumArrays& all) {
    return compare(all, [&](Offset k) { return Offset{places_[k]}; });
}

}  // namespace connectivity::detail
