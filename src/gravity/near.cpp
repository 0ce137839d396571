// SPDX-License-Identifier: BSD-3-Clause
#include "near.hpp"

#include <algorithm>

namespace connectivity::detail {

void NearSum::collect(CellId cell) {
    cell_ = cell;
    runs_.clear();
    n_sources_ = 0;
    const Offset* const offsets = of_.lists->near().offset_data();
    const Slot* const values = of_.lists->near().value_data();
    for (CellId a = cell;; a = of_.cells->parent(a)) {
        for (Offset e = offsets[a]; e < offsets[a + 1]; ++e) {
            const CellId b = Source::cell(values[e]);
            add_run({Source::image(values[e]), of_.cells->first(b), of_.cells->count(b)});
        }
        if (a == 0) break;
    }
}

/// Entries come from a depth-first walk, so that cells side by side often follow each other.
void NearSum::add_run(const Run& run) {
    n_sources_ += run.n;
    if (!runs_.empty()) {
        Run& last = runs_.back();
        if (last.image == run.image && last.first + last.n == run.first) {
            last.n += run.n;
            return;
        }
    }
    runs_.push_back(run);
}

void NearSum::add(std::int32_t first, std::int32_t n, const Sums& sums) {
    of_.float32 ? add32(first, n, sums) : add64(first, n, sums);
    if (of_.law == PairLaw::plummer) add_coincident(first, n, sums);
}

/// Sources as they are, x, y, z, mass, softening, one array after the other: one long call of the
/// kernel costs less than many short ones, by more than the copy.
void NearSum::gather64() {
    const auto n = static_cast<std::size_t>(n_sources_);
    const TreeBodies& b = *of_.bodies;
    doubles_.resize(5 * n);
    std::size_t at = 0;
    for (const Run& run : runs_) {
        const auto rows = static_cast<std::size_t>(run.n);
        for (std::size_t d = 0; d < 3; ++d) {
            const double shift = of_.images->shift[3 * run.image + d];
            const double* const x = b.x[d] + run.first;
            double* const to = doubles_.data() + d * n + at;
            for (std::size_t k = 0; k < rows; ++k) to[k] = x[k] + shift;
        }
        std::copy_n(b.mass + run.first, rows, doubles_.data() + 3 * n + at);
        if (b.softening != nullptr)
            std::copy_n(b.softening + run.first, rows, doubles_.data() + 4 * n + at);
        at += rows;
    }
}

void NearSum::add64(std::int32_t first, std::int32_t n, const Sums& sums) {
    gather64();
    const TreeBodies& b = *of_.bodies;
    const auto rows = static_cast<std::size_t>(n_sources_);
    const double* const s = doubles_.data();
    direct_kernels().add64(of_.law,
                           {s, s + rows, s + 2 * rows, s + 3 * rows, s + 4 * rows, n_sources_},
                           {b.x[0] + first, b.x[1] + first, b.x[2] + first,
                            b.softening != nullptr ? b.softening + first : nullptr, sums.p, sums.ax,
                            sums.ay, sums.az, n});
}

/// Sources as floats: x, y, z, mass, softening, one after the other.
void NearSum::gather32(const double centre[3], double unit) {
    const auto n = static_cast<std::size_t>(n_sources_);
    floats_.resize(5 * n);
    std::size_t at = 0;
    const double scale = 1 / unit;
    for (const Run& run : runs_) {
        for (int d = 0; d < 3; ++d) {
            const double origin = centre[d] - of_.images->shift[3 * run.image + d];
            const double* const x = of_.bodies->x[d] + run.first;
            float* const to = floats_.data() + d * n + at;
            for (std::int32_t k = 0; k < run.n; ++k)
                to[k] = static_cast<float>((x[k] - origin) * scale);
        }
        float* const mass = floats_.data() + 3 * n + at;
        for (std::int32_t k = 0; k < run.n; ++k)
            mass[k] = static_cast<float>(of_.bodies->mass[run.first + k]);
        if (of_.bodies->softening != nullptr)
            for (std::int32_t k = 0; k < run.n; ++k)
                floats_[4 * n + at + k] =
                    static_cast<float>(of_.bodies->softening[run.first + k] * scale);
        at += static_cast<std::size_t>(run.n);
    }
}

void NearSum::add32(std::int32_t first, std::int32_t n, const Sums& sums) {
    const double centre[3] = {of_.cells->x(0, cell_), of_.cells->x(1, cell_),
                              of_.cells->x(2, cell_)};
    const double unit = of_.cells->scale(cell_);
    gather32(centre, unit);
    const auto rows = static_cast<std::size_t>(n), sources = static_cast<std::size_t>(n_sources_);
    targets_.assign(8 * rows, 0.0F);
    float* const t = targets_.data();
    for (std::int32_t k = 0; k < n; ++k) {
        for (int d = 0; d < 3; ++d)
            t[d * rows + k] = static_cast<float>((of_.bodies->x[d][first + k] - centre[d]) / unit);
        if (of_.bodies->softening != nullptr)
            t[3 * rows + k] = static_cast<float>(of_.bodies->softening[first + k] / unit);
    }
    const float* const s = floats_.data();
    direct_kernels().add32(
        of_.law, {s, s + sources, s + 2 * sources, s + 3 * sources, s + 4 * sources, n_sources_},
        {t, t + rows, t + 2 * rows, t + 3 * rows, t + 4 * rows, t + 5 * rows, t + 6 * rows,
         t + 7 * rows, n});
    const double potential = 1 / unit, force = potential / unit;
    for (std::int32_t k = 0; k < n; ++k) {
        sums.p[k] += t[4 * rows + k] * potential;
        sums.ax[k] += t[5 * rows + k] * force;
        sums.ay[k] += t[6 * rows + k] * force;
        sums.az[k] += t[7 * rows + k] * force;
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
