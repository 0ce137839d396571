// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <string>
#include <vector>

#include <connectivity/base/parallel.hpp>

#include "check_input.hpp"
#include "user_name.hpp"

namespace connectivity::tree_detail {

namespace {

/// Hull of particles, of what their radii reach, and whether all values are legal.
template <class Real, int Dim>
struct Bounds {
    Real lo[Dim], hi[Dim];                // with radii
    Real center_lo[Dim], center_hi[Dim];  // without
    Offset bad;                           // first particle with an illegal value

    Bounds() : bad(std::numeric_limits<Offset>::max()) {
        for (int d = 0; d < Dim; ++d) {
            lo[d] = center_lo[d] = std::numeric_limits<Real>::infinity();
            hi[d] = center_hi[d] = -std::numeric_limits<Real>::infinity();
        }
    }
    void join(const Bounds& other) {
        bad = std::min(bad, other.bad);
        for (int d = 0; d < Dim; ++d) {
            lo[d] = std::min(lo[d], other.lo[d]);
            hi[d] = std::max(hi[d], other.hi[d]);
            center_lo[d] = std::min(center_lo[d], other.center_lo[d]);
            center_hi[d] = std::max(center_hi[d], other.center_hi[d]);
        }
    }
    void add(const Particles<Real, Dim>& particles, Offset i) {
        const Real radius = particles.radius(i);
        bool good = radius >= 0 && radius <= std::numeric_limits<Real>::max();
        for (int d = 0; d < Dim; ++d) {
            const Real x = particles.position(i, d);
            good = good && std::abs(x) <= std::numeric_limits<Real>::max();
            lo[d] = std::min(lo[d], x - radius);
            hi[d] = std::max(hi[d], x + radius);
            center_lo[d] = std::min(center_lo[d], x);
            center_hi[d] = std::max(center_hi[d], x);
        }
        if (!good && i < bad) bad = i;
    }
};

constexpr Offset chunk = 16384;

template <class Real, int Dim>
Bounds<Real, Dim> bounds_of(const Particles<Real, Dim>& particles) {
    const Offset n = particles.n(), n_chunks = (n + chunk - 1) / chunk;
    std::vector<Bounds<Real, Dim>> parts(n_chunks);
    for_each_dynamic("tree/bounds", n_chunks, [&](int, Offset c) {
        Bounds<Real, Dim> part;
        for (Offset i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i) part.add(particles, i);
        parts[c] = part;
    });
    Bounds<Real, Dim> all;
    for (const auto& part : parts) all.join(part);
    return all;
}

template <class Real, int Dim>
[[noreturn]] void report_bad(const Particles<Real, Dim>& particles, Offset i) {
    for (int d = 0; d < Dim; ++d)
        if (const double x = particles.position(i, d); !std::isfinite(x))
            throw Error(Status::nonfinite, user_name(particles, i) + ": position[" +
                                               std::to_string(d) + "] = " + number(x) +
                                               ", must be finite");
    throw Error(Status::support, user_name(particles, i) + ": radius = " +
                                     number(particles.radius(i)) + ", must be finite and >= 0");
}

/// The first particle that the root box does not hold.
template <class Real, int Dim>
[[noreturn]] void report_outside(const Particles<Real, Dim>& particles, const Real* lo,
                                 const Real* hi, const std::array<bool, 3>& periodic) {
    for (Offset i = 0; i < particles.n(); ++i)
        for (int d = 0; d < Dim; ++d) {
            const Real x = particles.position(i, d),
                       radius = periodic[d] ? Real(0) : particles.radius(i);
            if (x - radius >= lo[d] && x + radius <= hi[d]) continue;
            throw Error(Status::box, user_name(particles, i) + ": position[" + std::to_string(d) +
                                         "] = " + number(x) + " with radius " + number(radius) +
                                         " must be in the root box, [" + number(lo[d]) + ", " +
                                         number(hi[d]) + "]");
        }
    throw Error(Status::internal, "no particle is outside the root box: did they change?");
}

template <class Real, int Dim>
Frame<Real, Dim> host_box(const Particles<Real, Dim>& particles, const Bounds<Real, Dim>& bounds,
                          const TreeOptions& options) {
    Frame<Real, Dim> frame{};
    Real hi[Dim];
    double widest = 0, narrowest = std::numeric_limits<double>::infinity(), largest = 0;
    for (int d = 0; d < Dim; ++d) {
        const double lo = options.bounding_box->lo[d], up = options.bounding_box->hi[d];
        frame.lo[d] = static_cast<Real>(lo);
        hi[d] = static_cast<Real>(up);
        frame.side[d] = hi[d] - frame.lo[d];
        const double width = static_cast<double>(frame.side[d]);
        if (!(width > 0) || !std::isfinite(width))
            throw Error(Status::box, "bounding_box on axis " + std::to_string(d) + " is [" +
                                         number(lo) + ", " + number(up) +
                                         "], must be finite with lo < hi");
        widest = std::max(widest, width);
        narrowest = std::min(narrowest, width);
        largest = std::max({largest, std::abs(lo), std::abs(up)});
    }
    const double rounding = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    if (widest - narrowest > rounding * largest)
        throw Error(Status::box, "bounding_box has sides from " + number(narrowest) + " to " +
                                     number(widest) + ", must be a cube");
    frame.extent = static_cast<Real>(widest);
    if (particles.n() == 0) return frame;
    for (int d = 0; d < Dim; ++d) {
        const bool periodic = options.periodic[d];
        if ((periodic ? bounds.center_lo : bounds.lo)[d] < frame.lo[d] ||
            (periodic ? bounds.center_hi : bounds.hi)[d] > hi[d])
            report_outside(particles, frame.lo, hi, options.periodic);
    }
    return frame;
}

template <class Real, int Dim>
Frame<Real, Dim> box_around(const Bounds<Real, Dim>& bounds) {
    Frame<Real, Dim> frame{};
    double widest = 0, largest = 1;
    for (int d = 0; d < Dim; ++d) {
        frame.lo[d] = bounds.lo[d];
        widest = std::max(widest, static_cast<double>(bounds.hi[d] - bounds.lo[d]));
        largest = std::max({largest, std::abs(static_cast<double>(bounds.lo[d])),
                            std::abs(static_cast<double>(bounds.hi[d]))});
    }
    // Stretched at the top, so that no particle lies on an upper face.
    frame.set_cube(static_cast<Real>(widest > 0 ? widest * (1 + 1e-4) : largest));
    if (!(frame.extent > 0) || !std::isfinite(frame.extent))
        throw Error(Status::box, "the particles with their radii reach over " + number(widest) +
                                     ", the widest side of the root box must be finite");
    return frame;
}

}  // namespace

template <class Real, int Dim>
Frame<Real, Dim> root_box(const Particles<Real, Dim>& particles, const TreeOptions& options) {
    const Bounds<Real, Dim> bounds = bounds_of(particles);
    if (bounds.bad < particles.n()) report_bad(particles, bounds.bad);
    if (options.bounding_box) return host_box(particles, bounds, options);
    if (particles.n() > 0) return box_around(bounds);
    Frame<Real, Dim> unit{};
    unit.set_cube(1);
    return unit;
}

#define CONNECTIVITY_INSTANTIATE(Real, Dim) \
    template Frame<Real, Dim> root_box(const Particles<Real, Dim>&, const TreeOptions&);
CONNECTIVITY_EACH_REAL_AND_DIM(CONNECTIVITY_INSTANTIATE)
#undef CONNECTIVITY_INSTANTIATE

}  // namespace connectivity::tree_detail
