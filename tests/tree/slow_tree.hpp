// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Box trees by their definition, slowly: a map from the path of a box to what it holds.

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <connectivity/tree/box_tree.hpp>

namespace connectivity::test {

/// What a random tree is made of; positions are exact in the precision told.
struct TreeCase {
    int dim = 3;
    CoordinateType type = CoordinateType::float64;
    int n_sources = 0, n_targets = -1;  ///< -1: sources are targets
    std::vector<double> x, radii;       ///< sources, then targets; radii empty: points
    bool source_radii = false, target_radii = false;
    std::vector<std::int32_t> weights;  ///< empty: 1 each
    TreeOptions options;

    int n() const { return n_sources + (n_targets > 0 ? n_targets : 0); }
    std::int64_t limit() const {
        return weights.empty() ? *options.max_particles_in_box : *options.max_leaf_refine_weight;
    }
    std::int64_t weight(int i) const { return weights.empty() ? 1 : weights[i]; }
    double radius(int i) const {
        const bool has = i < n_sources ? source_radii : target_radii;
        return has ? radii[i] : 0;
    }
};

struct SlowBox {
    std::vector<int> all, own;  ///< in the host's order; own of a leaf: all
    bool split = false;
};

class SlowTree {
public:
    /// `lo` and `extent`: of the root box.
    SlowTree(const TreeCase& c, const std::array<double, 3>& lo, double extent)
        : case_(c), lo_(lo), extent_(extent) {
        SlowBox& root = boxes_[""];
        for (int i = 0; i < c.n(); ++i) root.all.push_back(i);
        root.own = root.all;
        c.options.kind == TreeKind::non_adaptive ? grow_evenly() : grow("");
        if (c.options.kind == TreeKind::adaptive_level_restricted)
            while (restrict_once()) {
            }
        if (!c.options.skip_prune) prune();
    }

    /// Boxes by path: one character '0'... a level.
    const std::map<std::string, SlowBox>& boxes() const { return boxes_; }

    /// Do the closed cubes of two boxes have a point in common?
    bool touch(const std::string& a, const std::string& b) const {
        for (int d = 0; d < case_.dim; ++d) {
            const auto [a0, a1] = interval(a, d);
            const auto [b0, b1] = interval(b, d);
            const std::int64_t whole = std::int64_t{1} << 50;
            bool any = a0 <= b1 && b0 <= a1;
            if (case_.options.periodic[d]) any = any || a0 + whole <= b1 || b0 + whole <= a1;
            if (!any) return false;
        }
        return true;
    }

private:
    std::int64_t weight(const std::vector<int>& ids) const {
        std::int64_t sum = 0;
        for (const int i : ids) sum += case_.weight(i);
        return sum;
    }
    /// Upper minus lower face, as rounded in the host's precision.
    double side(int d) const {
        if (case_.type == CoordinateType::float64) return lo_[d] + extent_ - lo_[d];
        const float lo = static_cast<float>(lo_[d]), hi = lo + static_cast<float>(extent_);
        return hi - lo;
    }
    double scaled(int i, int d) const {
        const double x = case_.x[i * case_.dim + d];
        if (case_.type == CoordinateType::float64) return (x - lo_[d]) / side(d);
        return (static_cast<float>(x) - static_cast<float>(lo_[d])) / static_cast<float>(side(d));
    }
    /// Bits of a scaled coordinate down to a level, as a cell number.
    double cell(int i, int d, int level) const {
        return std::min(std::floor(std::ldexp(scaled(i, d), level)), std::ldexp(1.0, level) - 1);
    }
    int child_number(int i, int level) const {
        int number = 0;
        for (int d = 0; d < case_.dim; ++d)
            number = 2 * number + (std::fmod(cell(i, d, level), 2) != 0 ? 1 : 0);
        return number;
    }
    bool sticks_out(int i, int level) const {
        if (case_.radii.empty()) return false;
        return case_.type == CoordinateType::float32 ? sticks_out_of<float>(i, level)
                                                     : sticks_out_of<double>(i, level);
    }
    /// Every operation rounded to Real.
    template <class Real>
    bool sticks_out_of(int i, int level) const {
        const auto room_on = [&](int d) {
            const Real wider = static_cast<Real>(1.0 + static_cast<Real>(factor()));
            return wider * static_cast<Real>(std::ldexp(side(d), -level - 1));
        };
        const Real r = static_cast<Real>(case_.radius(i));
        double square = 0;
        for (int d = 0; d < case_.dim; ++d) {
            const Real x = static_cast<Real>(case_.x[i * case_.dim + d]),
                       middle = static_cast<Real>(std::ldexp(cell(i, d, level) + 0.5, -level)),
                       reach = middle * static_cast<Real>(side(d)),
                       c = static_cast<Real>(lo_[d]) + reach, room = room_on(d);
            if (case_.options.extent_norm == ExtentNorm::linf &&
                (x + r >= c + room || x - r < c - room))
                return true;
            const double away = x - c;
            square += away * away;
        }
        const double reach = std::sqrt(square) + static_cast<double>(r), room = room_on(0);
        return case_.options.extent_norm == ExtentNorm::l2 &&
               reach * reach >= case_.dim * room * room;
    }
    double factor() const { return *case_.options.stick_out_factor; }
    bool coincide(const SlowBox& box) const {
        for (const int i : box.all) {
            if (case_.radius(i) > 0) return false;
            for (int d = 0; d < case_.dim; ++d)
                if (std::min(1.0, scaled(i, d)) != std::min(1.0, scaled(box.all[0], d)))
                    return false;
        }
        return true;
    }
    bool over(const SlowBox& box) const {
        return weight(box.all) > case_.limit() && !coincide(box);
    }

    void split(const std::string& path) {
        SlowBox& box = boxes_[path];
        box.split = true;
        box.own.clear();
        const int level = static_cast<int>(path.size()) + 1;
        for (int k = 0; k < 1 << case_.dim; ++k) boxes_[path + static_cast<char>('0' + k)];
        for (const int i : box.all) {
            if (sticks_out(i, level)) {
                box.own.push_back(i);
                continue;
            }
            SlowBox& child = boxes_[path + static_cast<char>('0' + child_number(i, level))];
            child.all.push_back(i);
            child.own.push_back(i);
        }
    }
    std::int64_t movable(const std::string& path) const {
        std::int64_t sum = 0;
        for (const int i : boxes_.at(path).all)
            if (!sticks_out(i, static_cast<int>(path.size()) + 1)) sum += case_.weight(i);
        return sum;
    }
    void grow(const std::string& path) {
        if (!over(boxes_[path]) || movable(path) <= case_.limit()) return;
        split(path);
        for (int k = 0; k < 1 << case_.dim; ++k) grow(path + static_cast<char>('0' + k));
    }
    void grow_evenly() {
        std::vector<std::string> last{""};
        for (;;) {
            bool any = false;
            for (const auto& path : last) any = any || over(boxes_[path]);
            if (!any) return;
            std::vector<std::string> next;
            for (const auto& path : last) {
                split(path);
                for (int k = 0; k < 1 << case_.dim; ++k)
                    next.push_back(path + static_cast<char>('0' + k));
            }
            last = next;
        }
    }
    std::pair<std::int64_t, std::int64_t> interval(const std::string& path, int d) const {
        std::int64_t begin = 0, size = std::int64_t{1} << 50;
        for (const char c : path) {
            size /= 2;
            if (((c - '0') >> (case_.dim - 1 - d) & 1) != 0) begin += size;
        }
        return {begin, begin + size};
    }
    bool restrict_once() {
        std::vector<std::string> leaves, bad;
        for (const auto& [path, box] : boxes_)
            if (!box.split) leaves.push_back(path);
        for (const auto& a : leaves)
            for (const auto& b : leaves)
                if (!a.empty() && b.size() >= a.size() + 2 && touch(a, b)) {
                    bad.push_back(a);
                    break;
                }
        for (const auto& path : bad) split(path);
        return !bad.empty();
    }
    void prune() {
        std::erase_if(boxes_, [](const auto& entry) {
            return entry.second.all.empty() && !entry.first.empty();
        });
    }

    const TreeCase& case_;
    std::array<double, 3> lo_;
    double extent_;
    std::map<std::string, SlowBox> boxes_;
};

}  // namespace connectivity::test
