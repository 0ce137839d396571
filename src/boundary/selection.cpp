// SPDX-License-Identifier: BSD-3-Clause
#include "selection.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include <connectivity/base/parallel.hpp>

namespace connectivity::detail {

namespace {

constexpr Offset chunk = few_items;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// sqrt(n·H^-2·n), rounded up; 0 for a tensor that is not positive definite, which the rebuild will
/// refuse.
template <int Dim>
double extent_along(const double* packed, const std::array<double, 3>& normal) {
    using Matrix = Eigen::Matrix<double, Dim, Dim>;
    Matrix h;
    for (int a = 0, k = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b, ++k) h(a, b) = h(b, a) = packed[k];
    const Eigen::LLT<Matrix> factor(h);
    if (!h.allFinite() || factor.info() != Eigen::Success) return 0;
    const Matrix inverse = factor.solve(Matrix::Identity());
    const Eigen::Map<const Eigen::Matrix<double, Dim, 1>> n(normal.data());
    const double slack = 64 * epsilon * h.cwiseAbs().rowwise().sum().maxCoeff() *
                         inverse.cwiseAbs().rowwise().sum().maxCoeff();
    const Eigen::Matrix<double, Dim, 1> half_axis = inverse * n;
    const double extent = half_axis.stableNorm() * (1 + slack);
    return std::isfinite(extent) ? extent : 0;
}

/// How far a node sees along the normal; values that the rebuild will refuse count as 0.
template <int Dim>
double reach_of(const GhostNodes& nodes, Offset node, const Reach& reach,
                const std::array<double, 3>& normal) {
    double length = nodes.tensor
                        ? extent_along<Dim>(nodes.support() + node * n_symmetric(Dim), normal)
                        : nodes.support()[node];
    if (!(length >= 0) || !std::isfinite(length)) length = 0;
    return (reach.kernel_extent * length + reach.skin) * reach.supports * (1 + 32 * epsilon);
}

}  // namespace

template <int Dim>
typename Selection<Dim>::Found Selection<Dim>::read_chunk(const GhostNodes& nodes, Offset first,
                                                          Offset last, double* scratch) const {
    Found found;
    for (Offset i = first; i < last; ++i) {
        const double* const x = nodes.positions() + i * Dim;
        const double reach = reach_of<Dim>(nodes, i, reach_, way_.enter.normal());
        const double rounding = way_.enter.rounding<Dim>(x);
        const double distance = way_.enter.distance<Dim>(x) + rounding;
        if (i < nodes.n_internal) {
            if (!(distance >= 0) && found.outside < 0) found.outside = i;
            if (!(reach < gap_) && found.far < 0) found.far = i;
            const double beyond = way_.exit.distance<Dim>(x) - way_.exit.rounding<Dim>(x);
            if (reach > 0) found.pull = std::max(found.pull, reach - beyond);
        }
        const double least = distance - 2 * rounding;
        scratch[i] = !(distance >= 0) ? infinity : least <= reach ? -infinity : least;
    }
    return found;
}

template <int Dim>
void Selection<Dim>::read(const GhostNodes& nodes, int list, Offset n, double* scratch) {
    const Offset n_chunks = (n + chunk - 1) / chunk;
    std::vector<Found> found(static_cast<std::size_t>(n_chunks));
    Found* const of_chunk = found.data();
    for_each_dynamic("boundary/distances", n_chunks, [&, of_chunk](int, Offset c) {
        of_chunk[c] = read_chunk(nodes, c * chunk, std::min(n, (c + 1) * chunk), scratch);
    });
    for (const Found& f : found) {
        if (f.outside >= 0 || f.far >= 0) refuse(nodes, list, f);
        pull_ = std::max(pull_, f.pull);
    }
}

template <int Dim>
void Selection<Dim>::refuse(const GhostNodes& nodes, int list, const Found& found) const {
    const Offset node = found.outside >= 0 ? found.outside : found.far;
    const double* const x = nodes.positions() + node * Dim;
    const std::string where = "boundary \"" + name_ + "\": node list " + std::to_string(list) +
                              " (\"" + nodes.name() + "\"), node " + std::to_string(node) + ": ";
    for (int d = 0; d < Dim; ++d)
        if (!std::isfinite(x[d]))
            throw Error(Status::nonfinite, where + "position[" + std::to_string(d) +
                                               "] = " + number(x[d]) + ", must be finite");
    if (found.outside >= 0)
        throw Error(Status::argument, where + "distance from the plane is " +
                                          number(way_.enter.distance<Dim>(x)) +
                                          ", must be >= 0; move_inside puts nodes back");
    throw Error(Status::half_box,
                where + "its support reaches " +
                    number(reach_of<Dim>(nodes, node, reach_, way_.enter.normal())) +
                    (reach_.supports > 1 ? " (doubled for overlap)" : "") +
                    ", must be less than the distance to the plane that faces this one, " +
                    number(gap_));
}

template <int Dim>
void Selection<Dim>::select(int list, Offset n, const double* distances, GhostLists& ghosts) const {
    const double pull = pull_;
    const Offset n_chunks = (n + chunk - 1) / chunk;
    std::vector<Offset> before(static_cast<std::size_t>(n_chunks) + 1, 0);
    Offset* const count = before.data();
    for_each_dynamic("boundary/controls/count", n_chunks, [=](int, Offset c) {
        const Offset last = std::min(n, (c + 1) * chunk);
        Offset found = 0;
        for (Offset i = c * chunk; i < last; ++i) found += distances[i] <= pull ? 1 : 0;
        count[c + 1] = found;
    });
    for (Offset c = 0; c < n_chunks; ++c) count[c + 1] += count[c];
    Slot* const controls = ghosts.append(list, before.back());
    for_each_dynamic("boundary/controls/fill", n_chunks, [=](int, Offset c) {
        const Offset last = std::min(n, (c + 1) * chunk);
        Slot* out = controls + count[c];
        for (Offset i = c * chunk; i < last; ++i)
            if (distances[i] <= pull) *out++ = static_cast<Slot>(i);
    });
}

template class Selection<1>;
template class Selection<2>;
template class Selection<3>;

}  // namespace connectivity::detail
