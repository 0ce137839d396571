// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Where an image lies: x -> Q x + t with Q orthogonal, what mirrors, shifts and chains of them do
/// to positions, vectors and symmetric tensors.
///
/// Along the axes results are exact but for one rounding of the sum with t; a shift leaves vectors
/// and tensors as they are, bit for bit.

#include <array>
#include <cmath>

#include <connectivity/boundary/plane.hpp>

namespace connectivity {

struct RigidMap {
    std::array<double, 9> Q{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< rows one after the other
    std::array<double, 3> t{0, 0, 0};

    /// The mirror image in a plane.
    static RigidMap mirror(const Plane& plane);
    static RigidMap shift(const std::array<double, 3>& by) {
        return {{1, 0, 0, 0, 1, 0, 0, 0, 1}, by};
    }

    /// First this map, then `next`.
    RigidMap then(const RigidMap& next) const;

    /// Whether vectors stay as they are.
    bool is_shift() const { return Q == RigidMap{}.Q; }

    /// `in` and `out`, [Dim] each, may be the same.
    template <int Dim>
    void vector(const double* in, double* out) const {
        double sum[Dim];
        for (int a = 0; a < Dim; ++a) {
            sum[a] = 0;
            for (int b = 0; b < Dim; ++b) sum[a] += Q[3 * a + b] * in[b];
        }
        for (int a = 0; a < Dim; ++a) out[a] = sum[a];
    }

    template <int Dim>
    void position(const double* in, double* out) const {
        vector<Dim>(in, out);
        for (int a = 0; a < Dim; ++a) out[a] += t[a];
    }

    /// Q T Qᵀ of a packed symmetric tensor, [n_symmetric(Dim)] each; they may be the same.
    template <int Dim>
    void tensor(const double* in, double* out) const {
        double full[Dim][Dim], half[Dim][Dim];
        for (int a = 0, k = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b, ++k) full[a][b] = full[b][a] = in[k];
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b) {
                half[a][b] = 0;
                for (int c = 0; c < Dim; ++c) half[a][b] += Q[3 * a + c] * full[c][b];
            }
        for (int a = 0, k = 0; a < Dim; ++a)
            for (int b = a; b < Dim; ++b, ++k) {
                out[k] = 0;
                for (int c = 0; c < Dim; ++c) out[k] += half[a][c] * Q[3 * b + c];
            }
    }
};

}  // namespace connectivity
