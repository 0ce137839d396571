// SPDX-License-Identifier: BSD-3-Clause
#include "program/gravity_describe.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <connectivity/io/names.hpp>

#include "program/units.hpp"

namespace connectivity::program {

namespace {

std::string describe_softening(const GravityInput& input, std::size_t k) {
    const auto [first, last] = input.rows(k);
    if (input.softening.size() == 0 || first == last) return "none";
    const auto* const e = input.softening.data();
    const auto [least, most] = std::minmax_element(e + first, e + last);
    return *most == 0 ? "none" : fmt::format("{:.6g} ... {:.6g}", *least, *most);
}

std::string errors_line(const char* what, const GravityErrors& errors) {
    return fmt::format("\n    {:<26}{:>11.3g}{:>11.3g}{:>11.3g}", what, errors.rms, errors.p99,
                       errors.max);
}

std::string describe_method(const GravityInfo& info) {
    if (info.method == GravityMethod::direct)
        return fmt::format("method direct: {} pairs in float64", info.n_near);
    return fmt::format(
        "method {} of order {}, acceptance {} with epsilon {:.3g}; {} near pairs in "
        "{}, {} far pairs",
        name_of(info.method, gravity_method_names()), info.order,
        name_of(info.acceptance, acceptance_names()), info.epsilon, info.n_near,
        name_of(info.near, near_precision_names()), info.n_far);
}

std::string describe_tolerance(const GravityInfo& info, double tolerance) {
    if (info.method == GravityMethod::direct)
        return fmt::format("tolerance {:g} kept: a direct sum has rounding errors only", tolerance);
    if (info.n_samples == 0) return fmt::format("tolerance {:g} not checked: no sample", tolerance);
    if (info.reached)
        return fmt::format("tolerance {:g} kept: p99 of |error of a| / |a| is {:.3g}", tolerance,
                           info.acceleration.p99);
    return fmt::format("warning: tolerance {:g} NOT kept: p99 of |error of a| / |a| is {:.3g}",
                       tolerance, info.acceleration.p99);
}

}  // namespace

std::string describe_gravity_lists(const GravityInput& input) {
    std::string text =
        fmt::format("{:<20}{:>12}{:>15}  {}", "list", "particles", "mass", "softening");
    for (std::size_t k = 0; k < input.lists.names.size(); ++k) {
        const auto [first, last] = input.rows(k);
        double mass = 0;
        for (Offset i = first; i < last; ++i) mass += input.mass(i);
        text += fmt::format("\n{:<20}{:>12}{:>15.6g}  {}", input.lists.names[k], last - first, mass,
                            describe_softening(input, k));
    }
    return text;
}

std::string describe_solution(const GravityInfo& info, const GravityOptions& options) {
    std::string text = describe_method(info);
    if (info.n_samples > 0) {
        text +=
            fmt::format("\n    {:<26}{:>11}{:>11}{:>11}",
                        fmt::format("{} particles by pairs", info.n_samples), "rms", "p99", "max");
        text += errors_line("|error of a| / |a|", info.acceleration);
        text += errors_line("|error of a| / sum m/r^2", info.field);
        text += errors_line("|error of phi| / sum m/r", info.potential);
    }
    return text + "\n" + describe_tolerance(info, options.tolerance);
}

std::string describe_sums(const Gravity& gravity, const GravityInput& input,
                          const GravityOptions& options) {
    const auto a = gravity.acceleration();
    const auto phi = gravity.potential();
    double energy = 0, force[3] = {0, 0, 0}, forces = 0;
    for (Offset i = 0; i < gravity.n(); ++i) {
        const double m = input.mass(i);
        energy += 0.5 * m * phi(i);
        for (int d = 0; d < 3; ++d) force[d] += m * a(3 * i + d);
        forces += std::abs(m) * std::hypot(a(3 * i), a(3 * i + 1), a(3 * i + 2));
    }
    const double sum = std::hypot(force[0], force[1], force[2]);
    return fmt::format(
        "potential energy (sum m phi / 2) {:.10g}\nmomentum drift |sum m a| / sum m|a| "
        "{:.3g}{}",
        energy, forces == 0 ? 0.0 : sum / forces, options.symmetric ? " (symmetric)" : "");
}

std::string describe_gravity_units(double constant, const Units& units) {
    const std::string mass = units.known() ? mass_unit(units) : "the input's mass unit",
                      length = units.known() ? "(" + length_unit(units) + ")" : "length unit";
    return fmt::format(
        "G = {0:g}: accelerations are G m/r^2, m/r^2 in {1} {2}^-2; potentials -G m/r, m/r in {1} "
        "{2}^-1",
        constant, mass, length);
}

}  // namespace connectivity::program
