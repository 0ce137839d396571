// SPDX-License-Identifier: BSD-3-Clause
#include "error_bound.hpp"

#include <algorithm>
#include <cmath>

#include <connectivity/base/parallel.hpp>

namespace connectivity::detail {

namespace {

class Bound {
public:
    Bound(const Cells& cells, const Images& images, const FarChoice& choice)
        : k_(cells), shift_(images.shift.data()), c_(choice) {}

    double operator()(CellId a, Slot source) const {
        const CellId b = Source::cell(source);
        const double* const shift = shift_ + 3 * Source::image(source);
        const double d2 = k_.distance2(a, b, shift);
        const bool particles = c_.form == FarForm::cell_to_particles;
        const double far = std::sqrt(d2), r = particles ? far - k_.radius(a) : far,
                     own = particles ? 0 : k_.radius(a);
        const double t = (own + k_.radius(b)) / r, s = (own + k_.rho(b)) / r;
        const int q = far_degree(c_.form, c_.order);
        const double remainder = std::pow(s, q) * ((q + 1) / (1 - t) + t / ((1 - t) * (1 - t)));
        return k_.mass(b) *
               (remainder / (r * r) + softening(a, b, far - k_.radius(a) - k_.radius(b)));
    }

private:
    /// Plummer's force against Newton's of a unit mass at the least distance r of two particles.
    double softening(CellId a, CellId b, double r) const {
        if (!k_.softened || c_.softening == Softening::sph_exa) return 0;
        const double e = std::max(k_.max_softening(a), k_.max_softening(b));
        return 1.5 * e * e / (r * r * r * r);
    }

    const Cells& k_;
    const double* shift_;
    const FarChoice& c_;
};

}  // namespace

void bound_errors(const Cells& cells, const CellLists& lists, const Images& images,
                  const FarChoice& choice, View<double>& bounds) {
    ensure_capacity(bounds, "gravity/cell_bounds", cells.n);
    const Bound bound(cells, images, choice);
    const Offset* const offsets = lists.far().offset_data();
    const Slot* const entries = lists.far().value_data();
    for_each_dynamic("gravity/bounds", cells.n, [&](int, Offset a) {
        double sum = 0;
        for (Offset e = offsets[a]; e < offsets[a + 1]; ++e)
            sum += bound(static_cast<CellId>(a), entries[e]);
        bounds(a) = sum;
    });
    for (CellId c = 1; c < cells.n; ++c) bounds(c) += bounds(cells.parent(c));
}

}  // namespace connectivity::detail
