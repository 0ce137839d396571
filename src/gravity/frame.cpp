// SPDX-License-Identifier: BSD-3-Clause
#include "frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <connectivity/base/parallel.hpp>

#include "lattice_wrap.hpp"
#include "tree/check_array.hpp"

namespace connectivity::detail {

namespace {

using tree_detail::check_array;
using tree_detail::element;

constexpr Offset chunk = 8192;

/// What one pass over the particles finds; `bad` is the first particle with a value that is
/// refused.
struct Survey {
    std::array<double, 3> lo, hi;
    double largest = 0;  ///< |coordinate|
    double mass = 0, softening = 0;
    Offset bad = max_slots + 1;

    Survey() {
        lo.fill(std::numeric_limits<double>::infinity());
        hi.fill(-std::numeric_limits<double>::infinity());
    }
    void join(const Survey& other) {
        for (int d = 0; d < 3; ++d) {
            lo[d] = std::min(lo[d], other.lo[d]);
            hi[d] = std::max(hi[d], other.hi[d]);
        }
        largest = std::max(largest, other.largest);
        mass += other.mass;
        softening = std::max(softening, other.softening);
        bad = std::min(bad, other.bad);
    }
};

class Reader {
public:
    explicit Reader(const GravityParticles& particles) : p_(particles) {}

    double position(Offset i, int d) const {
        return d < p_.dim
                   ? element(p_.positions, p_.type, i * p_.particle_stride + d * p_.axis_stride)
                   : 0.0;
    }
    double mass(Offset i) const { return element(p_.masses, p_.type, i * p_.mass_stride); }
    double softening(Offset i) const {
        return p_.softening == nullptr ? 0.0
                                       : element(p_.softening, p_.type, i * p_.softening_stride);
    }
    bool is_good(Offset i) const {
        bool good = std::isfinite(mass(i)) && std::isfinite(softening(i)) && softening(i) >= 0;
        for (int d = 0; d < p_.dim; ++d) good = good && std::isfinite(position(i, d));
        return good;
    }
    [[noreturn]] void refuse(Offset i) const;

    Survey survey(Offset first, Offset last) const {
        Survey s;
        for (Offset i = first; i < last; ++i) {
            if (!is_good(i)) {
                s.bad = i;
                return s;
            }
            for (int d = 0; d < 3; ++d) {
                const double x = position(i, d);
                s.lo[d] = std::min(s.lo[d], x);
                s.hi[d] = std::max(s.hi[d], x);
                s.largest = std::max(s.largest, std::abs(x));
            }
            s.mass += std::abs(mass(i));
            s.softening = std::max(s.softening, softening(i));
        }
        return s;
    }

private:
    const GravityParticles& p_;
};

void Reader::refuse(Offset i) const {
    const std::string who = "particle " + std::to_string(i) + ": ";
    for (int d = 0; d < p_.dim; ++d)
        if (const double x = position(i, d); !std::isfinite(x))
            throw Error(Status::nonfinite, who + "position[" + std::to_string(d) +
                                               "] = " + number(x) + ", must be finite");
    if (!std::isfinite(mass(i)))
        throw Error(Status::nonfinite, who + "mass = " + number(mass(i)) + ", must be finite");
    const double e = softening(i);
    throw Error(std::isfinite(e) ? Status::argument : Status::nonfinite,
                who + "softening = " + number(e) + ", must be finite and >= 0");
}

Offset n_chunks(Offset n) { return (n + chunk - 1) / chunk; }

/// Chunks are joined in order, so that the sum of masses is the same for any number of threads.
Survey survey_all(const Reader& reader, Offset n) {
    std::vector<Survey> parts(static_cast<std::size_t>(n_chunks(n)));
    for_each_dynamic("gravity/survey", n_chunks(n), [&](int, Offset c) {
        parts[c] = reader.survey(c * chunk, std::min(n, (c + 1) * chunk));
    });
    Survey all;
    for (const Survey& part : parts) all.join(part);
    if (all.bad <= max_slots) reader.refuse(all.bad);
    return all;
}

void check_arrays(const GravityParticles& p) {
    if (p.dim < 1 || p.dim > 3)
        throw Error(Status::argument, "dim is " + std::to_string(p.dim) + ", must be in [1, 3]");
    check_array("particle",
                {.positions = p.positions,
                 .n = p.n,
                 .particle_stride = p.particle_stride,
                 .axis_stride = p.axis_stride},
                p.dim, p.type);
    check_array("mass", {.positions = p.masses, .n = p.n, .particle_stride = p.mass_stride}, 1,
                p.type);
    if (p.softening != nullptr)
        check_array("softening",
                    {.positions = p.softening, .n = p.n, .particle_stride = p.softening_stride}, 1,
                    p.type);
}

/// The power of two u with value / u in (0.5, 1]; 1 for 0.
double unit_of(double value) {
    if (value == 0) return 1;
    int exponent = 0;
    if (std::frexp(value, &exponent) == 0.5) --exponent;
    return std::ldexp(1.0, std::clamp(exponent, -1000, 1000));
}

void check_domain(const GravityParticles& p, const Domain& domain) {
    domain.check(p.dim);
    if (domain.any_periodic(p.dim) &&
        (p.dim != 3 || !domain.periodic[0] || !domain.periodic[1] || !domain.periodic[2]))
        throw Error(Status::unsupported,
                    "gravity is periodic along some axes and open along others, must be open or "
                    "periodic along all three");
}

}  // namespace

void make_frame(const GravityParticles& particles, const GravityOptions& options, Frame& frame) {
    check_arrays(particles);
    check_domain(particles, options.domain);
    const Reader reader(particles);
    const Offset n = frame.n = particles.n;
    const Survey found = survey_all(reader, n);
    double extent = 0;
    frame.periodic = options.domain.any_periodic(particles.dim);
    for (int d = 0; d < 3 && n > 0; ++d)
        extent =
            std::max(extent, frame.periodic ? options.domain.length(d) : found.hi[d] - found.lo[d]);
    if (!std::isfinite(extent) || !std::isfinite(found.mass))
        throw Error(Status::argument, "the particles are " + number(extent) +
                                          " wide and their "
                                          "masses sum to " +
                                          number(found.mass) + ", must be finite");
    // Where all lie close together, how far from the origin and how softened decides.
    frame.length = std::max({unit_of(extent), unit_of(found.largest) * 0x1p-400,
                             found.softening > 0 ? unit_of(found.softening) * 0x1p-40 : 0});
    frame.mass_unit = unit_of(found.mass);
    frame.max_softening = found.softening / frame.length;
    for (int d = 0; d < 3; ++d) frame.box[d] = options.domain.length(d) / frame.length;
    ensure_capacity(frame.x, "gravity/positions", 3 * n);
    ensure_capacity(frame.mass, "gravity/masses", n);
    ensure_capacity(frame.softening, "gravity/softening", found.softening > 0 ? n : 0);
    for_each_dynamic("gravity/frame", n_chunks(n), [&](int, Offset c) {
        for (Offset i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i) {
            for (int d = 0; d < 3; ++d)
                frame.x(d * n + i) =
                    frame.periodic
                        ? wrap_into_box(reader.position(i, d) / frame.length,
                                        options.domain.lo[d] / frame.length, frame.box[d])
                        : reader.position(i, d) / frame.length;
            frame.mass(i) = reader.mass(i) / frame.mass_unit;
            if (found.softening > 0) frame.softening(i) = reader.softening(i) / frame.length;
        }
    });
}

}  // namespace connectivity::detail
