// SPDX-License-Identifier: BSD-3-Clause
#include "near.hpp"

#include <algorithm>
#include <cmath>

namespace connectivity::detail {

namespace {

/// Sources in float are at least so many radii of the target's cell from its centre. With the least
/// distance, 1/3 of the coordinate, 5 roundings of a float are the worst error of a distance.
constexpr double float_radii = 1.5;

/// And at least so much of the largest distance, so that all powers are in a float's range.
constexpr double float_range = 0x1p-40;

double power_of_two_above(double x) {
    int exponent;
    std::frexp(x, &exponent);
    return std::ldexp(1.0, exponent);
}

/// Rows for so many particles, written by gather: grows only, for zeros cost.
template <class T>
T* rows_of(std::vector<T>& buffer, std::int64_t n_rows, std::int64_t stride) {
    const auto size = static_cast<std::size_t>(n_rows * stride);
    if (buffer.size() < size) buffer.resize(size);
    return buffer.data();
}

template <class T>
NearSources<T> sources_in(const T* rows, std::int64_t stride, std::int64_t n) {
    return {rows, rows + stride, rows + 2 * stride, rows + 3 * stride, rows + 4 * stride, n};
}

}  // namespace

void NearSum::begin(const NearProblem& problem) {
    of_ = problem;
    const Cells& cells = *of_.cells;
    double shift = 0;
    for (const double s : of_.images->shift) shift = std::max(shift, std::abs(s));
    reach_ = 2 * (cells.radius(0) + shift);
    if (cells.softened) reach_ = std::max(reach_, cells.max_softening(0));
    unit_ = power_of_two_above(reach_);
}

void NearSum::collect(CellId cell) {
    cell_ = cell;
    double_.clear();
    float_.clear();
    const Cells& cells = *of_.cells;
    const double gap = std::max(float_radii * cells.radius(cell), float_range * reach_);
    const Offset* const offsets = of_.lists->near().offset_data();
    const Slot* const values = of_.lists->near().value_data();
    for (CellId a = cell;; a = cells.parent(a)) {
        for (Offset e = offsets[a]; e < offsets[a + 1]; ++e) {
            const WalkCell& b = (*of_.walk)[Source::cell(values[e])];
            const SourceRun run{b.first, b.count, Source::image(values[e])};
            Runs* const runs = of_.float32 && is_apart(b, run.image, gap) ? &float_ : &double_;
            runs->add(run);
        }
        if (a == 0) break;
    }
}

/// Whether all particles of `source` are farther than `gap` from the centre of the targets' cell.
bool NearSum::is_apart(const WalkCell& source, int image, double gap) const {
    const WalkCell& target = (*of_.walk)[cell_];
    const double* const shift = of_.images->shift.data() + 3 * image;
    double distance2 = 0;
    for (int d = 0; d < 3; ++d) {
        const double between = source.x[d] + shift[d] - target.x[d];
        distance2 += between * between;
    }
    const double least = 1.000001 * (source.radius + gap);  // more than roundings
    return distance2 > least * least;
}

/// Entries come from a depth-first walk, so that cells side by side often follow each other.
void NearSum::Runs::add(const SourceRun& run) {
    n_sources += run.n;
    if (!runs.empty()) {
        SourceRun& last = runs.back();
        if (last.image == run.image && last.first + last.n == run.first) {
            last.n += run.n;
            return;
        }
    }
    runs.push_back(run);
}

void NearSum::add(std::int32_t first, std::int32_t n, const Sums& sums) {
    if (double_.n_sources > 0) add64(first, n, sums);
    if (float_.n_sources > 0) add32(first, n, sums);
    if (of_.law == PairLaw::plummer) add_coincident(first, n, sums);
}

GatherFrom NearSum::gather_from() const {
    const TreeBodies& b = *of_.bodies;
    return {{b.x[0], b.x[1], b.x[2]}, b.mass, b.softening, of_.images->shift.data()};
}

/// One long call of the kernel costs less than many short ones, by more than the copy.
void NearSum::add64(std::int32_t first, std::int32_t n, const Sums& sums) {
    const TreeBodies& b = *of_.bodies;
    const std::int64_t stride = double_.n_sources + gather_slack;
    double* const s = rows_of(doubles_, 5, stride);
    direct_kernels().gather64(gather_from(), double_.data(), double_.n_runs(), s, stride);
    direct_kernels().add64(of_.law, sources_in(s, stride, double_.n_sources),
                           {b.x[0] + first, b.x[1] + first, b.x[2] + first,
                            b.softening != nullptr ? b.softening + first : nullptr, sums.p, sums.ax,
                            sums.ay, sums.az, n});
}

void NearSum::add32(std::int32_t first, std::int32_t n, const Sums& sums) {
    GatherFrom from = gather_from();
    for (int d = 0; d < 3; ++d) from.centre[d] = of_.cells->x(d, cell_);
    from.scale = 1 / unit_;
    const std::int64_t stride = float_.n_sources + gather_slack, target_stride = n + gather_slack;
    float* const s = rows_of(floats_, 5, stride);
    float* const t = rows_of(targets_, 9, target_stride);
    direct_kernels().gather32(from, float_.data(), float_.n_runs(), s, stride);
    const SourceRun targets{first, n, 0};
    direct_kernels().gather32(from, &targets, 1, t, target_stride);
    float* const out = t + 5 * target_stride;
    std::fill_n(out, 4 * target_stride, 0.0F);
    direct_kernels().add32(
        of_.law, sources_in(s, stride, float_.n_sources),
        {t, t + target_stride, t + 2 * target_stride, t + 4 * target_stride, out,
         out + target_stride, out + 2 * target_stride, out + 3 * target_stride, n});
    const double potential = 1 / unit_, force = potential / unit_;
    for (std::int32_t k = 0; k < n; ++k) {
        sums.p[k] += out[k] * potential;
        sums.ax[k] += out[k + target_stride] * force;
        sums.ay[k] += out[k + 2 * target_stride] * force;
        sums.az[k] += out[k + 3 * target_stride] * force;
    }
}

/// The kernel leaves out pairs at one place, itself among them. With softening the others have a
/// potential. They are in one leaf.
void NearSum::add_coincident(std::int32_t first, std::int32_t n, const Sums& sums) const {
    const std::int32_t begin = of_.cells->first(cell_), end = begin + of_.cells->count(cell_);
    for (std::int32_t k = 0; k < n; ++k) {
        const std::int32_t i = first + k;
        for (std::int32_t j = begin; j < end; ++j) {
            if (j == i || of_.bodies->x[0][j] != of_.bodies->x[0][i] ||
                of_.bodies->x[1][j] != of_.bodies->x[1][i] ||
                of_.bodies->x[2][j] != of_.bodies->x[2][i])
                continue;
            const double e = std::max(of_.bodies->softening[i], of_.bodies->softening[j]);
            if (e > 0) sums.p[k] += of_.bodies->mass[j] / e;
        }
    }
}

}  // namespace connectivity::detail
