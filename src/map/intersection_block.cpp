// SPDX-License-Identifier: BSD-3-Clause
#include "intersection_block.hpp"

#include <cstring>
#include <new>

#include "search/kernels.hpp"

namespace connectivity::detail {

namespace {

constexpr Offset longest_bits = 1024;  ///< neighbours of a node whose pairs are kept as bits
constexpr Offset bisect_ratio = 16;    ///< how much longer a row is bisected rather than read

template <class T>
T* grown(std::vector<T>& v, std::size_t n) {
    if (v.size() < n) v.resize(std::max(n, 2 * v.size()));
    return v.data();
}

template <class T>
constexpr Offset words_of(Offset n) {
    return (n * Offset{sizeof(T)} + 7) / 8;
}

}  // namespace

/// Numbers all nodes of the members' rows.
template <int Dim>
void IntersectionBlock<Dim>::take_members(const Source& input, Offset first, Offset last) {
    numbers_.clear();
    for (Offset k = first; k < last; ++k) {
        if (k + 8 < last) input.rows.prefetch(input.label_at(static_cast<Slot>(k + 8)));
        const Slot a = input.label_at(static_cast<Slot>(k));
        if (input.rows.size(a) > longest_bits) continue;
        numbers_.add(input.place(a));
        const auto row = input.rows[a];
        numbers_.add(row, input.place_of, grown(scratch_, row.size()));
    }
    index_.assign(static_cast<std::size_t>(numbers_.n()), 0);
    n_index_ = 1;
    for (int k = 0; k < numbers_.n(); ++k)
        if (numbers_.is_met(k)) index_[static_cast<std::size_t>(k)] = n_index_++;
    partner_.assign(static_cast<std::size_t>(n_index_), -1);
    table_.assign(static_cast<std::size_t>(n_index_), Entry{});
}

/// The part of a row that members' rows can have in common with it.
template <int Dim>
void IntersectionBlock<Dim>::read_row(const Source& input, Slot label) {
    const auto row = input.rows[label];
    const std::size_t at = row_end_.empty() ? 0 : static_cast<std::size_t>(row_end_.back());
    int* out = grown(row_, at + row.size()) + at;
    for (const Slot k : row) {
        const int number = numbers_.find(input.place(k));
        const int index = number < 0 ? 0 : index_[static_cast<std::size_t>(number)];
        *out = index;
        out += index != 0;
    }
    row_end_.push_back(out - row_.data());
}

/// Reads the rows of all partners, once each.
template <int Dim>
void IntersectionBlock<Dim>::read_partners(const Source& input, Offset first, Offset last) {
    row_end_.clear();
    std::vector<Slot>& found = universe_;
    for (Offset k = first; k < last; ++k) {
        const Slot a = input.label_at(static_cast<Slot>(k));
        const Offset n = input.rows.size(a);
        if (n > longest_bits) continue;
        found.clear();
        for (const Slot b : input.half_rows[a]) {
            const int number = numbers_.find(input.place(b));
            const int index = number < 0 ? 0 : index_[static_cast<std::size_t>(number)];
            if (index == 0 || partner_[static_cast<std::size_t>(index)] >= 0 ||
                input.rows.size(b) > bisect_ratio * (n + 64))
                continue;
            partner_[static_cast<std::size_t>(index)] =
                static_cast<int>(row_end_.size() + found.size());
            found.push_back(b);
        }
        for (const Slot b : found) input.rows.prefetch(b);
        for (const Slot b : found) read_row(input, b);
    }
}

/// The row of a, with a itself and its partners, and which of them are neighbours.
template <int Dim>
void IntersectionBlock<Dim>::take_universe(const Source& input, Slot a) {
    const auto row = input.rows[a], half = input.half_rows[a];
    universe_.clear(), own_.clear(), ends_.clear();
    own_end_ = -1;
    const auto add = [&](Slot label, bool neighbour) {
        const int number = neighbour ? numbers_.find(input.place(label)) : -1;
        universe_.push_back(label);
        own_.push_back(number < 0 ? 0 : index_[static_cast<std::size_t>(number)]);
        return static_cast<int>(universe_.size()) - 1;
    };
    auto b = half.begin();
    const auto add_others = [&](Slot before) {
        if (own_end_ < 0 && a < before) own_end_ = add(a, false);
        for (; b != half.end() && *b < before; ++b) ends_.push_back(add(*b, false));
    };
    for (const Slot k : row) {
        add_others(k);
        const int place = add(k, true);
        if (b != half.end() && *b == k) ends_.push_back(place), ++b;
    }
    add_others(no_label);
}

/// Bits of the nodes that are in the row of b too, which is long.
template <int Dim>
void IntersectionBlock<Dim>::bisect(const Source& input, Slot b, std::uint64_t* bits) {
    const auto row = input.rows[b];
    for (std::size_t k = 0; k < universe_.size(); ++k)
        if (own_[k] != 0 && std::binary_search(row.begin(), row.end(), universe_[k]))
            bits[k / 64] |= std::uint64_t{1} << k % 64;
}

/// The union of the table's entries for a partner's row.
template <int Dim>
void IntersectionBlock<Dim>::unite(int partner, std::uint64_t (&sum)[2]) const {
    const auto p = static_cast<std::size_t>(partner);
    const int *k = row_.data() + (p == 0 ? 0 : row_end_[p - 1]), *const end =
                                                                     row_.data() + row_end_[p];
    const Entry* const table = table_.data();
    std::uint64_t low = 0, high = 0;
    for (; k < end; ++k) low |= table[*k].bits[0], high |= table[*k].bits[1];
    sum[0] = low, sum[1] = high;
}

/// Bits of the common neighbours of a member and each of its partners.
template <int Dim>
void IntersectionBlock<Dim>::mark_common(const Source& input, std::span<const Slot> half,
                                         std::uint64_t* bits) {
    const int words = n_words(static_cast<int>(universe_.size()));
    for (int w = 0; w < words; w += 2) {
        const std::size_t first = static_cast<std::size_t>(w) * 64,
                          last = std::min(first + 128, universe_.size());
        const auto entry = [&](std::size_t k) -> Entry& {
            return table_[static_cast<std::size_t>(own_[k])];
        };
        for (std::size_t k = first; k < last; ++k)
            entry(k).bits[(k - first) / 64] |= std::uint64_t{1} << k % 64;
        for (std::size_t j = 0; j < half.size(); ++j) {
            const auto index = static_cast<std::size_t>(own_[static_cast<std::size_t>(ends_[j])]);
            std::uint64_t* const out = bits + static_cast<Offset>(j) * words;
            if (const int partner = partner_[index]; partner >= 0) {
                std::uint64_t sum[2];
                unite(partner, sum);
                for (int k = w; k < std::min(w + 2, words); ++k) out[k] = sum[k - w];
            } else if (w == 0) {
                bisect(input, half[j], out);
            }
        }
        for (std::size_t k = first; k < last; ++k) entry(k) = {};
    }
}

template <int Dim>
PairRows* IntersectionBlock<Dim>::store_bits(const Source& input, Slot a, WordArena& arena,
                                             Slot* counts) {
    take_universe(input, a);
    const auto half = input.half_rows[a];
    const auto n = static_cast<int>(universe_.size());
    PairRows rows;
    rows.first_pair = input.half_rows.offsets[a];
    rows.n_pairs = input.half_rows.size(a);
    rows.n_words = n_words(n);
    constexpr Offset head = sizeof(PairRows) / 8;
    std::uint64_t* const memory =
        arena.take(head + Offset{rows.n_words} * 32 + rows.n_pairs * rows.n_words);
    auto* const slots = reinterpret_cast<Slot*>(memory + head);
    for (int k = 0; k < rows.n_words * 64; ++k)
        slots[k] = k < n ? input.labels.slot(universe_[static_cast<std::size_t>(k)]) : no_label;
    auto* bits = memory + head + Offset{rows.n_words} * 32;
    rows.slots = slots, rows.bits = bits;
    std::memset(bits, 0, static_cast<std::size_t>(rows.n_pairs * rows.n_words) * 8);
    mark_common(input, half, bits);
    if (input.in_segment) segments_.start(input.positions, input.periods, a, universe_);
    const auto count = kernels<3>().count;
    const auto keep_between = bit_row_kernels().keep_between;
    for (const int other : ends_) {
        if (input.in_segment) {
            segments_.aim(static_cast<std::size_t>(other));
            keep_between(segments_.slab(), bits, rows.n_words);
        }
        for (const int end : {own_end_, other}) bits[end / 64] |= std::uint64_t{1} << end % 64;
        *counts = count(bits, n);
        rows.n_entries += *counts++;
        bits += rows.n_words;
    }
    return new (memory) PairRows(rows);
}

/// Of a node with so long a row that bits would be sparse: entries themselves.
template <int Dim>
PairRows* IntersectionBlock<Dim>::store_rows(const Source& input, Slot a, WordArena& arena,
                                             Slot* counts) {
    long_rows_.clear();
    for (const Slot b : input.half_rows[a]) {
        const std::size_t before = long_rows_.size();
        common_row(input, a, b, universe_, segments_);
        for (const Slot label : universe_) long_rows_.push_back(input.labels.slot(label));
        *counts++ = static_cast<Slot>(long_rows_.size() - before);
    }
    PairRows rows;
    rows.first_pair = input.half_rows.offsets[a];
    rows.n_pairs = input.half_rows.size(a);
    rows.n_entries = static_cast<Offset>(long_rows_.size());
    constexpr Offset head = sizeof(PairRows) / 8;
    std::uint64_t* const memory = arena.take(head + words_of<Slot>(rows.n_entries));
    std::memcpy(memory + head, long_rows_.data(), long_rows_.size() * sizeof(Slot));
    rows.slots = reinterpret_cast<const Slot*>(memory + head);
    return new (memory) PairRows(rows);
}

template <int Dim>
const PairRows* IntersectionBlock<Dim>::store(const Source& input, Offset first, Offset last,
                                              WordArena& arena, Slot* counts) {
    take_members(input, first, last);
    read_partners(input, first, last);
    const PairRows* head = nullptr;
    PairRows* tail = nullptr;
    for (Offset k = first; k < last; ++k) {
        const Slot a = input.label_at(static_cast<Slot>(k));
        if (input.half_rows.size(a) == 0) continue;
        Slot* const own_counts = counts + input.half_rows.offsets[a];
        PairRows* const rows = input.rows.size(a) > longest_bits
                                   ? store_rows(input, a, arena, own_counts)
                                   : store_bits(input, a, arena, own_counts);
        (tail != nullptr ? tail->next : head) = rows;
        tail = rows;
    }
    return head;
}

template <int Dim>
void common_row(const IntersectionInput<Dim>& input, Slot a, Slot b, std::vector<Slot>& out,
                SegmentsFrom<Dim>& segments) {
    auto shorter = input.rows[a], longer = input.rows[b];
    if (shorter.size() > longer.size()) std::swap(shorter, longer);
    out.clear();
    if (longer.size() / 16 < shorter.size()) {
        std::set_intersection(shorter.begin(), shorter.end(), longer.begin(), longer.end(),
                              std::back_inserter(out));
    } else {
        for (const Slot k : shorter)
            if (std::binary_search(longer.begin(), longer.end(), k)) out.push_back(k);
    }
    if (input.in_segment) {
        out.push_back(b);
        segments.start(input.positions, input.periods, a, out);
        segments.aim(out.size() - 1);
        out.pop_back();
        std::size_t n = 0;
        for (std::size_t k = 0; k < out.size(); ++k)
            if (segments.holds(k)) out[n++] = out[k];
        out.resize(n);
    }
    for (const Slot end : {a, b}) {
        const auto at = std::lower_bound(out.begin(), out.end(), end);
        if (at == out.end() || *at != end) out.insert(at, end);
    }
}

template <int Dim>
Offset IntersectionBlock<Dim>::bytes() const {
    const auto held = [](const auto&... v) {
        return (static_cast<Offset>(v.capacity() * sizeof(v[0])) + ...);
    };
    return numbers_.bytes() + segments_.bytes() +
           held(index_, partner_, row_, row_end_, scratch_, table_, universe_, own_, ends_,
                long_rows_);
}

#define CONNECTIVITY_INSTANTIATE(Dim)                                                            \
    template class IntersectionBlock<Dim>;                                                       \
    template void common_row<Dim>(const IntersectionInput<Dim>&, Slot, Slot, std::vector<Slot>&, \
                                  SegmentsFrom<Dim>&);
CONNECTIVITY_INSTANTIATE(1)
CONNECTIVITY_INSTANTIATE(2)
CONNECTIVITY_INSTANTIATE(3)
#undef CONNECTIVITY_INSTANTIATE

}  // namespace connectivity::detail
