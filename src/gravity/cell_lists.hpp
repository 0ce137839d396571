// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Which cells act on which, far and near: one walk over pairs of cells, its product in CSR lists.
///
/// Theorem: for every particle i and every source particle j (in every near image of a periodic
/// box) exactly one pair (A, B) with i in A and j in B is in a list. Far lists: B's expansion acts
/// on A. Near lists: particles on particles. Rows are target cells, not leaves only.
///
/// Invariants: the same lists for any number of threads; with a symmetric test (A, B) is in a list
/// if and only if (B, A) is in it. Cost: proportional to the entries; scratch is kept.

#include <vector>

#include <connectivity/base/csr.hpp>

#include "far_test.hpp"

namespace connectivity::detail {

/// An entry of a list: a source cell, and in which image of the box it acts.
struct Source {
    static constexpr int image_bits = 6;
    static constexpr std::int32_t max_cells = std::int32_t{1} << (31 - image_bits);

    static std::int32_t pack(CellId cell, int image) {
        return image == 0 ? cell : cell | image << (31 - image_bits);
    }
    static CellId cell(std::int32_t packed) { return packed & (max_cells - 1); }
    static int image(std::int32_t packed) { return packed >> (31 - image_bits); }
};

/// Shifts of the near images of a periodic box; the first one is 0. Open: only that.
struct Images {
    int n = 1;
    std::vector<double> shift = {0, 0, 0};  ///< [n][3]
};

/// Entries as the kernels want them. One worker's memory.
class UnpackedList {
public:
    CellList of(const Slot* entries, std::int64_t n, const Images& images) {
        if (images.n == 1) return {entries, n, nullptr, nullptr};
        ids_.resize(static_cast<std::size_t>(n));
        images_.resize(static_cast<std::size_t>(n));
        for (std::int64_t k = 0; k < n; ++k) {
            ids_[k] = Source::cell(entries[k]);
            images_[k] = static_cast<std::uint8_t>(Source::image(entries[k]));
        }
        return {ids_.data(), n, images_.data(), images.shift.data()};
    }

private:
    std::vector<std::int32_t> ids_;
    std::vector<std::uint8_t> images_;
};

struct WalkRule {
    /// Pairs of particles (fmm: count of a times that of b; walk: count of b) that cost less near
    /// than far.
    double near_pairs = 0;
    std::int32_t group = 64;               ///< walk: most particles of a group
    const std::uint8_t* active = nullptr;  ///< [n_cells] target cells wanted; null: all
};

class CellLists {
public:
    /// Throws Error{memory, too_many}; the lists are then empty.
    void build(const Cells& cells, const FarTest& test, const WalkRule& rule, const Images& images);

    const Csr& far() const { return far_; }
    const Csr& near() const { return near_; }
    Offset bytes() const;
    void clear();

private:
    friend class CellWalk;
    struct Row {
        std::int64_t begin = 0;
        std::int32_t n = 0, worker = -1;
    };
    struct Worker {
        std::vector<std::int32_t> far, near;       ///< entries as they are found
        std::vector<std::int32_t> open, deferred;  ///< stacks
    };
    struct Task {
        CellId cell;
        std::size_t first, last;  ///< candidates
    };
    void hand_over(const Cells& cells, Csr& csr, const View<Row>& rows,
                   std::vector<std::int32_t> Worker::*entries);

    Csr far_{"gravity/far"}, near_{"gravity/near"};
    std::vector<Worker> workers_;
    std::vector<Task> tasks_, top_;
    std::vector<std::int32_t> candidates_;
    View<Row> far_rows_, near_rows_;
};

}  // namespace connectivity::detail
