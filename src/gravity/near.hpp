// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Near lists as sums over pairs of particles: the direct kernel on copies of the sources' runs.
///
/// Invariants: what acts on a cell is the union of the near rows of the cell and its ancestors, in
/// their order, so that the bits do not depend on threads. With float32 sources near the targets'
/// cell are summed in double, the others in float relative to the cell's centre: a distance loses
/// no more than a few units in the last place of a float, at any scale, and only masses below 1e-38
/// of the whole are lost. Cost: that of the pairs, and 1.5 ns a source.

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
    const FarTest* walk = nullptr;  ///< with what it keeps of each cell
    const CellLists* lists = nullptr;
    const Images* images = nullptr;
    PairLaw law = PairLaw::newton;
    bool float32 = false;
};

/// One worker's.
class NearSum {
public:
    void begin(const NearProblem& problem);
    /// Collects what acts on the particles of `cell`; `add` then means it.
    void collect(CellId cell);
    /// Particles that act on each target, images counted.
    std::int64_t n_sources() const { return double_.n_sources + float_.n_sources; }
    /// Adds to `sums` of particles [first, first + n), which lie in the collected cell.
    void add(std::int32_t first, std::int32_t n, const Sums& sums);

private:
    struct Runs {
        std::vector<SourceRun> runs;
        std::int64_t n_sources = 0;
        void clear() { runs.clear(), n_sources = 0; }
        void add(const SourceRun& run);
        const SourceRun* data() const { return runs.data(); }
        std::int64_t n_runs() const { return static_cast<std::int64_t>(runs.size()); }
    };
    bool is_apart(const WalkCell& source, int image, double gap) const;
    void add64(std::int32_t first, std::int32_t n, const Sums& sums);
    void add32(std::int32_t first, std::int32_t n, const Sums& sums);
    GatherFrom gather_from() const;
    void add_coincident(std::int32_t first, std::int32_t n, const Sums& sums) const;

    NearProblem of_;
    CellId cell_ = 0;
    Runs double_, float_;
    double reach_ = 0, unit_ = 1;  ///< largest distance or softening; length of the floats
    std::vector<double> doubles_;
    std::vector<float> floats_, targets_;
};

}  // namespace connectivity::detail
