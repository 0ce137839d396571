// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include <connectivity/base/parallel.hpp>

#include "callbacks.hpp"
#include "guard.hpp"
#include "map_work.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

/// Gathers rows in one block for each worker and hands full ones to the host: a callback from
/// another language may cost as much as a row. Blocks stay in the first-level cache.
class BlockCallback {
public:
    BlockCallback(conn_rows_callback callback, void* user_data, IndexBase base)
        : callback_(callback), user_data_(user_data), base_(base), block_(n_workers()) {}

    void operator()(int worker, Slot slot, std::span<const Slot> neighbours) {
        Block& block = block_[worker];
        if (block.n_rows == most_rows ||
            (block.n_rows > 0 && block.size() + neighbours.size() > most_neighbours))
            hand_over(worker);
        if (block.neighbours.size() < block.size() + neighbours.size())
            block.neighbours.resize(std::max(most_neighbours, neighbours.size()));
        std::ranges::transform(neighbours, block.neighbours.begin() + block.offsets[block.n_rows],
                               [base = base_](Slot j) { return base.out(j); });
        block.slots[block.n_rows] = base_.out(slot);
        block.offsets[block.n_rows + 1] =
            block.offsets[block.n_rows] + static_cast<std::int64_t>(neighbours.size());
        ++block.n_rows;
    }

    /// What is left when all rows were found.
    void finish() {
        for (int worker = 0; worker < static_cast<int>(block_.size()); ++worker)
            if (block_[worker].n_rows > 0) hand_over(worker);
    }

private:
    static constexpr std::size_t most_neighbours = 4096, most_rows = 1024;

    struct alignas(64) Block {
        std::size_t n_rows = 0;
        std::array<std::int32_t, most_rows> slots;
        std::array<std::int64_t, most_rows + 1> offsets{};
        std::vector<std::int32_t> neighbours;

        std::size_t size() const { return static_cast<std::size_t>(offsets[n_rows]); }
    };

    /// Throws Error{callback} if the host stops; what other workers find after that is dropped.
    void hand_over(int worker) {
        Block& block = block_[worker];
        const auto n_rows = static_cast<std::int64_t>(std::exchange(block.n_rows, 0));
        if (stopped_.load(std::memory_order_relaxed)) return;
        const std::int32_t answer = [&] {
            CallbackScope scope;
            scope.clear_error();
            return call_host(callback_, user_data_, worker, n_rows, block.slots.data(),
                             block.offsets.data(), block.neighbours.data());
        }();
        if (answer == 0) return clear_error();
        stopped_ = true;
        const std::string said = last_error();
        throw Error(Status::callback, "the callback returned " + std::to_string(answer) +
                                          (said.empty() ? "" : ": " + said));
    }

    conn_rows_callback callback_;
    void* user_data_;
    IndexBase base_;
    std::vector<Block> block_;  // [n_workers]
    std::atomic<bool> stopped_{false};
};

}  // namespace

conn_status conn_map_traverse(conn_map* map, conn_nodes* const* lists, int32_t n_lists,
                              int32_t what, conn_rows_callback callback, void* user_data) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_map>(map, "map");
        work_on(ours, "traversal", [&] {
            const std::vector<NodeList> nodes = read_lists(lists, n_lists);
            if (what != CONN_ROWS && what != CONN_PAIRS)
                throw Error(Status::argument,
                            "what = " + std::to_string(what) + ", must be CONN_ROWS or CONN_PAIRS");
            if (callback == nullptr) throw Error(Status::null, "callback is NULL");
            const MapOptions options = options_of(ours, nodes);
            BlockCallback blocks(callback, user_data, ours.base);
            if (what == CONN_ROWS)
                ours.map->for_each_row(nodes, options, blocks);
            else
                ours.map->for_each_half_row(nodes, options, blocks);
            blocks.finish();
        });
    });
}
