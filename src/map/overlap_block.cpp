// SPDX-License-Identifier: BSD-3-Clause
#include "overlap_block.hpp"

#include <bit>
#include <cstring>
#include <new>

#include "search/kernels.hpp"

#include "bit_rows.hpp"
#include "stable_sort.hpp"

namespace connectivity::detail {

namespace {

// Measured: bits of witnesses that stay in a second-level cache are read fastest, and more than a
// few dozen members share them well, unless they are far apart. Beyond the second pair of limits
// sharing costs too much memory.
constexpr Offset good_bit_bytes = Offset{1} << 21, most_bit_bytes = Offset{1} << 26;
constexpr Offset good_seen = Offset{1} << 20, most_seen = Offset{1} << 26;
constexpr std::size_t enough_members = 32;

}  // namespace

void OverlapBlock::begin() {
    numbers_.clear();
    members_.clear(), witnesses_.clear(), own_.clear(), witness_of_.clear();
    use_.clear(), use_end_.clear(), seen_.clear(), seen_end_.clear();
    alone_ = false;
}

bool OverlapBlock::is_full() const {
    const auto witnesses = static_cast<Offset>(witnesses_.size());
    const Offset bit_bytes = witnesses * padded_words(numbers_.n()) * 8,
                 seen = static_cast<Offset>(seen_.size());
    if (alone_ || bit_bytes > most_bit_bytes || seen > most_seen) return true;
    const bool shares = static_cast<Offset>(use_.size()) > 2 * witnesses;
    return (members_.size() >= enough_members || !shares) &&
           (bit_bytes > good_bit_bytes || seen > good_seen);
}

/// The number of a witness among the block's.
int OverlapBlock::witness(const OverlapSource& input, Slot place) {
    const auto number = static_cast<std::size_t>(numbers_.add(place));
    if (number >= witness_of_.size())
        witness_of_.resize(static_cast<std::size_t>(numbers_.n()), -1);
    if (witness_of_[number] < 0) {
        witness_of_[number] = static_cast<int>(witnesses_.size());
        witnesses_.push_back(place);
        __builtin_prefetch(input.scatter.offsets + place);
    }
    return witness_of_[number];
}

void OverlapBlock::add_member(const OverlapSource& input, Slot place) {
    members_.push_back(place);
    own_.push_back(numbers_.add(place));
    use_.push_back(witness(input, place));
    for (const Slot k : input.gather[place]) use_.push_back(witness(input, k));
    use_end_.push_back(static_cast<Offset>(use_.size()));
}

Offset OverlapBlock::add(const OverlapSource& input, Offset first, Offset last) {
    // A few at a time, so that the rows of their witnesses are under way together.
    constexpr Offset batch = 16;
    const Offset most = 4 * static_cast<Offset>(witnesses_.size()) + 1024;
    Offset place = first;
    for (const Offset end = std::min(last, first + batch); place < end; ++place) {
        const bool is_large = input.gather.size(place) > most;
        if (is_large && !members_.empty()) break;
        add_member(input, static_cast<Slot>(place));
        if (is_large) {
            Offset seen = 0;
            for (const Slot k : witnesses_) seen += input.scatter.size(k) + 1;
            alone_ = seen > most_seen;
            ++place;
            break;
        }
    }
    for (Offset next = place; next < std::min(last, place + batch); ++next)
        input.gather.prefetch(next);
    read_witnesses(input);
    return place - first;
}

/// Numbers what is seen at witnesses not read yet.
void OverlapBlock::read_witnesses(const OverlapSource& input) {
    constexpr std::size_t ahead = 8;
    const std::size_t first = seen_end_.size(), n = witnesses_.size();
    for (std::size_t w = first; w < std::min(n, first + ahead); ++w)
        input.scatter.prefetch(witnesses_[w]);
    for (std::size_t w = first; w < n; ++w) {
        if (w + ahead < n) input.scatter.prefetch(witnesses_[w + ahead]);
        const auto row = input.scatter[witnesses_[w]];
        const std::size_t at = alone_ ? 0 : seen_.size();
        if (seen_.size() < at + row.size() + 1) seen_.resize(at + row.size() + 1);
        seen_[at] = numbers_.add(witnesses_[w]);
        numbers_.add(row, nullptr, seen_.data() + at + 1);
        seen_end_.push_back(static_cast<Offset>(seen_.size()));
    }
}

/// Sorts what was met by (list, label): the order of every row.
void OverlapBlock::order_universe(const OverlapSource& input) {
    const Labels& labels = input.labels;
    keys_.clear();
    for (int k = 0; k < numbers_.n(); ++k)
        if (numbers_.is_met(k))
            keys_.push_back(std::uint64_t(input.label_at(numbers_.place(k))) << 32 |
                            static_cast<unsigned>(k));
    const std::size_t n = keys_.size();
    spare_keys_.resize(n), rank_.resize(static_cast<std::size_t>(numbers_.n()));
    universe_.assign(n + word_size, no_label);
    n_universe_ = static_cast<int>(n);
    sort_by_high_half(keys_, spare_keys_, digits_);
    const auto slot = [&](std::uint64_t key) { return labels.slot(static_cast<Slot>(key >> 32)); };
    const int n_lists = labels.layout.n_lists();
    if (n_lists > 1) {
        const auto list = [&](std::uint64_t key) { return labels.layout.list_of_slot(slot(key)); };
        list_end_.assign(static_cast<std::size_t>(n_lists), 0);
        for (const std::uint64_t key : keys_) ++list_end_[static_cast<std::size_t>(list(key))];
        for (std::size_t l = 1; l < list_end_.size(); ++l) list_end_[l] += list_end_[l - 1];
        if (labels.slot_of != nullptr)
            stable_sort_by(keys_, spare_keys_, digits_, static_cast<std::size_t>(n_lists), list);
    } else {
        list_end_.assign(1, static_cast<int>(n));
    }
    for (std::size_t k = 0; k < n; ++k) {
        rank_[keys_[k] & 0xffffffffu] = static_cast<int>(k);
        universe_[k] = slot(keys_[k]);
    }
}

/// [witnesses * stride], until the next block. Memory only grows: giving a View back inside a
/// parallel loop waits for that loop in Kokkos 4.
const std::uint64_t* OverlapBlock::witness_bits(long stride) {
    bits_.reset();
    std::uint64_t* const bits = bits_.take(static_cast<Offset>(witnesses_.size()) * stride);
    const int* seen = seen_.data();
    for (std::size_t w = 0; w < witnesses_.size(); ++w) {
        std::uint64_t* const row = bits + static_cast<Offset>(w) * stride;
        std::memset(row, 0, static_cast<std::size_t>(stride) * sizeof *row);
        for (const int* const end = seen_.data() + seen_end_[w]; seen < end; ++seen) {
            const int place = rank_[static_cast<std::size_t>(*seen)];
            row[place / 64] |= std::uint64_t{1} << place % 64;
        }
    }
    return bits;
}

/// Room in the arena, with members and universe already there.
OverlapRows* OverlapBlock::take(WordArena& arena) const {
    OverlapRows rows;
    rows.n_members = static_cast<int>(members_.size());
    rows.n_universe = n_universe_;
    rows.stride = padded_words(rows.n_universe);
    const int universe_words = n_words(rows.n_universe) * word_size / 2,
              member_words = (rows.n_members + 1) / 2;
    static_assert(sizeof(OverlapRows) % 8 == 0);
    constexpr int head_words = sizeof(OverlapRows) / 8;
    std::uint64_t* const memory =
        arena.take(head_words + universe_words + member_words + rows.n_members * rows.stride);
    auto* const universe = reinterpret_cast<Slot*>(memory + head_words);
    std::memcpy(universe, universe_.data(), static_cast<std::size_t>(universe_words) * 8);
    rows.universe = universe;
    rows.members = universe + universe_words * 2;
    rows.bits = memory + head_words + universe_words + member_words;
    return new (memory) OverlapRows(rows);
}

void OverlapBlock::count(const OverlapRows& rows, int member, Slot* counts) const {
    const auto count_before = kernels<3>().count;
    int before = 0;
    for (const int end : list_end_) {
        const int n = count_before(rows.bits + member * rows.stride, end);
        *counts++ = n - before;
        before = n;
    }
}

OverlapRows* OverlapBlock::store(const OverlapSource& input, WordArena& arena, Slot* counts) {
    order_universe(input);
    OverlapRows* const rows = take(arena);
    const bool single = rows->n_members == 1;
    const std::uint64_t* const seen = single ? nullptr : witness_bits(rows->stride);
    const auto unite = bit_row_kernels().unite;
    const int* use = use_.data();
    for (int m = 0; m < rows->n_members; ++m) {
        auto* const bits = const_cast<std::uint64_t*>(rows->bits) + m * rows->stride;
        const int* const end = use_.data() + use_end_[static_cast<std::size_t>(m)];
        if (single)
            std::memset(bits, 0xff, static_cast<std::size_t>(rows->stride) * sizeof *bits);
        else
            unite(seen, rows->stride, use, static_cast<int>(end - use), bits);
        use = end;
        const int own = rank_[static_cast<std::size_t>(own_[static_cast<std::size_t>(m)])];
        bits[own / 64] &= ~(std::uint64_t{1} << own % 64);
        const Slot slot = input.labels.slot(input.label_at(members_[static_cast<std::size_t>(m)]));
        const_cast<Slot*>(rows->members)[m] = slot;
        count(*rows, m, counts + Offset{slot} * input.labels.layout.n_lists());
    }
    if (single) {  // nothing beyond the universe
        auto* const bits = const_cast<std::uint64_t*>(rows->bits);
        for (long k = rows->n_universe; k < rows->stride * 64; ++k)
            bits[k / 64] &= ~(std::uint64_t{1} << k % 64);
    }
    return rows;
}

Offset OverlapBlock::bytes() const {
    const auto held = [](const auto&... v) {
        return (static_cast<Offset>(v.capacity() * sizeof(v[0])) + ...);
    };
    return numbers_.bytes() + bits_.bytes() +
           held(members_, witnesses_, own_, witness_of_, use_, use_end_, seen_, seen_end_, keys_,
                spare_keys_, digits_, rank_, universe_, list_end_);
}

}  // namespace connectivity::detail
