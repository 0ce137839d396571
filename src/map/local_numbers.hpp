// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Small numbers for the nodes that a block of close nodes meets.
///
/// Nodes have places in an order that keeps close ones together; places come in pages of 64, and a
/// page gets the next 64 numbers when its first node is met. So a question costs one look into a
/// small hash table of pages, and memory follows the block and not the number of nodes. Numbers
/// have gaps: `is_met` tells which are nodes that were met. Invariant: at most an eighth of the
/// table is taken.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <connectivity/base/types.hpp>

namespace connectivity::detail {

class LocalNumbers {
public:
    static constexpr int page_size = 64;

    LocalNumbers() { use_table(smallest_bits); }

    /// Numbers given, gaps included.
    int n() const { return static_cast<int>(pages_.size()) * page_size; }
    bool is_met(int number) const { return met_[static_cast<std::size_t>(number)] != 0; }
    Slot place(int number) const {
        return pages_[static_cast<std::size_t>(number / page_size)] * page_size +
               number % page_size;
    }

    /// Numbers the node at a place. Throws std::bad_alloc.
    int add(Slot place) {
        const auto at = static_cast<std::uint32_t>(place);
        const int number =
            page(static_cast<Slot>(at / page_size)) * page_size + static_cast<int>(at % page_size);
        met_[static_cast<std::size_t>(number)] = 1;
        return number;
    }

    /// The number of the node at a place, or -1 if no node of its page was met.
    int find(Slot place) const {
        const auto at = static_cast<std::uint32_t>(place);
        const auto page = static_cast<Slot>(at / page_size);
        const Entry entry = table_[home(page)];
        const int index = entry.page == page ? entry.index : find_known(page);
        return index < 0 ? -1 : index * page_size + static_cast<int>(at % page_size);
    }

    /// Numbers of a row of labels; place_of may be null: places are labels. Throws std::bad_alloc.
    void add(std::span<const Slot> row, const Slot* place_of, int* numbers) {
        if (place_of == nullptr)
            for (const Slot label : row) *numbers++ = add(label);
        else
            for (const Slot label : row) *numbers++ = add(place_of[label]);
    }

    /// Forgets all nodes, keeps the memory.
    void clear() {
        for (const std::uint32_t at : homes_) table_[at].page = -1;
        std::fill_n(met_.begin(), n(), std::uint8_t{0});
        pages_.clear(), homes_.clear();
        use_table(smallest_bits);
    }

    Offset bytes() const {
        return static_cast<Offset>(table_.capacity() * sizeof(Entry) + met_.capacity() +
                                   (pages_.capacity() + homes_.capacity()) * sizeof(Slot));
    }

private:
    struct Entry {
        Slot page = -1;
        int index = 0;
    };
    static constexpr int smallest_bits = 9;

    /// Pages that lie a power of two apart must not share a home: on lattices they do.
    std::uint32_t home(Slot page) const {
        return (static_cast<std::uint32_t>(page) * 2654435769u) >> shift_;
    }

    int page(Slot page) {
        const Entry entry = table_[home(page)];
        return entry.page == page ? entry.index : find_page(page);
    }

    [[gnu::noinline]] int find_page(Slot page) {
        std::uint32_t at = home(page);
        for (; table_[at].page != page; at = (at + 1) & mask_)
            if (table_[at].page < 0) return insert(page, at);
        return table_[at].index;
    }

    [[gnu::noinline]] int find_known(Slot page) const {
        for (std::uint32_t at = home(page); table_[at].page >= 0; at = (at + 1) & mask_)
            if (table_[at].page == page) return table_[at].index;
        return -1;
    }

    int insert(Slot page, std::uint32_t at) {
        const int index = static_cast<int>(pages_.size());
        const std::size_t needed = (pages_.size() + 1) * page_size;
        if (met_.size() < needed) met_.resize(std::max(needed, 2 * met_.size()), 0);
        pages_.push_back(page), homes_.push_back(at);
        table_[at] = {page, index};
        if (8 * pages_.size() > mask_) grow();
        return index;
    }

    /// The first 2^bits entries are the table; all are free.
    void use_table(int bits) {
        const std::size_t size = std::size_t{1} << bits;
        if (table_.size() < size) table_.resize(size);
        mask_ = static_cast<std::uint32_t>(size - 1);
        shift_ = 32 - bits;
    }

    void grow() {
        for (const std::uint32_t at : homes_) table_[at].page = -1;
        use_table(33 - shift_);
        for (std::size_t k = 0; k < pages_.size(); ++k) {
            std::uint32_t at = home(pages_[k]);
            while (table_[at].page >= 0) at = (at + 1) & mask_;
            table_[at] = {pages_[k], static_cast<int>(k)};
            homes_[k] = at;
        }
    }

    std::vector<Entry> table_;
    std::vector<Slot> pages_;           // in order of first sight
    std::vector<std::uint32_t> homes_;  // of the pages in the table
    std::vector<std::uint8_t> met_;     // by number; all 0 beyond n()
    std::uint32_t mask_ = 0;
    int shift_ = 0;
};

}  // namespace connectivity::detail
