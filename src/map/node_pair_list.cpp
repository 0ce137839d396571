// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/node_pair_list.hpp>

#include <atomic>

namespace connectivity {
namespace {

Stamp new_stamp() noexcept {
    static std::atomic<Stamp> last{0};
    return ++last;
}

}  // namespace

Offset NodePairList::bytes() const {
    return half_rows_.bytes() + static_cast<Offset>(first_.size() * sizeof(Slot)) +
           coupling_.bytes();
}

NodePairList::View<> NodePairList::view() const {
    return {half_rows_.offsets(),
            half_rows_.values(),
            {},
            generation_,
            stamp_,
            coupling_.values(),
            slots_,
            ranks_};
}

void NodePairList::set_coupling(NodeCoupling f) {
    require_built("set_coupling");
    coupling_.set({half_rows_.offsets(), half_rows_.values(), slots_}, f);
}

void NodePairList::set_coupling(std::span<const double> values) {
    require_built("set_coupling");
    if (std::ssize(values) != size())
        throw Error(Status::argument, "set_coupling: " + std::to_string(values.size()) +
                                          " values, must be " + std::to_string(size()) +
                                          " as in the pair list");
    coupling_.set({half_rows_.offsets(), half_rows_.values(), slots_}, values);
}

void NodePairList::set_coupling(Offset k, double value) {
    require_built("set_coupling");
    coupling_.set({half_rows_.offsets(), half_rows_.values(), slots_}, k, value);
}

void NodePairList::start_generation(Generation generation, bool built) noexcept {
    generation_ = generation;
    stamp_ = built ? new_stamp() : 0;
    built ? coupling_.drop() : coupling_.clear();
}

void NodePairList::continue_generation(Generation generation) noexcept {
    generation_ = generation;
    stamp_ = new_stamp();
    coupling_.commit_remap();
}

void NodePairList::require_built(const char* call) const {
    if (stamp_ == 0)
        throw Error(Status::not_built,
                    std::string(call) + ": the last rebuild was not asked for pairs");
}

NodePairList::View<> NodePairList::expanded_view() {
    View<> expanded = view();
    if (first_generation_ != generation_) {
        ensure_capacity(first_, "map/pairs/i", size());
        const auto offsets = expanded.offsets;
        const auto first = first_;
        Kokkos::parallel_for(
            "map/pairs/expand",
            Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, half_rows_.n_rows()),
            [=](const Offset i) {
                for (Offset k = offsets(i); k < offsets(i + 1); ++k) first(k) = expanded.node(i);
            });
        HostExec().fence();
        first_generation_ = generation_;
    }
    expanded.i = Kokkos::subview(first_, std::pair<Offset, Offset>(0, size()));
    return expanded;
}

}  // namespace connectivity
