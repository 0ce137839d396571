// SPDX-License-Identifier: BSD-3-Clause
// Files as each format has them, but for what the maker spoils.
#include "hdf5_maker.hpp"

namespace connectivity::test {

void Hdf5Maker::node_file() {
    const int dim = 1 + random_.below(3);
    const auto d = static_cast<std::size_t>(dim);
    attribute("/", "dim", {double(dim)});
    attribute("/", "kernel_extent", {2});
    if (random_.chance(0.3)) {
        attribute("/", "periodic", std::vector<double>(d, 1));
        attribute("/", "box_lo", std::vector<double>(d, 0));
        attribute("/", "box_hi", std::vector<double>(d, 4));
    }
    const int n_lists = random_.below(3) + 1;
    for (int k = 0; k < n_lists; ++k) {
        const std::string list = std::string("node_lists/") + "abc"[k];
        attribute(list, "order", {double(k)});
        attribute(list, "n_internal", {double(n_ - (n_ > 2 && random_.chance(0.3) ? 1 : 0))});
        dataset(list + "/positions", {n_, d});
        if (random_.chance(0.7))
            dataset(list + "/h", {n_});
        else
            dataset(list + "/H", {n_, d * (d + 1) / 2});
        for (const std::string name : {"/mass", "/softening", "/global_id"})
            if (random_.chance(0.3)) dataset(list + name, {n_}, name == "/global_id");
    }
}

void Hdf5Maker::particle_type(const std::string& name, const char* h, const char* density) {
    dataset(name + "/Coordinates", {n_, 3});
    if (random_.chance(0.8)) dataset(name + "/" + h, {n_});
    if (random_.chance(0.4)) dataset(name + "/Masses", {n_});
    if (random_.chance(0.3)) dataset(name + "/" + density, {n_});
    if (random_.chance(0.4)) dataset(name + "/ParticleIDs", {n_}, true);
}

void Hdf5Maker::gadget() {
    attribute("Header", "BoxSize", {random_.chance(0.5) ? 0.0 : 8.0});
    attribute("Header", "MassTable", {0, 1, 0, 0, 0, 0});
    attribute("Header", "NumPart_ThisFile", {double(n_), double(n_), 0, 0, 0, 0});
    attribute("Header", "NumPart_Total", {double(n_), double(n_), 0, 0, 0, 0});
    attribute("Header", "NumFilesPerSnapshot", {1});
    if (random_.chance(0.3)) text("Config", "PERIODIC", "");
    if (random_.chance(0.2)) text("Config", random_.chance(0.5) ? "TWODIMS" : "ONEDIMS", "");
    if (random_.chance(0.2)) attribute("Config", "LONG_X", {2});
    if (random_.chance(0.2)) attribute("Config", "LONG_Y_BITS", {1});
    if (random_.chance(0.3)) attribute("Parameters", "UnitLength_in_cm", {3e21});
    if (random_.chance(0.3)) attribute("Parameters", "ComovingIntegrationOn", {1});
    particle_type("PartType0", "SmoothingLength", "Density");
    if (random_.chance(0.4)) particle_type("PartType1", "SmoothingLength", "Density");
}

void Hdf5Maker::swift() {
    text("Code", "Code", "SWIFT");
    attribute("Header", "BoxSize", {8, 8, 8});
    attribute("Header", "Dimension", {double(1 + random_.below(3))});
    const char* kernels[] = {"Cubic spline (M4)", "Wendland C2", "Wendland C6", "no kernel", ""};
    text("HydroScheme", "Kernel function", random_.pick(kernels));
    if (random_.chance(0.5))
        text("Parameters", "InitialConditions:periodic", random_.chance(0.5) ? "0" : "1");
    if (random_.chance(0.3)) attribute("Units", "Unit length in cgs (U_L)", {3e24});
    if (random_.chance(0.3)) attribute("Cosmology", "Cosmological run", {1});
    particle_type("PartType0", "SmoothingLengths", "Densities");
    if (random_.chance(0.3)) dataset("PartType5/DynamicalMasses", {n_});
}

void Hdf5Maker::h5part() {
    const int n_steps = 1 + random_.below(2), dim = 1 + random_.below(3);
    for (int k = 0; k < n_steps; ++k) {
        const std::string step = k == 0 ? "Step#0" : "Step#7";
        for (int d = 0; d < dim; ++d) dataset(step + "/" + "xyz" [d], { n_ });
        for (const std::string name : {"/h", "/m", "/rho", "/id"})
            if (random_.chance(0.7)) dataset(step + name, {n_}, name == "/id");
        if (random_.chance(0.4)) {
            attribute(step, "box", {0, 8, 0, 8, 0, 8});
            attribute(step, "boundaryType", {1, 1, 0});
        }
    }
}

void Hdf5Maker::lists_case() {
    const hsize_t dim = 1 + random_.below(3);
    dataset("in_sources", {n_, dim});
    const bool has_targets = random_.chance(0.6), has_weights = random_.chance(0.2);
    if (has_targets) {
        dataset("in_targets", {n_, dim});
        if (random_.chance(0.4)) dataset("in_source_radii", {n_});
        if (random_.chance(0.6)) dataset("in_target_radii", {n_});
    }
    if (has_weights) dataset("in_refine_weights", {has_targets ? 2 * n_ : n_}, true);
    const char* entries[] = {
        "\"kind\": \"non-adaptive\"",
        "\"kind\": \"adaptive-level-restricted\"",
        "\"norm\": \"l2\"",
        "\"n_away\": 2",
        "\"crit\": \"static_l2\"",
        "\"crit\": \"static_linf\"",
        "\"minsrc\": 3",
        "\"f32\": true",
        "\"notrav\": true",
        "\"sof\": 1e300",
        "\"n_away\": 4294967297",
        "\"leaf\": null",
        "\"kind\": []",
        "\"d\": 2",
    };
    std::string params = has_weights ? "{\"maxw\": 9" : "{\"leaf\": 4";
    if (random_.chance(0.7)) params += ", \"sof\": 0.25";
    for (int k = 0; k < 3 && random_.chance(0.5); ++k)
        params += std::string(", ") + random_.pick(entries);
    if (random_.chance(0.95)) params += "}";
    if (random_.chance(0.9)) text("/", "params", params);
}

}  // namespace connectivity::test
