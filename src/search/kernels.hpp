// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The vector kernels of the group search, one table per instruction set, chosen at run time.
///
/// Raw pointers only: the files that implement a table are compiled for wide instructions and
/// therefore include neither Kokkos nor the standard containers, so that no wide code can leak into
/// the baseline through an inline function.
///
/// Coordinates are floats in the frame of a block: relative to its centre, in units near its reach.
/// Thresholds are squared reaches in the same unit, lowered by the error band: d <= t is certain, d
/// > t * (1 + band) is certainly not.

#include <cstdint>

namespace connectivity::detail {

constexpr int leaf_size = 16;   ///< nodes a leaf; unused places hold coordinates at infinity
constexpr int word_size = 64;   ///< candidates tested into one word of bits
constexpr int list_slack = 64;  ///< entries that a kernel may write beyond the end of a list
constexpr int no_label = 0x7fffffff;

/// What decides whether two nodes are neighbours, from the least to the most work.
enum class Form {
    uniform,    ///< balls of one radius
    balls,      ///< the larger ball of the two
    ellipsoids  ///< either side by its metric: tensors, and modes in which only one side counts
};

/// A constant and the upper triangle of a quadratic form; see metric.hpp.
template <int Dim>
constexpr int metric_size = 1 + Dim*(Dim + 1) / 2;

/// Candidates, sorted by label once `sort_by_label` ran; padded to whole words with points at
/// infinity.
template <int Dim>
struct CandidateList {
    float* x[Dim];
    float* t;           ///< own thresholds; untouched where all nodes have one reach
    float* width[Dim];  ///< half widths of the boxes of ellipsoids; untouched for balls
    /// For ellipsoids; entry 0 is not set, and the others are of the shape, until `metrics` ran.
    float* metric[metric_size<Dim>];
    int* label;  ///< slots
    int n;
};

/// Box in a frame, rounded outward, with the largest threshold of the nodes in it and, for
/// ellipsoids, the largest half widths of theirs.
template <int Dim>
struct FrameBox {
    float lo[Dim], hi[Dim];
    float t;
    float width[Dim];
};

/// How the nodes of leaves come into a frame.
template <int Dim>
struct FrameMap {
    double centre[Dim];  ///< of the frame, moved by the periodic image
    double scale;        ///< frame units per length
    double t_scale;      ///< threshold per squared length: scale² * (1 - error)
    float widen;         ///< 1 + what box tests need beyond a threshold
    float position_error;
    Form form;
};

/// How shapes become metrics in a frame.
struct MetricMap {
    float unit;            ///< squared reach in the frame's unit, per threshold
    float position_error;  ///< of a difference of coordinates
};

/// Rows of 16 that a leaf's ellipsoids take: the upper triangle of the shape, half widths per
/// reach.
template <int Dim>
constexpr int shape_rows = metric_size<Dim> - 1 + Dim;

/// Nodes in search order, by leaves of 16: for each leaf x[Dim][16], reach²[16], and
/// shapes[shape_rows<Dim>][16], absent if all are balls.
struct LeafArray {
    const double* nodes;
    const float* shapes;
    const int* label;
    int stride;  ///< doubles a leaf
};

/// Boxes of all leaves: numbers[k * stride + leaf], k = lo[Dim], hi[Dim], largest reach².
/// Padded with boxes that nobody is near.
struct LeafBoxes {
    const double* numbers;
    long stride;
};
constexpr int leaf_box_slack = 8;

/// A box that looks for leaves, and by how much boxes are too small.
template <int Dim>
struct BoxQuery {
    double lo[Dim], hi[Dim], reach2, slack;
};

/// The nodes of one leaf against a sorted list.
template <int Dim>
struct LeafTest {
    float x[Dim][leaf_size];
    float t[leaf_size];
    int n_nodes;
    int first_word[leaf_size];  ///< words before it are not wanted
    float band;                 ///< upper edge of the error band over its lower edge
    Form form;
    // For ellipsoids, which find x and the metric in the list:
    int place[leaf_size];
    bool own, others;  ///< whether it counts that a node sees the other, that the other sees it
};

/// What the predicate reads: Significance<Dim> without Kokkos. H is null if all nodes are scalar;
/// a period of 0 is an open axis.
template <int Dim>
struct PredicateData {
    const double *positions, *reach2, *H;
    double extent2, period[Dim];
    bool own, others;  ///< whether it counts that a node sees the other, that the other sees it
};

/// A word with candidates inside the error band.
struct Doubt {
    int node, word;
    std::uint64_t bits;
};

template <int Dim>
struct Kernels {
    const char* name;
    /// Leaves of [first, last) that may hold neighbours, ascending; may write `leaf_box_slack`
    /// beyond. Returns their number. Decides as is_near does, bit for bit.
    int (*near)(const LeafBoxes&, long first, long last, const BoxQuery<Dim>&, int* leaves);
    /// Appends the nodes of `leaves` whose distance to the box is within reach of either side.
    void (*collect)(const LeafArray&, const int* leaves, int n_leaves, const FrameMap<Dim>&,
                    const FrameBox<Dim>&, CandidateList<Dim>& out);
    /// Keeps the order: candidates of `in` within reach of the box, packed to the front of `out`.
    void (*filter)(const CandidateList<Dim>& in, const FrameBox<Dim>&, float widen, Form form,
                   CandidateList<Dim>& out);
    /// The same for a list that is tested next: what only filters read is left out.
    void (*last_filter)(const CandidateList<Dim>& in, const FrameBox<Dim>&, float widen, Form form,
                        CandidateList<Dim>& out);
    /// Makes metrics of the shapes in a list.
    void (*metrics)(CandidateList<Dim>& list, const MetricMap&);
    /// bits[node * n_words + word]; returns the number of doubts written.
    int (*test)(const LeafTest<Dim>&, const CandidateList<Dim>&, std::uint64_t* bits,
                Doubt* doubts);
    /// Clears the bits of labels that are no neighbours of `slot`. Decides as Significance does,
    /// bit for bit.
    void (*confirm)(const PredicateData<Dim>&, int slot, const int* label, int n_words,
                    std::uint64_t* bits);
    /// Labels whose bit is set, in order; may write 16 beyond. Returns their number.
    int (*expand)(const std::uint64_t* bits, int n_words, const int* label, int* out);
    /// Set bits before position `place`.
    int (*count)(const std::uint64_t* bits, int place);
    /// Places of 16 labels in a sorted list of n: the last entry that is not larger.
    void (*places)(const int* own, const int* label, int n, int* place);
};

/// The table for this processor, or the one that the environment variable CONNECTIVITY_ISA names
/// (portable, avx2, avx512), if the processor has it.
template <int Dim>
const Kernels<Dim>& kernels();

template <int Dim>
const Kernels<Dim>& portable_kernels();
#if defined(CONNECTIVITY_X86_KERNELS)
template <int Dim>
const Kernels<Dim>& avx2_kernels();
template <int Dim>
const Kernels<Dim>& avx512_kernels();
#endif

inline int n_words(int n) { return (n + word_size - 1) / word_size; }

}  // namespace connectivity::detail
