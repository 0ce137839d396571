// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>

#include "solver.hpp"

namespace connectivity::detail {

namespace {

[[noreturn]] void refuse(const std::string& text) { throw Error(Status::argument, text); }

template <class Enum>
void check_enum(const char* what, Enum value, Enum last) {
    if (static_cast<int>(value) < 0 || static_cast<int>(value) > static_cast<int>(last))
        refuse(std::string(what) + " is " + std::to_string(static_cast<int>(value)) +
               ", must be in [0, " + std::to_string(static_cast<int>(last)) + "]");
}

void check_range(const char* what, double value, double least, double most) {
    if (!(value >= least && value <= most))
        refuse(std::string(what) + " is " + number(value) + ", must be in [" + number(least) +
               ", " + number(most) + "]");
}

void check_settings(const GravityOptions& o) {
    if (o.order) check_range("order", *o.order, 1, max_gravity_order);
    if (o.leaf) check_range("leaf", *o.leaf, 1, 1 << 20);
    if (o.epsilon)
        check_range("epsilon", *o.epsilon, 1e-15,
                    o.acceptance == Acceptance::geometric ? 0.95 : 1e4);
    if (o.epsilon && !o.order)
        refuse("epsilon is given without order, must be given with it: it is an error at an order");
    if (o.symmetric && o.method == GravityMethod::walk)
        refuse("symmetric is asked of a tree walk, must be of fmm, direct or automatic");
    if (o.symmetric && o.near == NearPrecision::float32)
        refuse("symmetric sums are asked in float32, must be float64 or automatic");
}

void check_previous(const GravityParticles& particles, const GravityOptions& o) {
    const auto n = static_cast<Offset>(o.previous_acceleration.size());
    if (n == 0) return;
    if (n != particles.n)
        refuse("previous_acceleration has " + std::to_string(n) + " values, must be " +
               std::to_string(particles.n) + " as there are particles");
    for (Offset i = 0; i < n; ++i)
        if (const double a = o.previous_acceleration(i); !std::isfinite(a) || a < 0)
            throw Error(std::isfinite(a) ? Status::argument : Status::nonfinite,
                        "previous_acceleration[" + std::to_string(i) + "] = " + number(a) +
                            ", must be finite and >= 0");
}

}  // namespace

void check_options(const GravityParticles& particles, const GravityOptions& o) {
    check_enum("method", o.method, GravityMethod::fmm);
    check_enum("softening", o.softening, Softening::sph_exa);
    check_enum("near", o.near, NearPrecision::float64);
    if (o.acceptance) check_enum("acceptance", *o.acceptance, Acceptance::geometric);
    check_range("tolerance", o.tolerance, 1e-12, 0.5);
    check_range("n_samples", o.n_samples, 0, 100000);
    if (!(o.constant > 0) || !std::isfinite(o.constant))
        refuse("constant is " + number(o.constant) + ", must be finite and > 0");
    check_settings(o);
    check_previous(particles, o);
}

}  // namespace connectivity::detail
