// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Classes of list 2: entries with equal translations, or equal angles to the last axis, share
/// precomputed operators.
///
/// A translation is the vector v from the source box to the target box in boxes of their level, a
/// vector of integers of at most 2n + 1 in each component; its code is the number with the digits
/// v_k + 2n + 1 to base 4n + 3, x the lowest. Codes are compared, never floating-point numbers. The
/// code of a pair is the difference of two 32-bit numbers of the boxes, taken modulo 2^32, which is
/// exact at any depth because it is small. Cost: 4 bytes an entry; one gather for each entry.

#include <connectivity/lists/traversal.hpp>

namespace connectivity {

class TranslationClassesInfo {
public:
    TranslationClassesInfo() = default;
    /// per_level: pairs of different levels are of different classes. Throws Error: not_built
    /// (no list 2), argument ((4n + 3)^dim exceeds 2^31 - 1), budget, memory.
    explicit TranslationClassesInfo(const FMMTraversalInfo& traversal, bool per_level = true);

    std::int32_t nfrom_sep_siblings_translation_classes() const { return n_classes_; }
    /// [entries of list 2]: class of each, numbered by (level, code), without gaps.
    ConstView<std::int32_t> from_sep_siblings_translation_classes() const { return classes_; }
    /// [dim][classes]: centre of the target box minus centre of the source box; of classes that are
    /// not by level, for boxes as large as the root.
    ConstView<double> from_sep_siblings_translation_class_to_distance_vector() const {
        return vectors_;
    }
    /// [nlevels + 1]: first class of each level; not by level: 0, then the number of classes.
    ConstView<std::int32_t> from_sep_siblings_translation_classes_level_starts() const {
        return level_starts_;
    }
    const FMMTraversalInfo& traversal() const { return traversal_; }
    Offset bytes() const;

private:
    FMMTraversalInfo traversal_;
    std::int32_t n_classes_ = 0;
    View<std::int32_t> classes_, level_starts_;
    View<double> vectors_;
};

class RotationClassesInfo {
public:
    RotationClassesInfo() = default;
    /// Throws as TranslationClassesInfo does.
    explicit RotationClassesInfo(const FMMTraversalInfo& traversal);

    std::int32_t nfrom_sep_siblings_rotation_classes() const { return n_classes_; }
    /// [entries of list 2]: class of each, numbered as angles turn up in ascending codes.
    ConstView<std::int32_t> from_sep_siblings_rotation_classes() const { return classes_; }
    /// [classes]: angle in [0, pi] between v and the last axis. Two are the same class if the sign
    /// of v_last and the fraction v_last^2 / |v|^2 are.
    ConstView<double> from_sep_siblings_rotation_class_to_angle() const { return angles_; }
    Offset bytes() const;

private:
    std::int32_t n_classes_ = 0;
    View<std::int32_t> classes_;
    View<double> angles_;
};

}  // namespace connectivity
