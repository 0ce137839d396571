// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Near lists as sums over pairs of particles: the direct kernel on runs of consecutive sources.
///
/// Invariants: what acts on a cell is the union of the near rows of the cell and its ancestors, in
/// their order, so that the bits do not depend on threads. In float32 the coordinates are relative
/// to the targets' centre, in units of their distance, so that close pairs keep their digits at any
/// scale. Cost: that of the pairs; float32 copies every source once per target cell.

#include <vector>

#include "cell_lists.hpp"
#include "direct_kernels.hpp"

namespace connectivity::detail {

/// Sums at targets: p = sum m/r, a = sum m d/r³; pointers to the first one.
struct Sums {
    double *p, *ax, *ay, *az;
    Sums at(std::int64_t k) const { return {p + k, ax + k, ay + k, az + k}; }
};

/// What near sums are made of; outlives them.
struct NearProblem {
    const TreeBodies* bodies = nullptr;
    const Cells* cells = nullptr;
    const CellLists* lists = nullptr;
    const Images* images = nullptr;
    PairLaw law = PairLaw::newton;
    bool float32 = false;
};

/// One worker's.
class NearSum {
public:
    void begin(const NearProblem& problem) { of_ = problem; }
    /// Collects what acts on the particles of `cell`; `add` then means it.
    void collect(CellId cell);
    /// Particles that act on each target, images counted.
    std::int64_t n_sources() const { return n_sources_; }
    /// Adds to `sums` of particles [first, first + n), which lie in the collected cell.
    void add(std::int32_t first, std::int32_t n, const Sums& sums);

private:
    struct Run {
        int image;
        std::int32_t first, n;
    };
    void add_run(const Run& run);
    void add64(std::int32_t first, std::int32_t n, const Sums& sums);
    void add32(std::int32_t first, std::int32_t n, const Sums& sums);
    void gather64();
    void gather32(const double centre[3], double unit);
    void add_coincident(std::int32_t first, std::int32_t n, const Sums& sums) const;

    NearProblem of_;
    CellId cell_ = 0;
    std::int64_t n_sources_ = 0;
    std::vector<Run> runs_;
    std::vector<double> doubles_;
    std::vector<float> floats_, targets_;
};

}  // namespace connectivity::detail
