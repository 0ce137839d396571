// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A box tree made the slow and plain way, one box after the other, for tests of what is built on
/// trees. It knows where its boxes are exactly: cells of a grid of 2^100 a side.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <connectivity/base/runtime.hpp>
#include <connectivity/tree/tree_view.hpp>

#include "support/random.hpp"

namespace connectivity::test {

__extension__ using Wide = __int128;
using Point = std::array<double, 3>;

constexpr int grid_levels = 100;  ///< of the grid that says where boxes are

enum class SlowKind { adaptive, non_adaptive, level_restricted };

struct SlowParticle {
    Point x{};
    double radius = 0;
};

struct SlowInput {
    int dim = 2;
    SlowKind kind = SlowKind::adaptive;
    int leaf = 5;
    double lo = 0, extent = 1;  ///< of the root box
    std::vector<SlowParticle> sources, targets;
    bool sources_are_targets = false, source_radii = false, target_radii = false;
    ExtentNorm norm = ExtentNorm::linf;
    double stick_out = 0;
    std::array<bool, 3> periodic{};
    bool exact_flags = false;   ///< flags of what is below, not of every box once split
    std::uint64_t shuffle = 0;  ///< not 0: seed of the numbers of boxes within a level
};

class SlowTree {
public:
    struct Box {
        int level = 0, parent = -1, number = 0;
        std::array<Wide, 3> cell{};  // lowest corner on the grid
        Point center{};
        std::array<int, 8> children;
        bool split = false;
        std::array<std::vector<int>, 2> own, below;  // sources, targets
        BoxId id = -1;
        int rank = -1;  // depth first
    };

    explicit SlowTree(const SlowInput& input) : in_(input) {
        start_runtime();
        particles_[0] = in_.sources;
        particles_[1] = in_.sources_are_targets ? in_.sources : in_.targets;
        Box root;
        for (std::size_t kind = 0; kind < 2; ++kind)
            for (std::size_t i = 0; i < particles_[kind].size(); ++i)
                root.below[kind].push_back(static_cast<int>(i));
        for (double& c : root.center) c = in_.lo + in_.extent / 2;
        root.own = root.below;
        root.children.fill(-1);
        boxes_.push_back(root);
        split_all();
        if (in_.kind == SlowKind::level_restricted) restrict_levels();
        number_all();
        make_view();
    }

    const TreeView& view() const { return view_; }
    const SlowInput& input() const { return in_; }
    /// By number of the view.
    const Box& box(BoxId b) const { return boxes_[static_cast<std::size_t>(place_[b])]; }
    const std::vector<SlowParticle>& particles(int kind) const {
        return particles_[static_cast<std::size_t>(kind)];
    }
    double half_width(BoxId b) const { return std::ldexp(in_.extent, -(box(b).level + 1)); }

    /// Do the closures of T and of S, shifted by so many root boxes, meet?
    bool touch(BoxId target, BoxId source, const std::array<int, 3>& shift) const {
        return touch(box(target), box(source), shift);
    }
    /// Cell of S minus that of T, along the axis where they are farthest apart, for one level.
    Wide offset(BoxId target, BoxId source, const std::array<int, 3>& shift) const {
        Wide far = 0;
        const Box &t = box(target), &s = box(source);
        for (std::size_t k = 0; k < 3; ++k) {
            Wide d = s.cell[k] + shift[k] * (Wide{1} << grid_levels) - t.cell[k];
            d = (d < 0 ? -d : d) >> (grid_levels - t.level);
            far = std::max(far, d);
        }
        return far;
    }

private:
    static Wide side(const Box& b) { return Wide{1} << (grid_levels - b.level); }
    bool touch(const Box& t, const Box& s, const std::array<int, 3>& shift) const {
        for (int k = 0; k < in_.dim; ++k) {
            const auto a = static_cast<std::size_t>(k);
            const Wide at = s.cell[a] + shift[a] * (Wide{1} << grid_levels);
            if (at + side(s) < t.cell[a] || t.cell[a] + side(t) < at) return false;
        }
        return true;
    }

    int child_number(const SlowParticle& p, int level) const {
        int m = 0;
        for (int k = 0; k < in_.dim; ++k) {
            const double scaled = (p.x[static_cast<std::size_t>(k)] - in_.lo) / in_.extent;
            const double cell = std::floor(std::ldexp(scaled, level + 1));
            m = 2 * m + (std::fmod(cell, 2.0) == 1.0 ? 1 : 0);
        }
        return m;
    }
    Point child_center(const Box& b, int m) const {
        Point c = b.center;
        const double r = std::ldexp(in_.extent, -(b.level + 2));
        for (int k = 0; k < in_.dim; ++k)
            c[static_cast<std::size_t>(k)] += (m >> (in_.dim - 1 - k) & 1) ? r : -r;
        return c;
    }
    bool sticks_out(const SlowParticle& p, const Box& b, int m) const {
        if (p.radius == 0) return false;
        const Point c = child_center(b, m);
        const double r = std::ldexp(in_.extent, -(b.level + 2)) * (1 + in_.stick_out);
        double square = 0;
        for (int k = 0; k < in_.dim; ++k) {
            const auto a = static_cast<std::size_t>(k);
            if (in_.norm == ExtentNorm::linf &&
                (p.x[a] + p.radius >= c[a] + r || p.x[a] - p.radius < c[a] - r))
                return true;
            square += (p.x[a] - c[a]) * (p.x[a] - c[a]);
        }
        const double reach = std::sqrt(square) + p.radius;
        return in_.norm == ExtentNorm::l2 && reach * reach >= in_.dim * r * r;
    }
    int n_movable(const Box& b) const {
        int n = 0;
        for (int kind = 0; kind < (in_.sources_are_targets ? 1 : 2); ++kind)
            for (const int i : b.own[static_cast<std::size_t>(kind)]) {
                const auto& p = particles(kind)[static_cast<std::size_t>(i)];
                n += !sticks_out(p, b, child_number(p, b.level));
            }
        return n;
    }

    void split(int at) {
        for (int m = 0; m < 1 << in_.dim; ++m) {
            Box c;
            c.level = boxes_[at].level + 1;
            c.parent = at;
            c.number = m;
            c.center = child_center(boxes_[at], m);
            c.children.fill(-1);
            c.cell = boxes_[at].cell;
            for (int k = 0; k < in_.dim; ++k)
                if (m >> (in_.dim - 1 - k) & 1) c.cell[static_cast<std::size_t>(k)] += side(c);
            boxes_[at].children[static_cast<std::size_t>(m)] = static_cast<int>(boxes_.size());
            boxes_.push_back(c);
        }
        Box& b = boxes_[at];
        b.split = true;
        for (std::size_t kind = 0; kind < 2; ++kind) {
            std::vector<int> kept;
            for (const int i : b.own[kind]) {
                const auto& p = particles_[kind][static_cast<std::size_t>(i)];
                const int m = child_number(p, b.level);
                if (sticks_out(p, b, m)) {
                    kept.push_back(i);
                    continue;
                }
                Box& c = boxes_[static_cast<std::size_t>(b.children[static_cast<std::size_t>(m)])];
                c.own[kind].push_back(i);
                c.below[kind].push_back(i);
            }
            b.own[kind] = kept;
        }
    }

    void split_all() {
        if (in_.kind != SlowKind::non_adaptive) {
            for (int at = 0; at < static_cast<int>(boxes_.size()); ++at)
                if (boxes_[at].level < grid_levels - 2 && n_movable(boxes_[at]) > in_.leaf)
                    split(at);
            return;
        }
        for (int first = 0, level = 0; level < 4; ++level) {
            const int last = static_cast<int>(boxes_.size());
            bool full = false;
            for (int at = first; at < last; ++at) full |= n_movable(boxes_[at]) > in_.leaf;
            if (!full) return;
            for (int at = first; at < last; ++at) split(at);
            first = last;
        }
    }

    void restrict_levels() {
        for (bool changed = true; changed;) {
            changed = false;
            for (int a = 0; a < static_cast<int>(boxes_.size()); ++a) {
                const auto too_fine = [&](const Box& b) {
                    return !b.split && b.level >= boxes_[a].level + 2 && touch(boxes_[a], b, {});
                };
                if (boxes_[a].split || boxes_[a].level == 0) continue;
                if (std::none_of(boxes_.begin(), boxes_.end(), too_fine)) continue;
                split(a);
                changed = true;
            }
        }
    }

    bool is_kept(const Box& b) const {
        return b.parent < 0 || !b.below[0].empty() || !b.below[1].empty();
    }

    void number_all() {
        std::vector<int> stack{0};
        int rank = 0, deepest = 0;
        while (!stack.empty()) {
            Box& b = boxes_[static_cast<std::size_t>(stack.back())];
            stack.pop_back();
            b.rank = rank++;
            deepest = std::max(deepest, b.level);
            for (int m = (1 << in_.dim) - 1; m >= 0; --m) {
                int& c = b.children[static_cast<std::size_t>(m)];
                if (c >= 0 && !is_kept(boxes_[static_cast<std::size_t>(c)])) c = -1;
                if (c >= 0) stack.push_back(c);
            }
        }
        for (int level = 0; level <= deepest; ++level) {
            const auto start = static_cast<std::ptrdiff_t>(place_.size());
            level_starts_.push_back(static_cast<BoxId>(start));
            for (int at = 0; at < static_cast<int>(boxes_.size()); ++at)
                if (boxes_[at].rank >= 0 && boxes_[at].level == level) place_.push_back(at);
            std::sort(place_.begin() + start, place_.end(),
                      [&](int a, int b) { return boxes_[a].rank < boxes_[b].rank; });
            if (in_.shuffle != 0)
                for (std::size_t i = place_.size(); i > static_cast<std::size_t>(start) + 1; --i) {
                    const std::size_t n = i - static_cast<std::size_t>(start);
                    std::swap(place_[i - 1],
                              place_[static_cast<std::size_t>(start) + mix(in_.shuffle + i) % n]);
                }
        }
        level_starts_.push_back(static_cast<BoxId>(place_.size()));
        for (std::size_t i = 0; i < place_.size(); ++i)
            boxes_[place_[i]].id = static_cast<BoxId>(i);
    }

    void make_view();
    void make_particles(int kind, TreeParticles& out);

    SlowInput in_;
    std::array<std::vector<SlowParticle>, 2> particles_;
    std::vector<Box> boxes_;
    std::vector<int> place_;
    std::vector<BoxId> level_starts_;
    TreeView view_;
};

inline void SlowTree::make_particles(int kind, TreeParticles& out) {
    const auto side_of = static_cast<std::size_t>(kind);
    const Offset n = view_.n_boxes, stride = view_.aligned_n_boxes;
    out.n = static_cast<Offset>(particles_[side_of].size());
    auto counts = allocate_zeroed<std::int32_t>("counts", n),
         below = allocate_zeroed<std::int32_t>("below", n);
    auto lo = allocate_zeroed<double>("lo", in_.dim * stride),
         hi = allocate_zeroed<double>("hi", in_.dim * stride);
    for (Offset b = n - 1; b >= 0; --b) {
        const Box& at = box(static_cast<BoxId>(b));
        counts(b) = static_cast<std::int32_t>(at.own[side_of].size());
        below(b) = static_cast<std::int32_t>(at.below[side_of].size());
        for (int k = 0; k < in_.dim; ++k) {
            const auto a = static_cast<std::size_t>(k);
            double l = at.center[a], h = l;
            for (const int i : at.below[side_of]) {
                const auto& p = particles_[side_of][static_cast<std::size_t>(i)];
                l = std::min(l, p.x[a] - p.radius);
                h = std::max(h, p.x[a] + p.radius);
            }
            for (int m = 0; m < 1 << in_.dim; ++m)
                if (const BoxId c = view_.child(m, static_cast<BoxId>(b)); c != 0) {
                    l = std::min(l, lo(k * stride + c));
                    h = std::max(h, hi(k * stride + c));
                }
            lo(k * stride + b) = l;
            hi(k * stride + b) = h;
        }
    }
    out.box_counts_nonchild = counts;
    out.box_counts_cumul = below;
    out.bounding_box_min = lo;
    out.bounding_box_max = hi;
    if (kind == 0 ? in_.source_radii : in_.target_radii)
        out.radii = allocate_zeroed<double>("radii", std::max<Offset>(out.n, 1));
}

inline void SlowTree::make_view() {
    view_.dim = in_.dim;
    view_.sources_are_targets = in_.sources_are_targets;
    view_.periodic = in_.periodic;
    view_.root_extent = in_.extent;
    view_.stick_out_factor = in_.stick_out;
    if (in_.source_radii || in_.target_radii) view_.extent_norm = in_.norm;
    view_.n_levels = static_cast<int>(level_starts_.size()) - 1;
    view_.n_boxes = static_cast<Offset>(place_.size());
    view_.aligned_n_boxes = (view_.n_boxes + 31) / 32 * 32;
    const Offset n = view_.n_boxes, stride = view_.aligned_n_boxes;
    auto starts = allocate<BoxId>("starts", view_.n_levels + 1),
         parents = allocate<BoxId>("parents", n),
         children = allocate_zeroed<BoxId>("children", (1 << in_.dim) * stride);
    auto centers = allocate_zeroed<double>("centers", in_.dim * stride);
    auto levels = allocate<std::uint8_t>("levels", n), flags = allocate<std::uint8_t>("flags", n);
    std::copy(level_starts_.begin(), level_starts_.end(), starts.data());
    for (Offset b = 0; b < n; ++b) {
        const Box& at = box(static_cast<BoxId>(b));
        parents(b) = at.parent < 0 ? 0 : boxes_[static_cast<std::size_t>(at.parent)].id;
        levels(b) = static_cast<std::uint8_t>(at.level);
        unsigned flag = (at.own[0].empty() ? 0u : 1u) | (at.own[1].empty() ? 0u : 2u);
        if (at.split && !in_.exact_flags) flag |= 4u | 8u;
        for (unsigned kind = 0; kind < 2; ++kind)
            if (at.below[kind].size() > at.own[kind].size()) flag |= 4u << kind;
        flags(b) = static_cast<std::uint8_t>(flag);
        for (int m = 0; m < 1 << in_.dim; ++m)
            if (const int c = at.children[static_cast<std::size_t>(m)]; c >= 0)
                children(m * stride + b) = boxes_[static_cast<std::size_t>(c)].id;
        for (int k = 0; k < in_.dim; ++k)
            centers(k * stride + b) = at.center[static_cast<std::size_t>(k)];
    }
    view_.level_start_box_nrs = starts;
    view_.box_parent_ids = parents;
    view_.box_child_ids = children;
    view_.box_centers = centers;
    view_.box_levels = levels;
    view_.box_flags = flags;
    make_particles(0, view_.sources);
    make_particles(1, view_.targets);
}

}  // namespace connectivity::test
