// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <limits>
#include <string>

#include "tree_objects.hpp"

namespace connectivity::capi {

namespace {

/// Component c of node i as element i * n_components + c.
template <class T>
void pack(const Columns& columns, T* out) {
    const auto copy = [=](const Offset i) {
        for (int c = 0; c < columns.n_components; ++c)
            out[i * columns.n_components + c] =
                static_cast<const T*>(columns.data[c])[i * columns.stride[c]];
    };
    Kokkos::parallel_for(
        "capi/pack", Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, columns.n), copy);
    HostExec().fence();
}

/// Elements from axis to axis where all components are one array with steps upwards, else 0.
Offset axis_stride_of(const conn_array* arrays, std::int32_t n_arrays, const Columns& columns) {
    if (n_arrays != 1 || (columns.n > 1 && columns.stride[0] < 1)) return 0;
    if (columns.n_components == 1) return 1;
    return arrays[0].stride[1] < 1 ? 0 : arrays[0].stride[1];
}

}  // namespace

void HostParticles::agree_on(std::int32_t dtype, const char* name) {
    if (dtype_ && dtype != *dtype_)
        throw Error(Status::argument, std::string(name) + ".dtype = " + std::to_string(dtype) +
                                          ", must be " + std::to_string(*dtype_) +
                                          " as in the arrays of particles before it");
    dtype_ = dtype;
}

const void* HostParticles::keep(const Columns& columns) {
    const Offset n = columns.n * columns.n_components;
    const bool is_float = columns.dtype == CONN_FLOAT32;
    const auto storage = allocate<double>("capi/particles", n + 1);  // of none, too, an address
    if (is_float)
        pack(columns, static_cast<float*>(static_cast<void*>(storage.data())));
    else
        pack(columns, storage.data());
    copies_.push_back(storage);
    return storage.data();
}

ParticleArray HostParticles::read(const conn_array* positions, std::int32_t n_arrays, int dim,
                                  const conn_array* radii, const char* name,
                                  const char* radii_name) {
    const Columns x = read_columns(positions, n_arrays, dim, name);
    agree_on(x.dtype, name);
    ParticleArray particles = ParticleArray::interleaved(x.data[0], x.n, dim);
    if (const Offset axis_stride = axis_stride_of(positions, n_arrays, x); axis_stride > 0) {
        particles.particle_stride = x.n > 1 ? x.stride[0] : 1;
        particles.axis_stride = axis_stride;
    } else {
        particles.positions = keep(x);
    }
    if (radii == nullptr) return particles;
    const HostValues r = read_values(*radii, x.n, radii_name, name);
    particles.radii = r.data;
    particles.radius_stride = r.stride;
    return particles;
}

HostValues HostParticles::read_values(const conn_array& values, Offset n, const char* name,
                                      const char* of) {
    const Columns v = read_columns(&values, 1, 1, name);
    agree_on(v.dtype, name);
    if (v.n != n)
        throw Error(Status::argument, std::string(name) + ".extent[0] = " + std::to_string(v.n) +
                                          ", must be " + std::to_string(n) + " as in " + of);
    if (n > 0 && (n == 1 || v.stride[0] >= 1)) return {v.data[0], n > 1 ? v.stride[0] : 1};
    return {keep(v), 1};
}

const std::int32_t* HostParticles::read_weights(const conn_array& weights, Offset n) {
    const WholeNumbers numbers(weights, "refine_weights");
    if (numbers.size() != n)
        throw Error(Status::argument,
                    "refine_weights.extent[0] = " + std::to_string(numbers.size()) + ", must be " +
                        std::to_string(n) + ", one for each source and target");
    if (n > 0 && weights.dtype == CONN_INT32 && (n == 1 || weights.stride[0] == 1))
        return static_cast<const std::int32_t*>(weights.data);
    weights_ = allocate<std::int32_t>("capi/refine_weights", n + 1);  // of none, too, an address
    for (Offset k = 0; k < n; ++k) {
        if (numbers[k] < 0 || numbers[k] > std::numeric_limits<std::int32_t>::max())
            throw Error(Status::argument, "refine_weights[" + std::to_string(k) +
                                              "] = " + std::to_string(numbers[k]) +
                                              ", must be in [0, max_leaf_refine_weight]");
        weights_(k) = static_cast<std::int32_t>(numbers[k]);
    }
    return weights_.data();
}

CoordinateType HostParticles::coordinates() const {
    return dtype_ == CONN_FLOAT32 ? CoordinateType::float32 : CoordinateType::float64;
}

}  // namespace connectivity::capi
