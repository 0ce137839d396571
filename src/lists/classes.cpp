// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/lists/classes.hpp>

#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include <connectivity/base/runtime.hpp>

#include "translation_codes.hpp"

namespace connectivity {
namespace {

using Vector = std::array<int, 3>;

/// The angle to the last axis without its rounding: the sign of v_last, and v_last^2 / |v|^2 in
/// lowest terms.
std::tuple<int, Offset, Offset> angle_key(const Vector& v, int dim) {
    const Offset last = v[static_cast<std::size_t>(dim - 1)];
    Offset square = 0;
    for (const Offset x : v) square += x * x;
    const Offset common = std::gcd(last * last, square);
    return {(last > 0) - (last < 0), last * last / common, square / common};
}

double angle(const Vector& v, int dim) {
    double square = 0;
    for (const double x : v) square += x * x;
    return std::acos(v[static_cast<std::size_t>(dim - 1)] / std::sqrt(square));
}

}  // namespace

TranslationClassesInfo::TranslationClassesInfo(const FMMTraversalInfo& traversal, bool per_level)
    : traversal_(traversal) {
    run_kernels("translation classes", [&] {
        detail::TranslationCodes codes(traversal, per_level);
        const TreeView& tree = traversal.tree();
        level_starts_ = allocate<std::int32_t>("lists/classes/level_starts", tree.n_levels + 1);
        std::vector<double> vectors;  // [class][dim]
        for (int level = 0; level < codes.n_levels(); ++level) {
            level_starts_(level) = n_classes_;
            for (Offset code = 0; code < codes.n_codes(); ++code) {
                if (!codes.is_used(level, code)) continue;
                codes.set_class(level, code, n_classes_++);
                const Vector v = codes.vector_of(code);
                for (int k = 0; k < tree.dim; ++k)
                    vectors.push_back(
                        std::ldexp(v[static_cast<std::size_t>(k)] * tree.root_extent, -level));
            }
        }
        for (int level = codes.n_levels(); level <= tree.n_levels; ++level)
            level_starts_(level) = n_classes_;
        vectors_ = allocate<double>("lists/classes/vectors", tree.dim * Offset{n_classes_});
        for (Offset c = 0; c < n_classes_; ++c)
            for (int k = 0; k < tree.dim; ++k)
                vectors_(k * n_classes_ + c) = vectors[static_cast<std::size_t>(c * tree.dim + k)];
        classes_ = codes.take_classes();
    });
}

Offset TranslationClassesInfo::bytes() const {
    return static_cast<Offset>(4 * (classes_.size() + level_starts_.size()) + 8 * vectors_.size());
}

RotationClassesInfo::RotationClassesInfo(const FMMTraversalInfo& traversal) {
    run_kernels("rotation classes", [&] {
        detail::TranslationCodes codes(traversal, false);
        const int dim = traversal.tree().dim;
        std::map<std::tuple<int, Offset, Offset>, std::int32_t> known;
        std::vector<double> angles;
        for (Offset code = 0; code < codes.n_codes(); ++code) {
            if (!codes.is_used(0, code)) continue;
            const Vector v = codes.vector_of(code);
            const auto [place, is_new] =
                known.try_emplace(angle_key(v, dim), static_cast<std::int32_t>(angles.size()));
            if (is_new) angles.push_back(angle(v, dim));
            codes.set_class(0, code, place->second);
        }
        n_classes_ = static_cast<std::int32_t>(angles.size());
        angles_ = allocate<double>("lists/classes/angles", n_classes_);
        std::copy(angles.begin(), angles.end(), angles_.data());
        classes_ = codes.take_classes();
    });
}

Offset RotationClassesInfo::bytes() const {
    return static_cast<Offset>(4 * classes_.size() + 8 * angles_.size());
}

}  // namespace connectivity
