// SPDX-License-Identifier: BSD-3-Clause
// Forces in views and in arrays of the host.

#include <cmath>
#include <limits>
#include <string>

#include "arrays.hpp"
#include "gravity_objects.hpp"
#include "guard.hpp"
#include "view_structs.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

using Loop = Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>;

/// Component c of particle i is values[i * step + c]; it goes to the columns.
struct Output {
    Columns to;
    const double* values;
    Offset step;

    double operator()(Offset i, int c) const { return values[i * step + c]; }
};

/// Throws Error unless the arrays can take all values, for n particles of n_components each.
Output read_output(const conn_array* arrays, std::int32_t n_arrays, int n_components, Offset n,
                   const ConstView<double>& values, Offset step, const char* name) {
    const Output out{read_columns(arrays, n_arrays, n_components, name), values.data(), step};
    for (std::int32_t k = 0; k < n_arrays; ++k)
        check_distinct(arrays[k], n_arrays == 1
                                      ? std::string(name)
                                      : std::string(name) + "[" + std::to_string(k) + "]");
    if (out.to.n != n)
        throw Error(Status::argument, std::string(name) +
                                          ".extent[0] = " + std::to_string(out.to.n) +
                                          ", must be " + std::to_string(n) + ", the particles");
    if (out.to.dtype != CONN_FLOAT32) return out;
    for (Offset i = 0; i < n; ++i)
        for (int c = 0; c < n_components; ++c)
            if (std::abs(out(i, c)) > static_cast<double>(std::numeric_limits<float>::max()))
                throw Error(Status::nonfinite, std::string(name) + " of particle " +
                                                   std::to_string(i) + " is " + number(out(i, c)) +
                                                   ", must be below 3.4e38 for CONN_FLOAT32");
    return out;
}

template <class T>
void write_as(const Output& out) {
    const Columns to = out.to;
    Kokkos::parallel_for("capi/gravity/copy", Loop(0, to.n), [=](const Offset i) {
        for (int c = 0; c < to.n_components; ++c)
            static_cast<T*>(const_cast<void*>(to.data[c]))[i * to.stride[c]] =
                static_cast<T>(out(i, c));
    });
    HostExec().fence();
}

void write(const Output& out) {
    if (out.to.dtype == CONN_FLOAT32)
        write_as<float>(out);
    else
        write_as<double>(out);
}

/// One array of one number each, if it is wanted.
Output read_scalars(const conn_array* array, Offset n, const ConstView<double>& values,
                    const char* name) {
    if (array == nullptr) return {};
    return read_output(array, 1, 1, n, values, 1, name);
}

}  // namespace

conn_status conn_gravity_acquire(const conn_gravity* gravity, int32_t space,
                                 conn_gravity_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_gravity& ours = solved_gravity(gravity);
        check_space(space);
        conn_gravity_view out = read_view(view, conn_gravity_view CONN_GRAVITY_VIEW_INIT);
        auto pin = std::make_unique<GravityPin>();
        pin->acceleration = ours.gravity->acceleration();
        pin->potential = ours.gravity->potential();
        pin->error_bound = ours.gravity->error_bound();
        out.n = ours.gravity->n();
        out.generation = ours.generation;
        out.space = space;
        out.acceleration = pin->acceleration.data();
        out.potential = pin->potential.data();
        if (pin->error_bound.size() > 0) out.error_bound = pin->error_bound.data();
        write_view(view, out, std::move(pin));
    });
}

conn_status conn_gravity_release(conn_gravity_view* view) {
    return guarded(__func__, [&] {
        release_view<GravityPin>(view, conn_gravity_view CONN_GRAVITY_VIEW_INIT);
    });
}

conn_status conn_gravity_copy(const conn_gravity* gravity, const conn_array* acceleration,
                              int32_t n_acceleration, const conn_array* potential,
                              const conn_array* error_bound) {
    return guarded_with_runtime(__func__, [&] {
        const conn_gravity& ours = solved_gravity(gravity);
        const Gravity& from = *ours.gravity;
        const Offset n = from.n();
        const ConstView<double> bound = from.error_bound();
        if (error_bound != nullptr && static_cast<Offset>(bound.size()) != n)
            throw Error(Status::not_built,
                        "error_bound was not asked for; solve with options->error_bound = 1");
        Output a{};
        if (acceleration != nullptr)
            a = read_output(acceleration, n_acceleration, ours.dim, n, from.acceleration(), 3,
                            "acceleration");
        const Output p = read_scalars(potential, n, from.potential(), "potential"),
                     b = read_scalars(error_bound, n, bound, "error_bound");
        write(a), write(p), write(b);
    });
}
