// SPDX-License-Identifier: BSD-3-Clause
#include "restrict_levels.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace connectivity::tree_detail {

namespace {

template <class Real, int Dim>
class Restrictor {
public:
    Restrictor(const Particles<Real, Dim>& particles, const StickOut<Real, Dim>& stick_out,
               const std::array<bool, 3>& periodic, Offset max_boxes, RawTree& raw)
        : particles_(particles),
          stick_out_(stick_out),
          periodic_(periodic),
          max_boxes_(max_boxes),
          n_boxes_(raw.n_boxes()),
          raw_(raw) {
        for (const RawLevel& level : raw.levels) {
            n_adaptive_.push_back(static_cast<std::int32_t>(level.size()));
            forced_.emplace_back();
        }
    }

    /// Step k of the construction makes the adaptive boxes of level k.
    void run() {
        const int n_levels = static_cast<int>(raw_.levels.size());
        for (int level = 1; level < n_levels; ++level) {
            for (std::int32_t b = 0; b < n_adaptive_[level]; ++b)
                if (raw_.levels[level][b].is_split()) require_neighbours(level, b);
            for (int coarser = level - 1; coarser >= 1; --coarser) {
                sort_unique(forced_[coarser]);
                for (const std::int32_t b : forced_[coarser]) require_neighbours(coarser, b);
            }
            for (int coarser = 1; coarser < level; ++coarser) split_forced(coarser);
        }
    }

private:
    static constexpr int n_children = 1 << Dim;
    using Direction = std::array<int, Dim>;

    /// A box and its level; level -1: outside the root box.
    struct Place {
        int level = -1;
        std::int32_t box = 0;
    };

    static void sort_unique(std::vector<std::int32_t>& boxes) {
        std::sort(boxes.begin(), boxes.end());
        boxes.erase(std::unique(boxes.begin(), boxes.end()), boxes.end());
    }

    /// A split box needs neighbours of its own size: leaves one level up are to be split.
    void require_neighbours(int level, std::int32_t box) {
        Direction step;
        step.fill(-1);
        for (;;) {
            const Place place = neighbour(level, box, step);
            if (place.level >= 1 && place.level < level &&
                !raw_.levels[place.level][place.box].is_split())
                forced_[place.level].push_back(place.box);
            int d = 0;
            while (d < Dim && step[d] == 1) step[d++] = -1;
            if (d == Dim) return;
            ++step[d];
        }
    }

    /// The smallest box that holds the cell one step from a box, not smaller than the box.
    Place neighbour(int level, std::int32_t box, const Direction& step) const {
        if (std::all_of(step.begin(), step.end(), [](int s) { return s == 0; }))
            return {level, box};
        if (level == 0) {
            for (int d = 0; d < Dim; ++d)
                if (step[d] != 0 && !periodic_[d]) return {};
            return {0, 0};
        }
        const RawBox& from = raw_.levels[level][box];
        Direction up{};
        int number = 0;
        for (int d = 0; d < Dim; ++d) {
            const int at = (from.number >> (Dim - 1 - d) & 1) + step[d];
            up[d] = at < 0 ? -1 : at > 1 ? 1 : 0;
            number |= (at & 1) << (Dim - 1 - d);
        }
        const Place parent = neighbour(level - 1, from.parent, up);
        if (parent.level < level - 1) return parent;
        const RawBox& above = raw_.levels[parent.level][parent.box];
        return above.is_split() ? Place{level, above.child(number)} : parent;
    }

    void split_forced(int level) {
        const std::size_t n_new = forced_[level].size() * n_children;
        if (n_boxes_ + static_cast<Offset>(n_new) > max_boxes_)
            throw Error(Status::too_many, "level restriction makes more than " +
                                              std::to_string(max_boxes_) +
                                              " boxes, the most that numbers of 32 bits and the "
                                              "memory budget allow: raise the limit of a leaf");
        n_boxes_ += static_cast<Offset>(n_new);
        for (const std::int32_t b : forced_[level]) split(level, b);
        forced_[level].clear();
    }

    void split(int level, std::int32_t index) {
        RawBox& box = raw_.levels[level][index];
        RawLevel& below = raw_.levels[level + 1];
        box.first_child = static_cast<std::int32_t>(below.size());
        box.children = static_cast<std::uint8_t>((1 << n_children) - 1);
        const auto counts = partition(level, box);
        box.n_own = counts[n_children];
        std::int32_t start = box.start + box.n_own;
        for (int c = 0; c < n_children; ++c) {
            below.push_back({.start = start,
                             .count = counts[c],
                             .n_own = counts[c],
                             .parent = index,
                             .number = static_cast<std::uint8_t>(c)});
            start += counts[c];
        }
    }

    /// Brings the particles of a box into the order own, child 0, child 1, ...; returns how many
    /// there are of each, own last.
    std::array<std::int32_t, n_children + 1> partition(int level, const RawBox& box) {
        std::array<std::vector<std::int32_t>, n_children + 1> bins;
        std::array<std::int32_t, n_children + 1> counts{};
        std::int32_t* const order = raw_.order.data() + box.start;
        for (std::int32_t k = 0; k < box.count; ++k) bins[bin(level, order[k])].push_back(order[k]);
        std::int32_t* next = order;
        for (int b = 0; b <= n_children; ++b) {
            const int c = b == 0 ? n_children : b - 1;
            counts[c] = static_cast<std::int32_t>(bins[c].size());
            next = std::copy(bins[c].begin(), bins[c].end(), next);
        }
        return counts;
    }

    int bin(int level, std::int32_t id) const {
        if (particles_.have_extent() && stick_out_.sticks_out(particles_, id, level + 1))
            return n_children;
        int number = 0;
        for (int d = 0; d < Dim; ++d) {
            const double t = stick_out_.frame.scaled(particles_.position(id, d), d);
            number = 2 * number + static_cast<int>(Frame<Real, Dim>::bits(t, level, 1));
        }
        return number;
    }

    const Particles<Real, Dim>& particles_;
    const StickOut<Real, Dim>& stick_out_;
    const std::array<bool, 3>& periodic_;
    Offset max_boxes_, n_boxes_;
    RawTree& raw_;
    std::vector<std::int32_t> n_adaptive_;           // boxes by level before any were forced
    std::vector<std::vector<std::int32_t>> forced_;  // by level: to split in this step
};

}  // namespace

template <class Real, int Dim>
void restrict_levels(const Particles<Real, Dim>& particles, const StickOut<Real, Dim>& stick_out,
                     const std::array<bool, 3>& periodic, Offset max_boxes, RawTree& raw) {
    Restrictor<Real, Dim>(particles, stick_out, periodic, max_boxes, raw).run();
}

#define CONNECTIVITY_INSTANTIATE(Real, Dim)                                                \
    template void restrict_levels(const Particles<Real, Dim>&, const StickOut<Real, Dim>&, \
                                  const std::array<bool, 3>&, Offset, RawTree&);
CONNECTIVITY_EACH_REAL_AND_DIM(CONNECTIVITY_INSTANTIATE)
#undef CONNECTIVITY_INSTANTIATE

}  // namespace connectivity::tree_detail
