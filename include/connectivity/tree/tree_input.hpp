// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a box tree is built from: the host's particles as they lie in its memory, and the choices.
///
/// Everything is read during the call that builds the tree, and only then.

#include <array>
#include <cstdint>
#include <optional>

#include <connectivity/base/budget.hpp>
#include <connectivity/tree/tree_view.hpp>

namespace connectivity {

/// Particles of one kind in the host's order and precision. Coordinate d of particle i is element
/// i * particle_stride + d * axis_stride of `positions`; strides count elements and are >= 1.
struct ParticleArray {
    const void* positions = nullptr;  ///< float or double, see TreeInput::coordinates
    Offset n = 0;
    Offset particle_stride = 1, axis_stride = 1;
    const void* radii = nullptr;  ///< [n], same type, >= 0; nullptr: points
    Offset radius_stride = 1;

    /// positions [n][dim]
    static ParticleArray interleaved(const void* positions, Offset n, int dim) {
        return {.positions = positions, .n = n, .particle_stride = dim};
    }
    /// positions [dim][n]
    static ParticleArray separate(const void* positions, Offset n) {
        return {.positions = positions, .n = n, .axis_stride = n > 0 ? n : 1};
    }
};

struct TreeInput {
    int dim = 3;
    CoordinateType coordinates = CoordinateType::float64;
    ParticleArray sources;
    /// Absent: the sources are the targets. Radii, of either kind, need separate targets.
    std::optional<ParticleArray> targets;
    /// [n_sources + n_targets], sources first; each in [0, max_leaf_refine_weight].
    const std::int32_t* refine_weights = nullptr;
};

/// Which boxes are split. Let W be the weight of those particles of a box that may move to a child
/// (all of them, but for those whose radius makes them stick out of the child).
enum class TreeKind {
    adaptive,                   ///< those with W > the limit
    adaptive_level_restricted,  ///< and leaves that touch one more than one level finer
    non_adaptive,               ///< all of the last level, while one of its boxes is over the limit
};

/// What to do with more particles than a leaf may hold at one place.
enum class Coincident {
    error,  ///< Error{argument} that names two of them
    leaf,   ///< a leaf over the limit
};

/// Hulls of each box's particles cost a pass over them.
enum class Hulls { automatic, always, never };  ///< automatic: if there are radii

/// Corners of a cube.
struct RootBox {
    std::array<double, 3> lo{}, hi{};
};

struct TreeOptions {
    TreeKind kind = TreeKind::adaptive;
    /// The limit: exactly one of the two is given, the second one with refine_weights.
    std::optional<std::int32_t> max_particles_in_box, max_leaf_refine_weight;
    /// How far a particle may stick out of its box, as a share of the box's half width; to be given
    /// where there are radii, and only there.
    std::optional<double> stick_out_factor;
    ExtentNorm extent_norm = ExtentNorm::linf;
    Coincident coincident = Coincident::error;
    Hulls hulls = Hulls::automatic;
    bool skip_prune = false;  ///< keep boxes without particles

    /// Corners of a root box of the host's: a cube (to rounding) that holds all particles with
    /// their radii; along periodic axes only their centres. Absent: from the lowest corner of the
    /// particles, 1e-4 wider than their widest side; side max(1, |coordinates|) if all are at one
    /// place.
    using Box = RootBox;
    std::optional<Box> bounding_box;
    std::array<bool, 3> periodic{};  ///< axes on which the root box repeats
    Budget budget;
};

}  // namespace connectivity
