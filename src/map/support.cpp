// SPDX-License-Identifier: BSD-3-Clause
#include "support.hpp"

#include <algorithm>

#include <Eigen/Dense>

namespace connectivity {

namespace {

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

template <int Dim>
Matrix<Dim> unpack(const double* h) {
    Matrix<Dim> m;
    for (int i = 0, k = 0; i < Dim; ++i)
        for (int j = i; j < Dim; ++j, ++k) m(i, j) = m(j, i) = h[k];
    return m;
}

/// Lower Cholesky factor; false if a pivot is not clearly positive.
template <int Dim>
bool cholesky(const Matrix<Dim>& a, Matrix<Dim>& l) {
    l.setZero();
    for (int j = 0; j < Dim; ++j) {
        double pivot = a(j, j);
        for (int k = 0; k < j; ++k) pivot -= l(j, k) * l(j, k);
        if (!(pivot > 1e-14 * a(j, j)) || !(a(j, j) > 0) || !std::isfinite(pivot)) return false;
        l(j, j) = std::sqrt(pivot);
        for (int i = j + 1; i < Dim; ++i) {
            double sum = a(i, j);
            for (int k = 0; k < j; ++k) sum -= l(i, k) * l(j, k);
            l(i, j) = sum / l(j, j);
        }
    }
    return true;
}

/// Largest eigenvalue of a symmetric positive matrix from above: exact for diagonal ones, at
/// most 1.15 times for others.
template <int Dim>
double norm_bound(const Matrix<Dim>& a) {
    const double row_sum = a.cwiseAbs().rowwise().sum().maxCoeff();
    const Matrix<Dim> unit = a / row_sum, square = unit * unit;
    return row_sum * std::min(1.0, std::sqrt(std::sqrt((square * square).norm())));
}

}  // namespace

template <int Dim>
TensorSupport<Dim> tensor_support(const double* packed) {
    TensorSupport<Dim> support;
    const Matrix<Dim> h = unpack<Dim>(packed);
    Matrix<Dim> l, inverse_l = Matrix<Dim>::Identity();
    if (!h.allFinite() || !cholesky<Dim>(h, l)) return support;
    for (int i = 0; i < Dim; ++i)  // forward substitution, column by column
        for (int j = 0; j <= i; ++j) {
            double sum = i == j ? 1.0 : 0.0;
            for (int k = j; k < i; ++k) sum -= l(i, k) * inverse_l(k, j);
            inverse_l(i, j) = sum / l(i, i);
        }
    const Matrix<Dim> inverse = inverse_l.transpose() * inverse_l;
    // Inverse and |H r|² carry a relative error of a few units of roundoff times the condition
    // number.
    const double reach = norm_bound<Dim>(inverse), condition = reach * norm_bound<Dim>(h);
    const double slack = 64 * std::numeric_limits<double>::epsilon() * condition;
    // A width that exceeds a limit by rounding only does not exceed it.
    for (int d = 0; d < Dim; ++d)
        support.half_width[d] = h.isDiagonal(0.0)
                                    ? 1 / h(d, d)
                                    : inverse.col(d).stableNorm() * (1 - std::min(slack, 0.1));
    support.positive_definite = true;
    support.radius = slack < 0.1 ? reach * (1 + slack) : std::numeric_limits<double>::infinity();
    return support;
}

template TensorSupport<1> tensor_support<1>(const double*);
template TensorSupport<2> tensor_support<2>(const double*);
template TensorSupport<3> tensor_support<3>(const double*);

}  // namespace connectivity
