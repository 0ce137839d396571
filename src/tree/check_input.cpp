// SPDX-License-Identifier: BSD-3-Clause
#include "check_input.hpp"

#include <string>

#include "check_array.hpp"

namespace connectivity::tree_detail {

namespace {

[[noreturn]] void refuse(const std::string& text) { throw Error(Status::argument, text); }

template <class Enum>
void check_enum(const char* what, Enum value, Enum last) {
    if (static_cast<int>(value) < 0 || static_cast<int>(value) > static_cast<int>(last))
        refuse(std::string(what) + " is " + std::to_string(static_cast<int>(value)) +
               ", must be in [0, " + std::to_string(static_cast<int>(last)) + "]");
}

void check_limit(const char* what, std::int32_t limit) {
    if (limit < 1)
        refuse(std::string(what) + " is " + std::to_string(limit) + ", must be in [1, 2147483647]");
}

void check_criterion(const TreeInput& input, const TreeOptions& options) {
    const bool by_weight = options.max_leaf_refine_weight.has_value();
    if (options.max_particles_in_box.has_value() == by_weight)
        refuse(std::string("max_particles_in_box and max_leaf_refine_weight are ") +
               (by_weight ? "both" : "neither") + " given, must be exactly one of them");
    const Offset n = input.sources.n + (input.targets ? input.targets->n : 0);
    if (by_weight && input.refine_weights == nullptr && n > 0)
        throw Error(Status::null,
                    "refine_weights is null, must be given with max_leaf_refine_weight");
    if (!by_weight && input.refine_weights != nullptr)
        refuse(
            "refine_weights are given with max_particles_in_box, must go with "
            "max_leaf_refine_weight");
    if (by_weight)
        check_limit("max_leaf_refine_weight", *options.max_leaf_refine_weight);
    else
        check_limit("max_particles_in_box", *options.max_particles_in_box);
}

void check_extents(const TreeInput& input, const TreeOptions& options) {
    const bool radii =
        input.sources.radii != nullptr || (input.targets && input.targets->radii != nullptr);
    if (radii && !input.targets)
        refuse("sources have radii and are the targets, too: radii need separate targets");
    if (radii && !options.stick_out_factor)
        refuse("there are radii without stick_out_factor, must be given with them, >= 0");
    if (!options.stick_out_factor) return;
    const double factor = *options.stick_out_factor;
    if (!(factor >= 0 && factor <= 1e6))
        refuse("stick_out_factor is " + number(factor) + ", must be in [0, 1e6]");
    if (!radii && factor != 0)
        refuse("stick_out_factor is " + number(factor) + " without radii, must be 0 or absent");
}

}  // namespace

void check_arguments(const TreeInput& input, const TreeOptions& options) {
    if (input.dim < 1 || input.dim > 3)
        refuse("dim is " + std::to_string(input.dim) + ", must be 1, 2 or 3");
    check_enum("coordinates", input.coordinates, CoordinateType::float64);
    check_enum("kind", options.kind, TreeKind::non_adaptive);
    check_enum("extent_norm", options.extent_norm, ExtentNorm::l2);
    check_enum("coincident", options.coincident, Coincident::leaf);
    check_enum("hulls", options.hulls, Hulls::never);
    check_array("source", input.sources, input.dim, input.coordinates);
    if (input.targets) check_array("target", *input.targets, input.dim, input.coordinates);
    const Offset n = input.sources.n + (input.targets ? input.targets->n : 0);
    if (n > max_slots)
        throw Error(Status::too_many, "there are " + std::to_string(n) +
                                          " sources and targets, must be at most " +
                                          std::to_string(max_slots));
    check_criterion(input, options);
    check_extents(input, options);
}

void check_weights(const TreeInput& input, std::int64_t limit) {
    const std::int32_t* const weights = input.refine_weights;
    const Offset n_sources = input.sources.n,
                 n = n_sources + (input.targets ? input.targets->n : 0);
    if (weights == nullptr) return;
    Offset bad = n;
    Kokkos::parallel_reduce(
        "tree/check_weights", Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
        [=](const Offset i, Offset& lowest) {
            if ((weights[i] < 0 || weights[i] > limit) && i < lowest) lowest = i;
        },
        Kokkos::Min<Offset>(bad));
    if (bad >= n) return;
    refuse("the refine weight of " +
           (bad < n_sources ? "source " + std::to_string(bad)
                            : "target " + std::to_string(bad - n_sources)) +
           " is " + std::to_string(weights[bad]) + ", must be in [0, " + std::to_string(limit) +
           "]");
}

}  // namespace connectivity::tree_detail
