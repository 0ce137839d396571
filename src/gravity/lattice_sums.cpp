// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_sums.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace connectivity::detail {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int max_order = 30;
constexpr int max_terms = (max_order + 1) * (max_order + 1);
/// Ewald's parameter times the cube root of the volume: waves cost less than images.
constexpr double splitting = 3;
constexpr double reach = 6.3;  ///< erfc(6.3) = 5e-19

/// Q(n + 1/2, x) / x^(n + 1/2) for n <= order, x > 0; upward: only sums of positive terms.
void upper_gammas(double x, int order, double* out) {
    const double decay = std::exp(-x);
    out[0] = std::erfc(std::sqrt(x)) / std::sqrt(x);
    for (int n = 0; n < order; ++n) out[n + 1] = (out[n] + decay / std::tgamma(n + 1.5)) / x;
}

/// gamma*(n + 1/2, x) = P(n + 1/2, x) / x^(n + 1/2) for n <= order: an entire function of x. By its
/// series at the highest degree, then downward: only sums of positive terms. Where P is near 1 by
/// 1 - Q: there the exponential would underflow at last.
void lower_gammas(double x, int order, double* out) {
    if (x > 2 * max_order) {
        upper_gammas(x, order, out);
        double power = 1 / std::sqrt(x);
        for (int n = 0; n <= order; ++n, power /= x) out[n] = power - out[n];
        return;
    }
    const double decay = std::exp(-x);
    const double a = order + 0.5;
    double term = decay / std::tgamma(a + 1), sum = term;
    for (double k = 1; term > 1e-18 * sum; ++k) sum += term *= x / (a + k);
    out[order] = sum;
    for (int n = order - 1; n >= 0; --n) out[n] = x * out[n + 1] + decay / std::tgamma(n + 1.5);
}

/// to[n,m] += factor[n] * from[n,m].
void add_scaled(int order, const double* factor, const double* from, double* to) {
    for (int n = 0, i = 0; n <= order; ++n)
        for (const int end = (n + 1) * (n + 1); i < end; ++i) to[i] += factor[n] * from[i];
}

}  // namespace

void regular_harmonics(const double r[3], int order, double* out) {
    const double x = r[0], y = r[1], z = r[2], r2 = x * x + y * y + z * z;
    double re = 1, im = 0;  // of R_mm
    for (int m = 0; m <= order; ++m) {
        double below[2] = {0, 0}, at[2] = {re, im};
        for (int n = m; n <= order; ++n) {
            const int i = m == 0 ? n * n : n * n + 2 * m - 1;
            out[i] = at[0];
            if (m > 0) out[i + 1] = at[1];
            const double scale = 1.0 / ((n + 1) * (n + 1) - m * m);
            for (int part = 0; part < 2; ++part) {
                const double above = ((2 * n + 1) * z * at[part] - r2 * below[part]) * scale;
                below[part] = at[part];
                at[part] = above;
            }
        }
        const double next = (re * x - im * y) / (2 * m + 2);
        im = (re * y + im * x) / (2 * m + 2);
        re = next;
    }
}

LatticeSums::LatticeSums(const std::array<double, 3>& lengths, const std::vector<Image>& near,
                         int order)
    : lengths_(lengths),
      near_(near),
      order_(order),
      volume_(lengths[0] * lengths[1] * lengths[2]),
      alpha_(splitting / std::cbrt(volume_)) {
    const double longest = 2 * alpha_ * reach;
    int most[3];
    for (int d = 0; d < 3; ++d) most[d] = static_cast<int>(longest * lengths[d] / (2 * pi));
    // One of each pair k and -k.
    for (int i = 0; i <= most[0]; ++i)
        for (int j = i > 0 ? -most[1] : 0; j <= most[1]; ++j)
            for (int l = i > 0 || j > 0 ? -most[2] : 1; l <= most[2]; ++l) {
                const std::array<double, 3> wave{2 * pi * i / lengths[0], 2 * pi * j / lengths[1],
                                                 2 * pi * l / lengths[2]};
                if (std::hypot(wave[0], wave[1], wave[2]) <= longest) waves_.push_back(wave);
            }
    const int n_terms = (order + 1) * (order + 1);
    harmonics_.assign(waves_.size() * n_terms, 0);
    double all[max_terms], factor[max_order + 1];
    for (std::size_t w = 0; w < waves_.size(); ++w) {
        const std::array<double, 3>& k = waves_[w];
        const double k2 = k[0] * k[0] + k[1] * k[1] + k[2] * k[2];
        factor[0] = 8 * pi / volume_ * std::exp(-k2 / (4 * alpha_ * alpha_)) / k2;
        for (int n = 1; n <= order; ++n) factor[n] = factor[n - 1] / (2 * n - 1);
        regular_harmonics(k.data(), order, all);
        add_scaled(order, factor, all, harmonics_.data() + w * n_terms);
    }
}

void LatticeSums::at(const std::array<double, 3>& d, int order, double* sums) const {
    std::fill_n(sums, (order + 1) * (order + 1), 0.0);
    add_images(d, order, sums);
    add_waves(d, order, sums);
    // T_nm = (n-m)! (n+m)! R_nm / r^(2n+1): everything so far lacks the factorials.
    for (int n = 0; n <= order; ++n)
        for (int i = n * n; i < (n + 1) * (n + 1); ++i) {
            const int m = (i - n * n + 1) / 2;
            sums[i] *= std::tgamma(n - m + 1.0) * std::tgamma(n + m + 1.0);
        }
    add_background(d, order, sums);
}

void LatticeSums::add_images(const std::array<double, 3>& d, int order, double* sums) const {
    double all[max_terms], factor[max_order + 1], power[max_order + 1];
    power[0] = alpha_;
    for (int n = 0; n < order; ++n) power[n + 1] = power[n] * alpha_ * alpha_;
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis) {
        first[axis] = static_cast<int>(std::ceil((d[axis] - reach / alpha_) / lengths_[axis]));
        last[axis] = static_cast<int>(std::floor((d[axis] + reach / alpha_) / lengths_[axis]));
    }
    const auto add = [&](const Image& image, bool is_near) {
        double r[3], r2 = 0;
        for (int axis = 0; axis < 3; ++axis) {
            r[axis] = d[axis] - image[axis] * lengths_[axis];
            r2 += r[axis] * r[axis];
        }
        const double x = alpha_ * alpha_ * r2;
        if (!is_near && x > reach * reach) return;
        is_near ? lower_gammas(x, order, factor) : upper_gammas(x, order, factor);
        for (int n = 0; n <= order; ++n) factor[n] *= is_near ? -power[n] : power[n];
        regular_harmonics(r, order, all);
        add_scaled(order, factor, all, sums);
    };
    for (const Image& image : near_) add(image, true);
    for (int i = first[0]; i <= last[0]; ++i)
        for (int j = first[1]; j <= last[1]; ++j)
            for (int k = first[2]; k <= last[2]; ++k)
                if (std::find(near_.begin(), near_.end(), Image{i, j, k}) == near_.end())
                    add({i, j, k}, false);
}

void LatticeSums::add_waves(const std::array<double, 3>& d, int order, double* sums) const {
    const int n_terms = (order_ + 1) * (order_ + 1);
    double factor[max_order + 1];
    for (std::size_t w = 0; w < waves_.size(); ++w) {
        const std::array<double, 3>& k = waves_[w];
        const double phase = k[0] * d[0] + k[1] * d[1] + k[2] * d[2];
        // Real part of (-i)^n e^(i k d).
        const double turned[4] = {std::cos(phase), std::sin(phase), -std::cos(phase),
                                  -std::sin(phase)};
        for (int n = 0; n <= order; ++n) factor[n] = turned[n % 4];
        add_scaled(order, factor, harmonics_.data() + w * n_terms, sums);
    }
}

void LatticeSums::add_background(const std::array<double, 3>& d, int order, double* sums) const {
    // The mean of the screened images, and the square that is no harmonic function.
    const double square = 2 * pi / (3 * volume_);
    sums[0] -=
        pi / (volume_ * alpha_ * alpha_) + square * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (order < 1) return;
    sums[1] += 2 * square * d[2];
    sums[2] += 2 * square * d[0];
    sums[3] += 2 * square * d[1];
}

}  // namespace connectivity::detail
