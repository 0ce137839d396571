// SPDX-License-Identifier: BSD-3-Clause
#include "row_visitor.hpp"

namespace connectivity::detail {

void RowVisitor::store(int worker, const FoundRow& found) {
    const int first = rows_ ? 0 : found.place / word_size, words = found.n_words - first;
    Buffer<Slot>& row = row_[worker].slots;
    row.reserve(static_cast<std::size_t>(words) * word_size + list_slack);
    int n = kernels_.expand(found.bits + first, words, found.label + first * word_size, row.data());
    if (halves_ && !layout_->is_stored(found.slot)) n = keep_stored(row.data(), n);
    call_host(f_, worker, found.slot, {row.data(), static_cast<std::size_t>(n)});
}

void RowVisitor::store_nothing(int worker, Slot slot) {
    if (halves_ || layout_->is_stored(slot)) call_host(f_, worker, slot, {});
}

}  // namespace connectivity::detail
