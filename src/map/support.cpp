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

template <int Dim>
double largest_row_sum(const Matrix<Dim>& a) {
    return a.cwiseAbs().rowwise().sum().maxCoeff();
}

/// Largest |eigenvalue| of a symmetric matrix that is not 0, from above: exact for diagonal ones,
/// at most 1.15 times for others.
template <int Dim>
double norm_bound(const Matrix<Dim>& a) {
    const double row_sum = largest_row_sum<Dim>(a);
    const Matrix<Dim> unit = a / row_sum, square = unit * unit;
    return row_sum * std::min(1.0, std::sqrt(std::sqrt((square * square).norm())));
}

template <int Dim>
struct Inverse {
    bool positive_definite = false;
    Matrix<Dim> tensor, inverse;

    /// Relative error of the inverse and of |H r|: a few units of roundoff times the condition
    /// number. `reach` is the largest eigenvalue of the inverse, from above.
    double slack(double reach) const {
        return 64 * std::numeric_limits<double>::epsilon() * reach * largest_row_sum<Dim>(tensor);
    }
};

template <int Dim>
Inverse<Dim> invert(const double* packed) {
    Inverse<Dim> result;
    const Matrix<Dim> h = result.tensor = unpack<Dim>(packed);
    Matrix<Dim> l, inverse_l = Matrix<Dim>::Identity();
    if (!h.allFinite() || !cholesky<Dim>(h, l)) return result;
    for (int i = 0; i < Dim; ++i)  // forward substitution, column by column
        for (int j = 0; j <= i; ++j) {
            double sum = i == j ? 1.0 : 0.0;
            for (int k = j; k < i; ++k) sum -= l(i, k) * inverse_l(k, j);
            inverse_l(i, j) = sum / l(i, i);
        }
    result.positive_definite = true;
    result.inverse = inverse_l.transpose() * inverse_l;
    return result;
}

constexpr double largest_slack = 0.1;

}  // namespace

template <int Dim>
TensorSupport<Dim> tensor_support(const double* packed, HalfWidths widths) {
    TensorSupport<Dim> support;
    const Inverse<Dim> h = invert<Dim>(packed);
    if (!h.positive_definite) return support;
    const double reach = norm_bound<Dim>(h.inverse), slack = h.slack(reach);
    // A width that exceeds a limit by rounding only does not exceed it.
    for (int d = 0; d < Dim && widths == HalfWidths::all; ++d)
        support.half_width[d] = h.tensor.isDiagonal(0.0) ? 1 / h.tensor(d, d)
                                                         : h.inverse.col(d).stableNorm() *
                                                               (1 - std::min(slack, largest_slack));
    support.positive_definite = true;
    support.radius =
        slack < largest_slack ? reach * (1 + slack) : std::numeric_limits<double>::infinity();
    return support;
}

template <int Dim>
bool widen_tensor(const double* packed, double extent, double skin, double* widened) {
    const Eigen::SelfAdjointEigenSolver<Matrix<Dim>> solver(unpack<Dim>(packed));
    const auto& eigenvalues = solver.eigenvalues();  // ascending
    // Errors of the eigenvalues, of |H r| and of |W r| are at most this, relative to their axes.
    const double slack =
        64 * std::numeric_limits<double>::epsilon() * eigenvalues(Dim - 1) / eigenvalues(0);
    const double largest = extent / eigenvalues(0), unit = std::max(largest, skin);
    if (!(eigenvalues(0) > 0) || !(slack < largest_slack) || !std::isfinite(unit)) return false;
    const Eigen::Array<double, Dim, 1> axes = extent / eigenvalues.array() / unit;
    // p = trace / (q sqrt(Dim)); any p > 0 holds what must be held, also where a trace underflows.
    const double q = skin / unit, trace = std::max(axes.matrix().norm(), 1e-100);
    const double root = std::sqrt(static_cast<double>(Dim));
    const Eigen::Array<double, Dim, 1> wide =
        ((1 + q * root / trace) * axes.square() + q * (q + trace / root)).sqrt();
    const Matrix<Dim> w = solver.eigenvectors() *
                          (extent / unit / (wide * (1 + 3 * slack))).matrix().asDiagonal() *
                          solver.eigenvectors().transpose();
    for (int i = 0, k = 0; i < Dim; ++i)
        for (int j = i; j < Dim; ++j, ++k) widened[k] = 0.5 * (w(i, j) + w(j, i));
    return true;
}

template <int Dim>
double tensor_growth(const double* before, const double* after) {
    if (std::equal(before, before + n_symmetric(Dim), after)) return 0;
    const Inverse<Dim> a = invert<Dim>(before), b = invert<Dim>(after);
    if (!a.positive_definite || !b.positive_definite)
        return std::numeric_limits<double>::infinity();
    // Both inverses are rounded, and so is the test |H r| of the new tensor.
    const double a_reach = largest_row_sum<Dim>(a.inverse);
    const double b_reach = largest_row_sum<Dim>(b.inverse);
    const double a_slack = a.slack(a_reach), b_slack = b.slack(b_reach);
    if (!(std::max(a_slack, b_slack) < largest_slack))
        return std::numeric_limits<double>::infinity();
    // The new ellipsoid is inside if its inverse squared is below the old one as a quadratic form.
    const double reach = std::max(a_reach, b_reach);
    Matrix<Dim> l, room = a.inverse * a.inverse - b.inverse * b.inverse;
    room.diagonal().array() -= 4 * (a_slack + b_slack) * reach * reach;
    if (cholesky<Dim>(room, l)) return 0;
    const Matrix<Dim> difference = b.inverse - a.inverse;
    const double norm = difference.isZero(0.0) ? 0.0 : norm_bound<Dim>(difference);
    return norm + a_slack * a_reach + 2 * b_slack * b_reach;
}

template TensorSupport<1> tensor_support<1>(const double*, HalfWidths);
template TensorSupport<2> tensor_support<2>(const double*, HalfWidths);
template TensorSupport<3> tensor_support<3>(const double*, HalfWidths);
template bool widen_tensor<1>(const double*, double, double, double*);
template bool widen_tensor<2>(const double*, double, double, double*);
template bool widen_tensor<3>(const double*, double, double, double*);
template double tensor_growth<1>(const double*, const double*);
template double tensor_growth<2>(const double*, const double*);
template double tensor_growth<3>(const double*, const double*);

}  // namespace connectivity
