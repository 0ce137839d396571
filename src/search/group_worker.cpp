// SPDX-License-Identifier: BSD-3-Clause
#include "group_worker.hpp"

#include <limits>
#include <numeric>

namespace connectivity::detail {

template <int Dim>
void GroupWorker<Dim>::process(const GroupSweep<Dim>& sweep, int worker, Offset first,
                               Offset last) {
    sweep_ = &sweep;
    see_ = significance(sweep.nodes);
    form_ = sweep.mode != SearchMode::gather_scatter || see_.H != nullptr ? Form::ellipsoids
            : sweep.boxes.uniform()                                       ? Form::uniform
                                                                          : Form::balls;
    predicate_ = {see_.positions,
                  see_.reach2,
                  see_.H,
                  see_.extent2,
                  {},
                  sweep.mode != SearchMode::scatter,
                  sweep.mode != SearchMode::gather};
    if (see_.periods.any) std::copy_n(see_.periods.length, Dim, predicate_.period);
    worker_ = worker;
    if (first < last) process({first, last, -1});
}

template <int Dim>
ReachBox<Dim> GroupWorker<Dim>::box_of(const Range& range) const {
    ReachBox<Dim> box;
    box.clear();
    if (range.only >= 0) {
        const double* const data = sweep_->boxes.leaf_data(range.first) + range.only;
        double x[Dim];
        for (int d = 0; d < Dim; ++d) x[d] = data[d * leaf_size];
        box.add(x, data[Dim * leaf_size]);
        return box;
    }
    for (Offset l = range.first; l < range.last; ++l) box.add(sweep_->boxes.leaf(l));
    return box;
}

/// The box of a range of the frame, in the frame's coordinates.
template <int Dim>
FrameBox<Dim> GroupWorker<Dim>::inside(const Frame<Dim>& frame, const Range& range) const {
    const ReachBox<Dim> box = box_of(range);
    double width[Dim] = {};
    if (form_ == Form::ellipsoids) sweep_->boxes.widths(range.first, range.last, box.reach2, width);
    return frame.inside(box, sweep_->boxes.fold_error(), width);
}

/// Nothing is searched for ranges whose rows nobody wants, such as ghosts behind all stored nodes.
template <int Dim>
bool GroupWorker<Dim>::is_wanted(const Range& range) const {
    const Slot* const slot = sweep_->order.slot.data();
    const Offset begin = range.first * leaf_size + std::max(range.only, 0);
    const Offset end = range.only < 0 ? range.last * leaf_size : begin + 1;
    return std::any_of(slot + begin, slot + end, [this](Slot s) {
        return s >= 0 && sweep_->sink.wanted(s) != RowSink::Wanted::nothing;
    });
}

template <int Dim>
void GroupWorker<Dim>::process(const Range& range) {
    const bool nobody_sees = sweep_->boxes.all().reach2 < 0;
    if (nobody_sees || !is_wanted(range)) {
        const Slot* const slot = sweep_->order.slot.data();
        for (Offset p = range.first * leaf_size; p < range.last * leaf_size; ++p)
            if (slot[p] >= 0 && (range.only < 0 || p % leaf_size == range.only))
                sweep_->sink.store_nothing(worker_, slot[p]);
        return;
    }
    const Frame<Dim> frame(box_of(range), sweep_->boxes);
    const bool found = frame.is_good() && find_candidates(frame, range);
    if (found) return test_groups(range, frame);
    if (range.only >= 0) return process_exactly(range);
    split(range);
}

template <int Dim>
void GroupWorker<Dim>::split(const Range& range) {
    if (range.last - range.first > 1) {
        const Offset middle = (range.first + range.last) / 2;
        process({range.first, middle, -1});
        process({middle, range.last, -1});
        return;
    }
    for (int k = 0; k < leaf_size; ++k)
        if (sweep_->order.slot(range.first * leaf_size + k) >= 0)
            process({range.first, range.last, k});
}

/// Leaves that hold candidates for a box: a walk through every class's tree.
template <int Dim>
void GroupWorker<Dim>::find_leaves(const ReachBox<Dim>& box) {
    const auto& boxes = sweep_->boxes;
    const auto& order = sweep_->order;
    const double slack = 2 * boxes.fold_error();
    BoxQuery<Dim> query;
    std::copy_n(box.lo, Dim, query.lo), std::copy_n(box.hi, Dim, query.hi);
    query.reach2 = box.reach2, query.slack = slack;
    n_leaves_ = 0;
    for (const ClassTree& tree : order.trees) {
        Offset stack[64];
        int depth = 0;
        stack[depth++] = 1;
        while (depth > 0) {
            const Offset node = stack[--depth];
            if (!is_near(box, boxes.tree_node(tree.first_node + node), slack)) continue;
            if (node < tree.n_blocks) {
                stack[depth++] = 2 * node + 1;
                stack[depth++] = 2 * node;
                continue;
            }
            const Offset block = tree.first_block + node - tree.n_blocks;
            const Offset first = order.block_leaf[block], last = order.block_leaf[block + 1];
            leaves_.reserve(n_leaves_ + last - first + leaf_box_slack, n_leaves_);
            n_leaves_ += sweep_->kernels.near(boxes.leaf_boxes(), first, last, query,
                                              leaves_.data() + n_leaves_);
        }
    }
}

/// Appends the candidates of one periodic image. False if there might be more than can be counted.
template <int Dim>
bool GroupWorker<Dim>::collect_image(const Frame<Dim>& frame, const FrameBox<Dim>& box,
                                     const double (&image)[Dim]) {
    constexpr int most = std::numeric_limits<int>::max() / leaf_size - 1;
    ReachBox<Dim> moved = frame.box;
    for (int d = 0; d < Dim; ++d) moved.lo[d] -= image[d], moved.hi[d] -= image[d];
    find_leaves(moved);
    if (n_leaves_ == 0) return true;
    if (found_.list.n / leaf_size + n_leaves_ > most) return false;
    found_.reserve(found_.list.n + n_leaves_ * leaf_size, form_);
    sweep_->kernels.collect(sweep_->boxes.leaf_array(sweep_->order), leaves_.data(), n_leaves_,
                            frame.map(image, form_), box, found_.list);
    return true;
}

/// Fills block_ with sorted candidates. False if a node came with two images, its distance then not
/// being one number, or if there are too many.
template <int Dim>
bool GroupWorker<Dim>::find_candidates(const Frame<Dim>& frame, const Range& range) {
    const auto& periods = sweep_->nodes.periods;
    int lowest[Dim], image[Dim], images = 0;
    for (int d = 0; d < Dim; ++d) image[d] = lowest[d] = periods.length[d] > 0 ? -1 : 0;
    const FrameBox<Dim> box = inside(frame, range);
    found_.list.n = 0;
    for (bool more = true; more;) {
        double shift[Dim];
        for (int d = 0; d < Dim; ++d) shift[d] = image[d] * periods.length[d];
        const int before = found_.list.n;
        if (!collect_image(frame, box, shift)) return false;
        images += found_.list.n > before;
        more = false;
        for (int d = 0; d < Dim && !more; ++d) {
            more = ++image[d] <= -lowest[d];
            if (!more) image[d] = lowest[d];
        }
    }
    block_.reserve(found_.list.n, form_);
    sort_(found_.list, sweep_->label_bits, form_, block_.list);
    if (form_ == Form::ellipsoids) sweep_->kernels.metrics(block_.list, frame.metric_map());
    counters.candidates += found_.list.n;
    const int* const label = block_.list.label;
    return images <= 1 || std::adjacent_find(label, label + block_.list.n) == label + block_.list.n;
}

template <int Dim>
void GroupWorker<Dim>::test_groups(const Range& range, const Frame<Dim>& frame) {
    constexpr Offset leaves_per_group = 4;
    if (range.only >= 0) return test_leaf(range.first, range.only, frame);
    for (Offset first = range.first; first < range.last; first += leaves_per_group) {
        const Range group{first, std::min(first + leaves_per_group, range.last), -1};
        group_.reserve(block_.list.n, form_);
        sweep_->kernels.filter(block_.list, inside(frame, group), frame.widen(), form_,
                               group_.list);
        for (Offset leaf = group.first; leaf < group.last; ++leaf) test_leaf(leaf, -1, frame);
    }
}

template <int Dim>
void GroupWorker<Dim>::test_leaf(Offset leaf, int only, const Frame<Dim>& frame) {
    const auto& boxes = sweep_->boxes;
    const Slot* const slot = sweep_->order.slot.data() + leaf * leaf_size;
    const double* const data = boxes.leaf_data(leaf);
    const CandidateList<Dim>& wide = only < 0 ? group_.list : block_.list;
    leaf_.reserve(wide.n, form_);
    sweep_->kernels.last_filter(wide, inside(frame, {leaf, leaf + 1, only}), frame.widen(), form_,
                                leaf_.list);

    LeafTest<Dim> test;
    RowSink::Wanted wanted[leaf_size];
    int own[leaf_size];
    test.n_nodes = 0;
    std::fill_n(own, leaf_size, 0);
    for (int k = 0; k < leaf_size; ++k) {
        if (slot[k] < 0 || (only >= 0 && k != only)) continue;
        const int at = test.n_nodes++;
        for (int d = 0; d < Dim; ++d)
            test.x[d][at] =
                static_cast<float>((data[d * leaf_size + k] - frame.centre[d]) * frame.scale);
        test.t[at] = static_cast<float>(data[Dim * leaf_size + k] * frame.t_scale());
        own[at] = slot[k];
        sweep_->sink.prefetch(slot[k]);
        wanted[at] = sweep_->sink.wanted(slot[k]);
    }
    const int words = n_words(leaf_.list.n);
    sweep_->kernels.places(own, leaf_.list.label, leaf_.list.n, test.place);
    for (int at = 0; at < test.n_nodes; ++at)
        test.first_word[at] = wanted[at] == RowSink::Wanted::all     ? 0
                              : wanted[at] == RowSink::Wanted::later ? test.place[at] / word_size
                                                                     : words;
    test.band = frame.band();
    test.form = form_;
    test.own = predicate_.own, test.others = predicate_.others;
    bits_.reserve(static_cast<std::size_t>(leaf_size) * words);
    doubts_.reserve(static_cast<std::size_t>(leaf_size) * words);
    const int n_doubts = sweep_->kernels.test(test, leaf_.list, bits_.data(), doubts_.data());
    settle_doubts(own, words, n_doubts);
    for (int at = 0; at < test.n_nodes; ++at)
        keep_row(own[at], bits_.data() + static_cast<Offset>(at) * words, words, test.place[at],
                 wanted[at]);
}

/// Candidates inside the error band: the double predicate decides.
template <int Dim>
void GroupWorker<Dim>::settle_doubts(const int* own, int words, int n_doubts) {
    for (int k = 0; k < n_doubts; ++k) {
        Doubt& doubt = doubts_.data()[k];
        sweep_->kernels.confirm(predicate_, own[doubt.node],
                                leaf_.list.label + doubt.word * word_size, 1, &doubt.bits);
        bits_.data()[static_cast<Offset>(doubt.node) * words + doubt.word] |= doubt.bits;
    }
    counters.doubts += n_doubts;
}

template <int Dim>
void GroupWorker<Dim>::keep_row(Slot slot, std::uint64_t* bits, int words, int place,
                                RowSink::Wanted wanted) {
    if (wanted == RowSink::Wanted::nothing) return sweep_->sink.store_nothing(worker_, slot);
    const int own_word = place / word_size;
    bits[own_word] &= ~(std::uint64_t{1} << (place % word_size));
    if (wanted == RowSink::Wanted::later)
        bits[own_word] &= ~std::uint64_t{0} << (place % word_size);
    sweep_->sink.store(worker_, {slot, bits, leaf_.list.label, words, place});
}

/// The last resort for a node whose frame has no good floats: all nodes of near leaves, each once,
/// in double.
template <int Dim>
void GroupWorker<Dim>::process_exactly(const Range& range) {
    const Slot slot = sweep_->order.slot(range.first * leaf_size + range.only);
    const auto& periods = sweep_->nodes.periods;
    ReachBox<Dim> box = box_of(range);
    for (int d = 0; d < Dim; ++d)  // any image: the walk must not miss one
        if (periods.length[d] > 0)
            box.lo[d] = -periods.length[d], box.hi[d] = 2 * periods.length[d];
    find_leaves(box);
    auto& list = leaf_.list;
    list.n = 0;
    leaf_.reserve(n_leaves_ * leaf_size, form_);
    for (int near = 0; near < n_leaves_; ++near)
        for (int k = 0; k < leaf_size; ++k) {
            const Slot other =
                sweep_->order.slot(static_cast<Offset>(leaves_.data()[near]) * leaf_size + k);
            if (other >= 0 && (other == slot || see_(slot, other, sweep_->mode)))
                list.label[list.n++] = other;
        }
    std::sort(list.label, list.label + list.n);
    std::fill_n(list.label + list.n, list_slack, no_label);
    const int words = n_words(list.n);
    bits_.reserve(words);
    std::fill_n(bits_.data(), words, std::uint64_t{0});
    for (int k = 0; k < list.n; ++k)
        if (list.label[k] != slot && see_(slot, list.label[k], sweep_->mode))
            bits_.data()[k / word_size] |= std::uint64_t{1} << (k % word_size);
    const int place =
        static_cast<int>(std::lower_bound(list.label, list.label + list.n, slot) - list.label);
    ++counters.exact_nodes;
    const auto wanted = sweep_->sink.wanted(slot);
    if (wanted == RowSink::Wanted::later) {
        std::fill_n(bits_.data(), place / word_size, std::uint64_t{0});
        bits_.data()[place / word_size] &= ~std::uint64_t{0} << (place % word_size);
    }
    sweep_->sink.store(worker_, {slot, bits_.data(), list.label, words, place});
}

template <int Dim>
Offset GroupWorker<Dim>::bytes() const {
    return static_cast<Offset>(found_.bytes() + block_.bytes() + group_.bytes() + leaf_.bytes() +
                               bits_.bytes() + doubts_.bytes() + leaves_.bytes() + sizeof(*this));
}

template class GroupWorker<1>;
template class GroupWorker<2>;
template class GroupWorker<3>;

}  // namespace connectivity::detail
