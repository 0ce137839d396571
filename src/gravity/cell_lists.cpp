// SPDX-License-Identifier: BSD-3-Clause
#include "cell_lists.hpp"

#include <algorithm>

#include "base/first_exception.hpp"

namespace connectivity::detail {

/// One worker's walk: target cells depth first, each with the source cells that its parent could
/// neither accept nor leave to particles.
class CellWalk {
public:
    using Worker = CellLists::Worker;

    CellWalk(const FarTest& test, const WalkRule& rule, const Images& images)
        : test_(test),
          rule_(rule),
          shift_(images.shift.data()),
          groups_(test.form() == FarForm::cell_to_particles) {}

    bool is_active(CellId a) const { return rule_.active == nullptr || rule_.active[a] != 0; }
    /// Targets are not divided further.
    bool is_terminal(CellId a) const {
        return test_[a].n_children == 0 || (groups_ && test_[a].count <= rule_.group);
    }

    /// Sorts candidates [first, last) of `list` into rows of `a` and, at the end of w.deferred,
    /// what is left for a's children.
    void sort(CellId a, const std::vector<std::int32_t>& list, std::size_t first, std::size_t last,
              Worker& w) const {
        const Target t{a, is_terminal(a), test_[a]};
        if (groups_ && !t.terminal) {  // only groups have rows
            for (std::size_t k = first; k < last; ++k) w.deferred.push_back(entry(list, k));
            return;
        }
        for (std::size_t k = first; k < last; ++k) {
            place(t, entry(list, k), w);
            while (!w.open.empty()) {
                const std::int32_t s = w.open.back();
                w.open.pop_back();
                place(t, s, w);
            }
        }
    }

private:
    struct Target {
        CellId id;
        bool terminal;
        WalkCell cell;
    };
    /// By value: the list may be the one that grows.
    static std::int32_t entry(const std::vector<std::int32_t>& list, std::size_t k) {
        return list[k];
    }
    double distance2(const WalkCell& a, const WalkCell& b, int image) const {
        const double* const shift = shift_ + 3 * image;
        double d2 = 0;
        for (int d = 0; d < 3; ++d) {
            const double x = a.x[d] - (b.x[d] + shift[d]);
            d2 += x * x;
        }
        return d2;
    }
    bool is_cheap_near(const WalkCell& a, const WalkCell& b) const {
        const double n = b.count;
        return (groups_ ? n : n * a.count) < rule_.near_pairs;
    }
    /// Whether the source is to be divided, not the target. Symmetric, so that lists are if the
    /// test is.
    bool divides_source(const Target& t, CellId b, const WalkCell& source) const {
        if (t.cell.radius != source.radius) return source.radius > t.cell.radius;
        return b > t.id;
    }
    void place(const Target& t, std::int32_t s, Worker& w) const {
        const CellId b = Source::cell(s);
        const int image = Source::image(s);
        const WalkCell& source = test_[b];
        const bool is_leaf = source.n_children == 0;
        if (is_cheap_near(t.cell, source)) {
            w.near.push_back(s);
        } else if (test_(t.id, b, distance2(t.cell, source, image))) {
            w.far.push_back(s);
        } else if (t.terminal && is_leaf) {
            w.near.push_back(s);
        } else if (t.id == b && !t.terminal) {
            divide(source, image, w.deferred);
        } else if (t.terminal || (!is_leaf && divides_source(t, b, source))) {
            divide_open(source, image, w.open);
        } else {
            w.deferred.push_back(s);
        }
    }
    static void divide(const WalkCell& source, int image, std::vector<std::int32_t>& out) {
        for (CellId c = source.first_child; c < source.first_child + source.n_children; ++c)
            out.push_back(Source::pack(c, image));
    }
    /// On a stack the first child comes last.
    static void divide_open(const WalkCell& source, int image, std::vector<std::int32_t>& stack) {
        for (CellId c = source.first_child + source.n_children; c-- > source.first_child;)
            stack.push_back(Source::pack(c, image));
    }

    const FarTest& test_;
    const WalkRule& rule_;
    const double* shift_;
    bool groups_;
};

namespace {

/// Subtrees with at most this share of the particles are walked as one task.
constexpr Offset n_tasks = 128;

}  // namespace

void CellLists::build(const Cells& cells, const FarTest& test, const WalkRule& rule,
                      const Images& images) {
    if (cells.n > Source::max_cells)
        throw Error(Status::too_many, "the tree has " + std::to_string(cells.n) +
                                          " cells, must be at most " +
                                          std::to_string(Source::max_cells));
    const CellWalk walk(test, rule, images);
    workers_.resize(static_cast<std::size_t>(n_workers()));
    for (Worker& w : workers_)
        for (auto* list : {&w.far, &w.near, &w.open, &w.deferred}) list->clear();
    ensure_capacity(far_rows_, "gravity/far_rows", cells.n);
    ensure_capacity(near_rows_, "gravity/near_rows", cells.n);
    Kokkos::deep_copy(far_rows_, Row{});
    Kokkos::deep_copy(near_rows_, Row{});

    // Entries of a cell stand together in the arrays of the worker that found them.
    const auto enter = [&](int number, CellId a, const std::vector<std::int32_t>& list,
                           std::size_t first, std::size_t last) {
        Worker& w = workers_[number];
        const std::size_t far = w.far.size(), near = w.near.size();
        walk.sort(a, list, first, last, w);
        far_rows_(a) = {static_cast<std::int64_t>(far),
                        static_cast<std::int32_t>(w.far.size() - far), number};
        near_rows_(a) = {static_cast<std::int64_t>(near),
                         static_cast<std::int32_t>(w.near.size() - near), number};
    };
    const auto for_active_children = [&](CellId a, const auto& body) {
        for (CellId c = cells.first_child(a); c < cells.first_child(a) + cells.n_children(a); ++c)
            if (walk.is_active(c)) body(c);
    };

    // The top of the tree, until there are tasks; candidates of each are kept.
    tasks_.clear();
    candidates_.clear();
    for (int image = 0; image < images.n; ++image) candidates_.push_back(Source::pack(0, image));
    const Offset share = Offset{cells.count(0)} / n_tasks;
    top_.assign(1, {0, 0, candidates_.size()});
    while (!top_.empty()) {
        const Task t = top_.back();
        top_.pop_back();
        if (cells.count(t.cell) <= share || walk.is_terminal(t.cell)) {
            tasks_.push_back(t);
            continue;
        }
        Worker& w = workers_[0];
        w.deferred.clear();
        enter(0, t.cell, candidates_, t.first, t.last);
        const std::size_t first = candidates_.size();
        candidates_.insert(candidates_.end(), w.deferred.begin(), w.deferred.end());
        for_active_children(t.cell, [&](CellId c) {
            top_.push_back({c, first, candidates_.size()});
        });
    }

    struct Descent {
        const CellWalk& walk;
        decltype(enter)& enter_cell;
        decltype(for_active_children)& children;
        Worker& w;
        int number;

        void below(CellId a, std::size_t first, std::size_t last) const {
            const std::size_t mark = w.deferred.size();
            enter_cell(number, a, w.deferred, first, last);
            if (!walk.is_terminal(a))
                children(a, [&](CellId c) { below(c, mark, w.deferred.size()); });
            w.deferred.resize(mark);
        }
    };
    FirstException failure;
    for_each_dynamic(
        "gravity/lists", static_cast<Offset>(tasks_.size()), [&](int number, Offset k) {
            if (failure.any()) return;
            try {
                const Task& t = tasks_[k];
                Worker& w = workers_[number];
                w.deferred.assign(candidates_.begin() + t.first, candidates_.begin() + t.last);
                Descent{walk, enter, for_active_children, w, number}.below(t.cell, 0,
                                                                           w.deferred.size());
            } catch (...) {
                failure.keep();
            }
        });
    failure.rethrow("the walk, for its interaction lists,");
    hand_over(cells, far_, far_rows_, &Worker::far);
    hand_over(cells, near_, near_rows_, &Worker::near);
}

void CellLists::hand_over(const Cells& cells, Csr& csr, const View<Row>& rows,
                          std::vector<std::int32_t> Worker::*entries) {
    csr.prepare(cells.n, [&](Offset c) { return rows(c).n; });
    csr.reserve();
    csr.commit([&](Offset first, Offset last, const Offset* offsets, Slot* values) {
        for (Offset c = first; c < last; ++c) {
            if (rows(c).n == 0) continue;
            const auto* const from = (workers_[rows(c).worker].*entries).data() + rows(c).begin;
            std::copy_n(from, rows(c).n, values + offsets[c]);
        }
    });
}

Offset CellLists::bytes() const {
    Offset sum = far_.bytes() + near_.bytes() +
                 static_cast<Offset>((far_rows_.size() + near_rows_.size()) * sizeof(Row));
    for (const Worker& w : workers_)
        for (const auto* list : {&w.far, &w.near, &w.open, &w.deferred})
            sum += static_cast<Offset>(list->capacity() * sizeof(std::int32_t));
    return sum + static_cast<Offset>(candidates_.capacity() * sizeof(std::int32_t));
}

void CellLists::clear() {
    far_.clear();
    near_.clear();
    workers_.clear();
    tasks_ = {};
    top_ = {};
    candidates_ = {};
    far_rows_ = near_rows_ = {};
}

}  // namespace connectivity::detail
