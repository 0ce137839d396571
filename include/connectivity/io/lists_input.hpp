// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Reader of cases for box trees and interaction lists: particles and parameters in one HDF5 file,
/// the form in which answers of boxtree are exchanged.
///
///     in_sources [n, d], optional in_targets [m, d], in_source_radii [n], in_target_radii [m],
///     in_refine_weights [n + m] int32 (sources first), in the host's order
///     attr params: JSON. d (as the arrays say), kind (adaptive), leaf (64) or, with weights, maxw,
///     sof: stick-out factor (0), norm (linf), n_away (1), crit (precise_linf), minsrc (0), f32:
///     single precision (false), notrav: tree only (false). Others are information. A file without
///     params has all defaults.

#include <map>
#include <optional>
#include <string>

#include <connectivity/lists/traversal_options.hpp>
#include <connectivity/tree/tree_input.hpp>

namespace connectivity {

/// Names of the choices, in files and on command lines.
const std::map<std::string, TreeKind>& tree_kind_names();
const std::map<std::string, ExtentNorm>& extent_norm_names();
const std::map<std::string, FromSepSmallerCrit>& from_sep_smaller_crit_names();

/// Numbers in one of two precisions; the other array is empty.
struct ListsInputArray {
    ConstView<double> float64;
    ConstView<float> float32;

    Offset size() const { return static_cast<Offset>(float64.size() + float32.size()); }
    const void* data() const {  ///< nullptr if empty
        if (float64.size() > 0) return float64.data();
        return float32.size() > 0 ? float32.data() : nullptr;
    }
};

/// What a tree is built from, with its memory.
struct ListsInput {
    struct Particles {
        Offset n = 0;
        ListsInputArray positions;  ///< [n][dim]
        ListsInputArray radii;      ///< [n]; empty: points
    };

    int dim = 3;
    CoordinateType coordinates = CoordinateType::float64;
    Particles sources;
    std::optional<Particles> targets;        ///< absent: the sources
    ConstView<std::int32_t> refine_weights;  ///< empty: none
    TreeOptions tree;
    TraversalOptions lists;
    bool tree_only = false;

    bool have_radii() const {
        return sources.radii.size() > 0 || (targets && targets->radii.size() > 0);
    }
    /// Points into the arrays here.
    TreeInput particles() const;
};

/// Has this file such a case? False for HDF5 files of another form. Throws Error: file (missing,
/// unreadable, truncated), format (not HDF5).
bool is_lists_input(const std::string& path);

/// Throws Error: file, format (a dataset is missing or of the wrong shape, params are no JSON or
/// have a value that makes no sense), too_many, memory.
ListsInput read_lists_input(const std::string& path);

}  // namespace connectivity
