// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Gravity by the classic adaptive fast multipole method: the lists of a traversal, worked off as
/// they stand. For hosts that have a box tree and lists anyway, for targets that are no sources,
/// and as a check of the lists. Who wants forces to a tolerance takes Gravity.
///
///     list 1, 3 close, 4 close    pairs of particles, softened
///     list 2                      multipoles of boxes as local expansions of boxes of their level
///     list 3                      multipoles of boxes at the own targets of a box
///     list 4                      own sources of a box as the local expansion of a box
///
/// Expansions are about the boxes' centres, in the units of half their diagonals. Potentials of
/// lists 2 to 4 are Newton's: lengths of softening are to be small against the leaves.
///
/// Error. Particles with radii act, and are acted on, at their centres, which are in their boxes;
/// radii only move boxes apart, so that errors are no larger than those of points. With order P a
/// pair of list 2 has Legendre's series of 1/r in the offsets of both particles from their centres
/// to degree P, one of list 3 or 4 in the offset of one of them. What is left out falls as
/// theta^(P + 1): theta <= sqrt(d) / (n + 1) for list 2 in d dimensions with boxes n apart (0.87
/// for n = 1, 0.58 for n = 2: particles at opposite corners), sqrt(d) / 3 for lists 3 and 4. Root
/// mean squares fall as 0.55 to 0.6 (n = 1) and 0.4 (n = 2) to the power of P in clouds of
/// particles. Trees know positions to 2^-53 of the root's side: errors do not fall in boxes below
/// 2^-45 of it, which only coordinates near 0 can make.
///
/// In one and two dimensions the coordinates that are missing are 0: the law stays 1/r². In a
/// periodic tree each target feels the images of all sources that the traversal has, those in the
/// root boxes next to its own, once each; what is farther is the host's.
///
/// Invariants: the same bits for any number of threads; an evaluation that throws leaves the one
/// before as it was; views handed out stay valid and unchanged. Masks of the traversal's options
/// are not looked at. Later evaluations of the same size allocate nothing but names. Memory:
/// 2 (P + 1)² doubles a box, 10 a particle. Source: Carrier, Greengard, Rokhlin, SIAM J. Sci. Stat.
/// Comput. 9 (1988) 669.

#include <memory>

#include <connectivity/gravity/options.hpp>
#include <connectivity/lists/traversal.hpp>

namespace connectivity {

/// What the tree does not know of its particles: arrays in the order of the host's sources (and
/// targets), read during the call. All are of one type.
struct ListMasses {
    CoordinateType type = CoordinateType::float64;
    Offset n = 0;                  ///< of sources, as many as the tree has
    const void* masses = nullptr;  ///< [n], finite; zero and negative ones are legal
    Offset mass_stride = 1;
    const void* softening = nullptr;  ///< [n], lengths, finite, >= 0; nullptr: none
    Offset softening_stride = 1;
    /// [targets of the tree], like `softening`; only where targets are no sources.
    const void* target_softening = nullptr;
    Offset target_softening_stride = 1;
};

struct ListSumOptions {
    int order = 8;  ///< of expansions, in [1, max_gravity_order]
    Softening softening = Softening::plummer;
    double constant = 1;  ///< of gravity, > 0
    Budget budget = {};   ///< for everything that an evaluation keeps
};

class ListSums {
public:
    ListSums();
    ~ListSums();
    ListSums(ListSums&&) noexcept;  ///< what was moved from may only be assigned to
    ListSums& operator=(ListSums&&) noexcept;

    /// What all sources of the traversal's tree do to all its targets. A source at the very place
    /// of a target has no force, and only with Plummer's softening a potential, unless it is the
    /// target itself. Throws Error: not_built (a list that was not asked for, by name), argument
    /// (sizes, strides, options, sums out of range), null, nonfinite (first particle), budget,
    /// memory.
    void evaluate(const FMMTraversalInfo& traversal, const ListMasses& masses,
                  const ListSumOptions& options = {});

    Offset n() const;                        ///< targets
    ConstView<double> acceleration() const;  ///< [n][3], the order of the host's targets
    ConstView<double> potential() const;     ///< [n]; per unit mass, negative near masses

    /// Phases: sort, moments (P2M, M2M), far (lists 2 and 4), down (L2L), near (direct lists, L2P),
    /// smaller (list 3): ms.
    const Report& report() const;
    Offset scratch_bytes() const;  ///< kept for the next evaluation
    void release_scratch();        ///< gives that back

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace connectivity
