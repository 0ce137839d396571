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

/// At least one: a single chunk wakes no threads.
Offset n_chunks_of(Offset n) { return std::max<Offset>(1, (n + chunk - 1) / chunk); }

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

/// 1 / (least eigenvalue) from above, by Gershgorin's circles; infinite or NaN where they do not
/// tell.
template <int Dim>
double extent_bound(const double* packed) {
    double least[Dim];
    for (int a = 0; a < Dim; ++a) least[a] = 0;
    for (int a = 0, k = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b, ++k) {
            least[a] += a == b ? packed[k] : -std::abs(packed[k]);
            if (a != b) least[b] -= std::abs(packed[k]);
        }
    const double smallest = *std::min_element(least, least + Dim);
    return smallest > 0 ? (1 + 16 * epsilon) / smallest : infinity;
}

/// How far a support reaches; lengths that the rebuild will refuse count as 0.
double reach_of(double length, const Reach& reach) {
    if (!(length >= 0 && length < infinity)) length = 0;
    return (reach.kernel_extent * length + reach.skin) * reach.supports * (1 + 32 * epsilon);
}

}  // namespace

template <int Dim>
typename Selection<Dim>::Place Selection<Dim>::place_of(const GhostNodes& nodes,
                                                        Offset node) const {
    const double* const x = nodes.positions() + node * Dim;
    Place place;
    place.rounding = way_.enter.rounding<Dim>(x);
    place.distance = way_.enter.distance<Dim>(x);
    place.beyond = way_.exit.distance<Dim>(x) - way_.exit.rounding<Dim>(x);
    if (!nodes.tensor) {
        place.reach = reach_of(nodes.support()[node], reach_);
        return place;
    }
    // A bound will do for a node whose support is away from both planes whatever its shape.
    const double* const packed = nodes.support() + node * n_symmetric(Dim);
    const double bound = extent_bound<Dim>(packed);
    place.reach = reach_of(bound, reach_);
    if (!(bound < infinity && place.reach < place.distance - place.rounding &&
          place.reach < place.beyond))
        place.reach = reach_of(extent_along<Dim>(packed, way_.enter.normal()), reach_);
    return place;
}

template <int Dim>
typename Selection<Dim>::Found Selection<Dim>::read_chunk(const GhostNodes& nodes, Offset first,
                                                          Offset last, double* scratch) const {
    Found found;
    for (Offset i = first; i < last; ++i) {
        const Place place = place_of(nodes, i);
        if (i < nodes.n_internal) {
            found.refused |= is_refused(place);
            if (place.reach > 0) found.pull = std::max(found.pull, place.reach - place.beyond);
        }
        const double least = place.distance - place.rounding;
        scratch[i] = !is_inside(place) ? infinity : least <= place.reach ? -infinity : least;
    }
    return found;
}

template <int Dim>
void Selection<Dim>::read(const GhostNodes& nodes, int list, Offset n, double* scratch) {
    const Offset n_chunks = n_chunks_of(n);
    std::vector<Found> found(static_cast<std::size_t>(n_chunks));
    Found* const of_chunk = found.data();
    for_each_dynamic("boundary/distances", n_chunks, [&, of_chunk](int, Offset c) {
        of_chunk[c] = read_chunk(nodes, c * chunk, std::min(n, (c + 1) * chunk), scratch);
    });
    for (const Found& f : found) {
        if (f.refused) refuse(nodes, list);
        pull_ = std::max(pull_, f.pull);
    }
}

template <int Dim>
void Selection<Dim>::refuse(const GhostNodes& nodes, int list) const {
    Offset node = 0;
    while (!is_refused(place_of(nodes, node))) ++node;
    const Place place = place_of(nodes, node);
    const std::string where = "boundary \"" + name_ + "\": node list " + std::to_string(list) +
                              " (\"" + nodes.name() + "\"), node " + std::to_string(node) + ": ";
    const double* const x = nodes.positions() + node * Dim;
    for (int d = 0; d < Dim; ++d)
        if (!std::isfinite(x[d]))
            throw Error(Status::nonfinite, where + "position[" + std::to_string(d) +
                                               "] = " + number(x[d]) + ", must be finite");
    if (!is_inside(place))
        throw Error(Status::argument, where + "distance from the plane is " +
                                          number(place.distance) +
                                          ", must be >= 0; move_inside puts nodes back");
    throw Error(Status::half_box,
                where + "its support reaches " + number(place.reach) +
                    (reach_.supports > 1 ? " (doubled for overlap)" : "") +
                    ", must be less than the distance to the plane that faces this one, " +
                    number(gap_));
}

template <int Dim>
void Selection<Dim>::select(int list, Offset n, const double* distances, GhostLists& ghosts) const {
    const double pull = pull_;
    const Offset n_chunks = n_chunks_of(n);
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
