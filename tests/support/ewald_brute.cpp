// SPDX-License-Identifier: BSD-3-Clause
#include <support/ewald_brute.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>

namespace connectivity::test {
namespace {

using Real = long double;
using Vector = std::array<Real, 3>;

constexpr Real pi = std::numbers::pi_v<Real>;
constexpr Real reach = 7.5L;  ///< erfc(7.5) = 3e-26

/// What is summed is in units of the cube root of the volume.
struct Frame {
    Real unit;
    Vector box;     ///< the host's lengths
    Vector length;  ///< in units
    Real alpha;

    Vector at(const std::vector<double>& x, std::size_t i) const {
        return {x[3 * i] / unit, x[3 * i + 1] / unit, x[3 * i + 2] / unit};
    }
};

struct Field {
    Real p = 0;
    Vector a{};
};

/// Adds m erfc(alpha r) / r, or what is left of it at r = 0 once 1/r is taken away.
void add_image(const Frame& frame, const Vector& r, Real m, Field& field) {
    const Real r2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2], length = std::sqrt(r2);
    const Real x = frame.alpha * length, slope = 2 * frame.alpha / std::sqrt(pi);
    if (x > reach) return;
    if (r2 == 0) {
        field.p -= m * slope;
        return;
    }
    const Real screened = std::erfc(x) / length;
    field.p += m * screened;
    const Real factor = m * (screened + slope * std::exp(-x * x)) / r2;
    for (int d = 0; d < 3; ++d) field.a[d] -= factor * r[d];
}

/// All images of a source within reach. Differences are of the host's lengths, and exact where the
/// target is close to an image.
void add_images(const Frame& frame, const Vector& difference, Real m, Field& field) {
    std::array<int, 3> first, last;
    const Real radius = reach / frame.alpha * frame.unit;
    for (int d = 0; d < 3; ++d) {
        first[d] = static_cast<int>(std::ceil((difference[d] - radius) / frame.box[d]));
        last[d] = static_cast<int>(std::floor((difference[d] + radius) / frame.box[d]));
    }
    for (int i = first[0]; i <= last[0]; ++i)
        for (int j = first[1]; j <= last[1]; ++j)
            for (int k = first[2]; k <= last[2]; ++k)
                add_image(frame,
                          {(difference[0] - i * frame.box[0]) / frame.unit,
                           (difference[1] - j * frame.box[1]) / frame.unit,
                           (difference[2] - k * frame.box[2]) / frame.unit},
                          m, field);
}

/// Wave vectors within reach, one of each pair k and -k.
std::vector<Vector> waves(const Frame& frame) {
    std::vector<Vector> found;
    const Real longest = 2 * frame.alpha * reach;
    std::array<int, 3> most;
    for (int d = 0; d < 3; ++d) most[d] = static_cast<int>(longest * frame.length[d] / (2 * pi));
    for (int i = 0; i <= most[0]; ++i)
        for (int j = i > 0 ? -most[1] : 0; j <= most[1]; ++j)
            for (int k = i > 0 || j > 0 ? -most[2] : 1; k <= most[2]; ++k) {
                const Vector wave{2 * pi * i / frame.length[0], 2 * pi * j / frame.length[1],
                                  2 * pi * k / frame.length[2]};
                if (std::hypot(wave[0], wave[1], wave[2]) <= longest) found.push_back(wave);
            }
    return found;
}

/// Adds one wave and its opposite at all targets.
void add_wave(const Frame& frame, const Vector& k, const std::vector<Vector>& y,
              const std::vector<double>& m, const std::vector<Vector>& x,
              std::vector<Field>& fields) {
    const auto phase = [&k](const Vector& r) { return k[0] * r[0] + k[1] * r[1] + k[2] * r[2]; };
    Real c = 0, s = 0;
    for (std::size_t j = 0; j < y.size(); ++j) {
        c += m[j] * std::cos(phase(y[j]));
        s += m[j] * std::sin(phase(y[j]));
    }
    const Real k2 = phase(k),
               weight = 8 * pi / k2 * std::exp(-k2 / (4 * frame.alpha * frame.alpha));
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Real cosine = std::cos(phase(x[i])), sine = std::sin(phase(x[i]));
        fields[i].p += weight * (c * cosine + s * sine);
        for (int d = 0; d < 3; ++d) fields[i].a[d] += weight * k[d] * (s * cosine - c * sine);
    }
}

}  // namespace

EwaldSums ewald_brute(const std::array<double, 3>& lengths, const std::vector<double>& y,
                      const std::vector<double>& m, const std::vector<double>& x,
                      double splitting) {
    const Real unit = std::cbrt(Real{lengths[0]} * lengths[1] * lengths[2]);
    const Frame frame{unit,
                      {lengths[0], lengths[1], lengths[2]},
                      {lengths[0] / unit, lengths[1] / unit, lengths[2] / unit},
                      splitting};
    std::vector<Vector> sources, targets;
    for (std::size_t j = 0; j < m.size(); ++j) sources.push_back(frame.at(y, j));
    for (std::size_t i = 0; 3 * i < x.size(); ++i) targets.push_back(frame.at(x, i));
    std::vector<Field> fields(targets.size());
    for (const Vector& k : waves(frame)) add_wave(frame, k, sources, m, targets, fields);
    EwaldSums sums;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        for (std::size_t j = 0; j < m.size(); ++j) {
            Vector difference;
            for (int d = 0; d < 3; ++d) difference[d] = Real{x[3 * i + d]} - Real{y[3 * j + d]};
            add_images(frame, difference, m[j], fields[i]);
            fields[i].p -= m[j] * pi / (frame.alpha * frame.alpha);
        }
        sums.p.push_back(static_cast<double>(fields[i].p / unit));
        for (int d = 0; d < 3; ++d)
            sums.a.push_back(static_cast<double>(fields[i].a[d] / (unit * unit)));
    }
    return sums;
}

}  // namespace connectivity::test
