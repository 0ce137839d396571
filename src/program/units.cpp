// SPDX-License-Identifier: BSD-3-Clause
#include "program/units.hpp"

#include <cmath>

#include <fmt/format.h>

namespace connectivity::program {

namespace {

constexpr double solar_mass = 1.98841e33;  // g

bool close_to(double a, double b) { return std::abs(a / b - 1) < 2e-3; }

std::string length_name(double cm) {
    struct Entry {
        double cm;
        const char* name;
    };
    constexpr Entry table[] = {{1, "cm"},           {1e2, "m"},         {1e5, "km"},
                               {6.957e10, "Rsun"},  {1.49598e13, "au"}, {3.08568e18, "pc"},
                               {3.08568e21, "kpc"}, {3.08568e24, "Mpc"}};
    for (const auto& entry : table)
        if (close_to(cm, entry.cm)) return entry.name;
    return fmt::format("{:.6g} cm", cm);
}

std::string mass_name(double gram) {
    if (close_to(gram, 1)) return "g";
    if (close_to(gram, 1e3)) return "kg";
    const double exponent = std::round(std::log10(gram / solar_mass));
    if (!close_to(gram, solar_mass * std::pow(10, exponent))) return fmt::format("{:.6g} g", gram);
    return exponent == 0 ? "Msun" : fmt::format("1e{:.0f} Msun", exponent);
}

}  // namespace

std::string length_unit(const Units& units) {
    if (!(units.length_cm > 0)) return {};
    return (units.comoving ? "c" : "") + length_name(units.length_cm) + (units.per_h ? "/h" : "");
}

std::string mass_unit(const Units& units) {
    if (!(units.mass_g > 0)) return {};
    return mass_name(units.mass_g) + (units.per_h ? "/h" : "");
}

std::string density_unit(const Units& units, int dim) {
    if (!units.known())
        return fmt::format("mass unit of the input / length unit of the input ^{}", dim);
    return fmt::format("{} ({})^-{}", mass_unit(units), length_unit(units), dim);
}

}  // namespace connectivity::program
