// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/io/gravity_file.hpp>

#include <connectivity/io/names.hpp>
#include <connectivity/io/pending_file.hpp>

#include "io/hdf5.hpp"

namespace connectivity {

const std::map<std::string, GravityMethod>& gravity_method_names() {
    static const std::map<std::string, GravityMethod> names{{"auto", GravityMethod::automatic},
                                                            {"direct", GravityMethod::direct},
                                                            {"walk", GravityMethod::walk},
                                                            {"fmm", GravityMethod::fmm}};
    return names;
}

const std::map<std::string, Acceptance>& acceptance_names() {
    static const std::map<std::string, Acceptance> names{{"field", Acceptance::field},
                                                         {"acceleration", Acceptance::acceleration},
                                                         {"geometric", Acceptance::geometric}};
    return names;
}

const std::map<std::string, NearPrecision>& near_precision_names() {
    static const std::map<std::string, NearPrecision> names{{"auto", NearPrecision::automatic},
                                                            {"float32", NearPrecision::float32},
                                                            {"float64", NearPrecision::float64}};
    return names;
}

const std::map<std::string, Softening>& softening_names() {
    static const std::map<std::string, Softening> names{{"plummer", Softening::plummer},
                                                        {"sph-exa", Softening::sph_exa}};
    return names;
}

namespace {

std::vector<Offset> offsets_of(const std::vector<Offset>& counts) {
    std::vector<Offset> offsets{0};
    for (const Offset n : counts) offsets.push_back(offsets.back() + n);
    return offsets;
}

void set_errors(hdf5::Group& group, const std::string& prefix, const GravityErrors& errors) {
    group.set(prefix + "error_rms", errors.rms);
    group.set(prefix + "error_p99", errors.p99);
    group.set(prefix + "error_max", errors.max);
}

void set_phases(hdf5::Group& group, const Report& report) {
    std::vector<std::string> phases;
    std::vector<double> seconds;
    for (const auto& entry : report.entries()) {
        phases.push_back(entry.product);
        seconds.push_back(1e-3 * entry.ms);
    }
    group.set("phases", phases);
    group.set("seconds", seconds);
}

void set_info(hdf5::Group& group, const GravityInfo& info, const GravityOptions& options) {
    group.set("method", name_of(info.method, gravity_method_names()));
    group.set<std::int32_t>("order", info.order);
    group.set("acceptance", name_of(info.acceptance, acceptance_names()));
    group.set("epsilon", info.epsilon);
    group.set("near", name_of(info.near, near_precision_names()));
    group.set("tolerance", options.tolerance);
    group.set<std::int32_t>("reached", info.reached ? 1 : 0);
    group.set("constant", options.constant);
    group.set("softening", name_of(options.softening, softening_names()));
    group.set<std::int32_t>("symmetric", options.symmetric ? 1 : 0);
    group.set<std::int64_t>("n_samples", info.n_samples);
    set_errors(group, "", info.acceleration);
    set_errors(group, "field_", info.field);
    set_errors(group, "potential_", info.potential);
    group.set<std::int64_t>("n_near", info.n_near);
    group.set<std::int64_t>("n_far", info.n_far);
}

}  // namespace

void write_gravity_file(const std::string& path, const Gravity& gravity,
                        const GravityOptions& options, const GravityLists& lists,
                        const std::string& command) {
    PendingFile file(path);
    {
        auto root = hdf5::Group::create_file(file.temporary());
        auto group = root.create_group("gravity");
        group.write("acceleration", gravity.acceleration().data(), {gravity.n(), 3});
        group.write("potential", gravity.potential().data(), {gravity.n()});
        set_info(group, gravity.info(), options);
        set_phases(group, gravity.report());
        root.set("list_names", lists.names);
        root.set("n_internal", lists.n_internal);
        root.set("list_offset", offsets_of(lists.n));
        root.set("row_offset", offsets_of(lists.n_internal));
        root.set("command", command);
        root.set("library_version", std::string(CONNECTIVITY_VERSION));
        root.flush();
    }
    file.commit();
}

}  // namespace connectivity
