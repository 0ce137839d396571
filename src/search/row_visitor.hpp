// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Rows as they are found, handed to a function of the host instead of being stored.
///
/// Invariants: whole rows are handed over for every stored slot, half rows for every slot, empty
/// ones too, each once. Memory: one row for each worker.

#include <vector>

#include <connectivity/base/parallel.hpp>
#include <connectivity/search/row_function.hpp>

#include "candidate_store.hpp"
#include "row_sink.hpp"

namespace connectivity::detail {

/// Throws HostException.
inline void call_host(const RowFunction& f, int worker, Slot slot, std::span<const Slot> row) {
    try {
        f(worker, slot, row);
    } catch (...) {
        throw HostException{std::current_exception()};
    }
}

class RowVisitor final : public RowSink {
public:
    RowVisitor(const SlotLayout& layout, bool halves, BitKernels kernels, RowFunction f)
        : kernels_(kernels), f_(f), row_(static_cast<std::size_t>(n_workers())) {
        want(layout, !halves, halves);
    }

    /// Throw HostException, std::bad_alloc.
    void store(int worker, const FoundRow& row) override;
    void store_nothing(int worker, Slot slot) override;

private:
    struct alignas(64) Row {
        Buffer<Slot> slots;
    };

    BitKernels kernels_;
    RowFunction f_;
    std::vector<Row> row_;  // [n_workers]
};

}  // namespace connectivity::detail
