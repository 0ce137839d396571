// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string>

#include "arguments.hpp"
#include "gravity_objects.hpp"
#include "guard.hpp"
#include "objects.hpp"
#include "tree_objects.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

conn_gravity& handle_of(conn_gravity* gravity) {
    return Registry::instance().get<conn_gravity>(gravity, "gravity");
}

void read_settings(const conn_gravity_options& o, GravityOptions& options) {
    options.method = read_choice<GravityMethod>(o.method, 0, CONN_GRAVITY_FMM, "method");
    options.tolerance = o.tolerance;
    if (o.order != -1) options.order = o.order;
    if (o.epsilon != -1) options.epsilon = o.epsilon;
    if (o.acceptance != CONN_ACCEPT_AUTOMATIC)
        options.acceptance = read_choice<Acceptance>(o.acceptance, CONN_ACCEPT_FIELD,
                                                     CONN_ACCEPT_GEOMETRIC, "acceptance");
    if (o.leaf != -1) options.leaf = o.leaf;
    options.near =
        read_choice<NearPrecision>(o.near_precision, 0, CONN_NEAR_FLOAT64, "near_precision");
    options.symmetric = read_flag(o.symmetric, "options->symmetric");
    options.softening = read_choice<Softening>(o.softening, 0, CONN_SOFTENING_SPH_EXA, "softening");
    options.constant = o.constant;
    options.n_samples = o.n_samples;
    options.seed = o.seed;
    options.error_bound = read_flag(o.error_bound, "options->error_bound");
}

/// The previous accelerations are looked at where they are.
GravityOptions read_options(const conn_gravity_options* given, std::int64_t context_budget) {
    conn_gravity_options o = CONN_GRAVITY_OPTIONS_INIT;
    if (given != nullptr) o = read_struct(given, o, "options");
    GravityOptions options;
    read_settings(o, options);
    for (std::size_t d = 0; d < 3; ++d) {
        options.domain.periodic[d] =
            read_flag(o.periodic[d], "options->periodic[" + std::to_string(d) + "]");
        options.domain.lo[d] = o.box_lo[d];
        options.domain.hi[d] = o.box_hi[d];
    }
    check_count(o.previous_acceleration, o.n_previous, max_slots, "options->previous_acceleration",
                "options->n_previous");
    if (o.previous_acceleration != nullptr)
        options.previous_acceleration =
            ConstView<double>(o.previous_acceleration, static_cast<std::size_t>(o.n_previous));
    options.budget.bytes = read_budget(o.budget_bytes, context_budget);
    return options;
}

int read_dim(const conn_array* positions, std::int32_t n_positions) {
    if (positions == nullptr) throw Error(Status::null, "positions is NULL");
    if (n_positions != 1) {
        if (n_positions == 2 || n_positions == 3) return n_positions;
        throw Error(Status::argument,
                    "n_positions = " + std::to_string(n_positions) + ", must be 1, 2 or 3");
    }
    const std::int64_t dim = positions->ndim == 2 ? positions->extent[1] : 1;
    if (dim < 1 || dim > 3)
        throw Error(Status::argument,
                    "positions.extent[1] = " + std::to_string(dim) + ", must be 1, 2 or 3");
    return static_cast<int>(dim);
}

/// `keeper` holds what the host's arrays must be copied for.
GravityParticles read_particles(const conn_array* positions, std::int32_t n_positions,
                                const conn_array* masses, const conn_array* softening,
                                HostParticles& keeper) {
    const int dim = read_dim(positions, n_positions);
    const ParticleArray x =
        keeper.read(positions, n_positions, dim, nullptr, "positions", "no radii");
    const HostValues m = keeper.read_values(required(masses, "masses"), x.n, "masses", "positions");
    GravityParticles particles{.dim = dim,
                               .n = x.n,
                               .positions = x.positions,
                               .particle_stride = x.particle_stride,
                               .axis_stride = x.axis_stride,
                               .masses = m.data,
                               .mass_stride = m.stride};
    if (softening != nullptr) {
        const HostValues e = keeper.read_values(*softening, x.n, "softening", "positions");
        particles.softening = e.data;
        particles.softening_stride = e.stride;
    }
    particles.type = keeper.coordinates();
    return particles;
}

std::uint64_t next_generation() {
    static std::uint64_t last = 0;
    return ++last;
}

void show_errors(const GravityInfo& from, conn_gravity_info& out) {
    out.acceleration_rms = from.acceleration.rms;
    out.acceleration_p99 = from.acceleration.p99;
    out.acceleration_max = from.acceleration.max;
    out.field_rms = from.field.rms;
    out.field_p99 = from.field.p99;
    out.field_max = from.field.max;
    out.potential_rms = from.potential.rms;
    out.potential_p99 = from.potential.p99;
    out.potential_max = from.potential.max;
    out.reached = from.reached ? 1 : 0;
}

}  // namespace

const conn_gravity& connectivity::capi::solved_gravity(const conn_gravity* gravity) {
    const auto& ours = Registry::instance().get<const conn_gravity>(gravity, "gravity");
    if (ours.generation == 0)
        throw Error(Status::not_built, "there are no forces; call conn_gravity_solve first");
    return ours;
}

conn_status conn_gravity_options_init(conn_gravity_options* options, size_t size) {
    return guarded(__func__, [&] {
        init_struct(options, size, conn_gravity_options CONN_GRAVITY_OPTIONS_INIT, "options");
    });
}

conn_status conn_gravity_create(conn_context* context, conn_gravity** gravity) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<conn_context>(context, "context");
        required(gravity, "gravity") =
            Registry::instance().add(std::make_unique<conn_gravity>(ours.budget_bytes));
    });
}

conn_status conn_gravity_destroy(conn_gravity** gravity) {
    return guarded(__func__, [&] { Registry::instance().destroy(gravity, "gravity"); });
}

conn_status conn_gravity_solve(conn_gravity* gravity, const conn_array* positions,
                               int32_t n_positions, const conn_array* masses,
                               const conn_array* softening, const conn_gravity_options* options) {
    return guarded_with_runtime(__func__, [&] {
        conn_gravity& ours = handle_of(gravity);
        const GravityOptions choices = read_options(options, ours.context_budget);
        HostParticles keeper;
        const GravityParticles particles =
            read_particles(positions, n_positions, masses, softening, keeper);
        ours.gravity->solve(particles, choices);
        ours.dim = particles.dim;
        ours.generation = next_generation();
    });
}

conn_status conn_gravity_report_text(const conn_gravity* gravity, char* text, int64_t capacity,
                                     int64_t* length) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<const conn_gravity>(gravity, "gravity");
        copy_text_out(ours.gravity->report().text(), text, capacity, length);
    });
}

conn_status conn_gravity_release_scratch(conn_gravity* gravity) {
    return guarded_with_runtime(__func__, [&] { handle_of(gravity).gravity->release_scratch(); });
}

conn_status conn_gravity_get_info(const conn_gravity* gravity, conn_gravity_info* info) {
    return guarded_with_runtime(__func__, [&] {
        const conn_gravity& ours = solved_gravity(gravity);
        const GravityInfo& from = ours.gravity->info();
        conn_gravity_info out = read_struct(info, conn_gravity_info CONN_GRAVITY_INFO_INIT, "info");
        out.n = ours.gravity->n();
        out.generation = ours.generation;
        out.method = static_cast<std::int32_t>(from.method);
        out.order = from.order;
        out.acceptance = static_cast<std::int32_t>(from.acceptance) + CONN_ACCEPT_FIELD;
        out.near_precision = static_cast<std::int32_t>(from.near);
        out.epsilon = from.epsilon;
        out.n_samples = from.n_samples;
        out.n_near = from.n_near;
        out.n_far = from.n_far;
        show_errors(from, out);
        out.dim = ours.dim;
        out.scratch_bytes = ours.gravity->scratch_bytes();
        write_struct(info, out, out.struct_size);
    });
}
