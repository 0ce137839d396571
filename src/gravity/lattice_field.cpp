// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <connectivity/base/parallel.hpp>

#include "lattice_kernels.hpp"
#include "lattice_sums.hpp"

namespace connectivity::detail {
namespace {

constexpr int max_terms = n_coefficients(max_expansion_order);
constexpr Offset chunk_size = GridSort::chunk_size;

/// Of coefficient i of degree n when axes in `reflection` are turned round: z -> -z gives
/// (-1)^(n+m), y -> -y the conjugate, x -> -x (-1)^m times the conjugate.
double sign_of(int reflection, int n, int i) {
    const int m = (i - n * n + 1) / 2;
    const bool imaginary = i > n * n && (i - n * n) % 2 == 0;
    int turns = 0;
    if ((reflection & 1) != 0) turns += m + (imaginary ? 1 : 0);
    if ((reflection & 2) != 0) turns += imaginary ? 1 : 0;
    if ((reflection & 4) != 0) turns += n + m;
    return turns % 2 == 0 ? 1 : -1;
}

/// Coordinates of particles of a chunk, and what is found there.
struct Gathered {
    double x[3][chunk_size], m[chunk_size];
    double p[chunk_size], a[3][chunk_size];
};

}  // namespace

LatticeField::LatticeField(const std::array<double, 3>& lengths, double accuracy)
    : LatticeField(lengths, plan_lattice(lengths, accuracy)) {
    accuracy_ = accuracy;
}

LatticeField::LatticeField(const std::array<double, 3>& lengths, LatticePlan plan)
    : lengths_(lengths), plan_(std::move(plan)), stride_(expansion_stride(plan_.order)) {
    const auto& side = plan_.grid.side;
    scale_ = std::hypot(side[0], side[1], side[2]) / 2;
    square_ = 2 * std::numbers::pi / 3 / (lengths[0] / scale_ * (lengths[1] / scale_)) /
              (lengths[2] / scale_);
    signs_ = allocate_zeroed<double>("gravity/lattice/signs", n_reflections * stride_);
    for (int g = 0; g < n_reflections; ++g)
        for (int n = 0; n <= plan_.order; ++n)
            for (int i = n * n; i < (n + 1) * (n + 1); ++i)
                signs_(g * stride_ + i) = sign_of(g, n, i);
    make_tables();
    const Offset n_cells = plan_.grid.size();
    moments_ = allocate<double>("gravity/lattice/moments", n_cells * (stride_ + 8));
    lanes_ = allocate<double>("gravity/lattice/lanes", n_cells * stride_ * n_reflections);
    used_ = allocate<std::uint8_t>("gravity/lattice/used", n_cells);
    locals_ = allocate_zeroed<double>("gravity/lattice/locals", n_cells * stride_);
}

void LatticeField::make_tables() {
    const LatticeGrid& grid = plan_.grid;
    std::array<double, 3> box;
    for (int d = 0; d < 3; ++d) box[d] = lengths_[d] / scale_;
    const LatticeSums lattice(box, plan_.near, plan_.order);
    sums_ = allocate_zeroed<double>("gravity/lattice/sums", grid.size() * stride_);
    for_each_dynamic("gravity/lattice/sums", grid.size(), [&](int, Offset apart) {
        const auto place = grid.place(static_cast<int>(apart));
        std::array<double, 3> d;
        for (int axis = 0; axis < 3; ++axis) d[axis] = place[axis] * grid.side[axis] / scale_;
        double* const sums = sums_.data() + apart * stride_;
        const int order = plan_.orders[apart];
        lattice.at(d, order, sums);
        // What changes its sign in a reflection of 0 is 0, to the last bit.
        for (int axis = 0; axis < 3; ++axis)
            for (int i = 0; place[axis] == 0 && i < n_coefficients(order); ++i)
                if (signs_((1 << axis) * stride_ + i) < 0) sums[i] = 0;
    });
}

int LatticeField::reflected(int cell, int reflection) const {
    auto place = plan_.grid.place(cell);
    for (int d = 0; d < 3; ++d)
        if ((reflection >> d & 1) != 0) place[d] = plan_.grid.cells[d] - 1 - place[d];
    return plan_.grid.index(place[0], place[1], place[2]);
}

Expansion LatticeField::expansion_at(int cell, double* coefficients) const {
    const LatticeGrid& grid = plan_.grid;
    return {
        {grid.centre(cell, 0), grid.centre(cell, 1), grid.centre(cell, 2)}, scale_, coefficients};
}

void LatticeField::gather(const Bodies& sources) {
    sort_.sort(plan_.grid, {sources.x, sources.y, sources.z}, sources.n);
    make_moments(sources);
    place_moments();
    make_locals();
}

void LatticeField::make_moments(const Bodies& sources) {
    const auto& chunks = sort_.chunks();
    const Offset stride = stride_ + 8;
    ensure_capacity(partials_, "gravity/lattice/partials",
                    static_cast<Offset>(chunks.size()) * stride);
    const double* const x[3] = {sources.x, sources.y, sources.z};
    for_each_dynamic("gravity/lattice/p2m", static_cast<Offset>(chunks.size()), [&](int, Offset c) {
        const GridSort::Chunk& chunk = chunks[c];
        const std::int32_t* const order = sort_.order() + chunk.first;
        const Offset n = chunk.last - chunk.first;
        double* const out = partials_.data() + c * stride;
        std::fill_n(out, stride, 0.0);
        Gathered at;
        for (Offset i = 0; i < n; ++i) at.m[i] = sources.m[order[i]];
        for (int d = 0; d < 3; ++d)
            for (Offset i = 0; i < n; ++i) {
                at.x[d][i] = x[d][order[i]];
                const double r = (at.x[d][i] - lengths_[d] / 2) / scale_;
                out[stride_] += at.m[i] * r * r;
            }
        expansion_kernels().p2m(plan_.order, {at.x[0], at.x[1], at.x[2], at.m, n},
                                expansion_at(chunk.cell, out));
    });
    Kokkos::deep_copy(moments_, 0.0);
    for (std::size_t c = 0; c < chunks.size(); ++c)
        for (Offset i = 0; i < stride; ++i)
            moments_(chunks[c].cell * stride + i) += partials_(static_cast<Offset>(c) * stride + i);
}

/// Moments of each cell and its reflections side by side, and those of the box.
void LatticeField::place_moments() {
    const LatticeGrid& grid = plan_.grid;
    const int n_terms = n_coefficients(plan_.order);
    Kokkos::deep_copy(used_, std::uint8_t{0});
    for (const GridSort::Chunk& chunk : sort_.chunks())
        for (int g = 0; g < n_reflections; ++g) used_(reflected(chunk.cell, g)) = 1;
    mass_ = second_ = 0;
    std::fill_n(dipole_, 3, 0.0);
    for (int cell = 0; cell < grid.size(); ++cell) {
        const double* const m = moments_.data() + cell * (stride_ + 8);
        mass_ += m[0];
        second_ += m[stride_];
        const double first[3] = {2 * m[2], 2 * m[3], m[1]};  // R_11 = (x + iy) / 2
        for (int d = 0; d < 3; ++d)
            dipole_[d] += first[d] + m[0] * ((grid.centre(cell, d) - lengths_[d] / 2) / scale_);
        if (used_(cell) == 0) continue;
        for (int g = 0; g < n_reflections; ++g) {
            const double* const sign = signs_.data() + g * stride_;
            double* const out = lanes_.data() + reflected(cell, g) * stride_ * n_reflections + g;
            for (int i = 0; i < n_terms; ++i) out[i * n_reflections] = sign[i] * m[i];
        }
    }
}

void LatticeField::make_locals() {
    const LatticeGrid& grid = plan_.grid;
    const auto& n = grid.cells;
    const LatticeGrid octant{{n[0] / 2, n[1] / 2, n[2] / 2}, grid.side};
    for_each_dynamic("gravity/lattice/m2l", octant.size(), [&](int, Offset o) {
        const auto place = octant.place(static_cast<int>(o));
        const int cell = grid.index(place[0], place[1], place[2]);
        double locals[max_terms * n_reflections] = {};
        sum_cells(cell, locals);
        for (int g = 0; g < n_reflections; ++g) {
            const double* const sign = signs_.data() + g * stride_;
            double* const out = locals_.data() + reflected(cell, g) * stride_;
            for (int i = 0; i < n_coefficients(plan_.order); ++i)
                out[i] = sign[i] * locals[i * n_reflections + g] / scale_;
        }
    });
}

void LatticeField::sum_cells(int target, double* locals) const {
    const LatticeGrid& grid = plan_.grid;
    const LatticeKernel kernel = lattice_kernel();
    const auto a = grid.place(target);
    double sums[max_terms];
    for (int source = 0; source < grid.size(); ++source) {
        if (used_(source) == 0) continue;
        const auto b = grid.place(source);
        int reflection = 0, apart[3];
        for (int d = 0; d < 3; ++d) {
            apart[d] = std::abs(a[d] - b[d]);
            if (a[d] < b[d]) reflection |= 1 << d;
        }
        const int entry = grid.index(apart[0], apart[1], apart[2]), order = plan_.orders[entry];
        const double* const sign = signs_.data() + reflection * stride_;
        for (int i = 0; i < n_coefficients(order); ++i)
            sums[i] = sign[i] * sums_(entry * stride_ + i);
        kernel(order, sums, lanes_.data() + source * stride_ * n_reflections, locals);
    }
}

void LatticeField::add(const Points& targets, const Fields& fields) {
    sort_.sort(plan_.grid, {targets.x, targets.y, targets.z}, targets.n);
    const auto& chunks = sort_.chunks();
    const double* const x[3] = {targets.x, targets.y, targets.z};
    double* const a[3] = {fields.ax, fields.ay, fields.az};
    for_each_dynamic("gravity/lattice/l2p", static_cast<Offset>(chunks.size()), [&](int, Offset c) {
        const GridSort::Chunk& chunk = chunks[c];
        const std::int32_t* const order = sort_.order() + chunk.first;
        const Offset n = chunk.last - chunk.first;
        Gathered at;
        const double unit = square_ / scale_;
        std::fill_n(at.p, n, unit * second_);
        for (int d = 0; d < 3; ++d)
            for (Offset i = 0; i < n; ++i) {
                at.x[d][i] = x[d][order[i]];
                const double r = (at.x[d][i] - lengths_[d] / 2) / scale_;
                at.p[i] += unit * r * (mass_ * r - 2 * dipole_[d]);
                at.a[d][i] = 2 * unit / scale_ * (mass_ * r - dipole_[d]);
            }
        expansion_kernels().l2p(plan_.order,
                                expansion_at(chunk.cell, locals_.data() + chunk.cell * stride_),
                                {at.x[0], at.x[1], at.x[2], n}, {at.p, at.a[0], at.a[1], at.a[2]});
        for (Offset i = 0; i < n; ++i) fields.p[order[i]] += at.p[i];
        for (int d = 0; d < 3; ++d)
            for (Offset i = 0; i < n; ++i) a[d][order[i]] += at.a[d][i];
    });
}

Offset LatticeField::bytes() const {
    Offset n = sort_.bytes() + used_.size();
    for (const auto* view : {&sums_, &signs_, &partials_, &moments_, &lanes_, &locals_})
        n += static_cast<Offset>(view->size() * sizeof(double));
    return n;
}

}  // namespace connectivity::detail
