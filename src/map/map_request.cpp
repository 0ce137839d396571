// SPDX-License-Identifier: BSD-3-Clause
#include "map_impl.hpp"

namespace connectivity {

Offset check_lists(const std::string& call, std::span<const NodeList> lists) {
    if (lists.empty()) throw Error(Status::argument, call + ": 0 node lists, must be at least 1");
    Offset n = 0;
    for (std::size_t l = 0; l < lists.size(); ++l) {
        if (lists[l].dim() != lists[0].dim())
            throw Error(Status::argument,
                        call + ": node list " + std::to_string(l) + " (\"" + lists[l].name() +
                            "\") has dim = " + std::to_string(lists[l].dim()) +
                            ", the first list has " + std::to_string(lists[0].dim()));
        n += lists[l].n();
    }
    if (n > max_slots)
        throw Error(Status::too_many, call + ": " + std::to_string(n) + " nodes, must be at most " +
                                          std::to_string(max_slots));
    return n;
}

namespace {

void check_combination(const std::string& call, const MapOptions& options) {
    const bool intersects = options.intersection != IntersectionKind::none;
    if (options.mode != SearchMode::gather_scatter && options.pairs)
        throw Error(Status::argument,
                    call + ": pairs exist only for gather_scatter; ask for rows alone");
    if (options.mode != SearchMode::gather_scatter && (options.overlap || intersects))
        throw Error(Status::argument,
                    call + ": overlap and intersections exist only for gather_scatter");
    if (options.exclude != nullptr && !*options.exclude)
        throw Error(Status::argument, call + ": the predicate of exclude is empty");
    const auto in_range = [&](const char* name, auto value, auto last) {
        if (static_cast<int>(value) < 0 || value > last)
            throw Error(Status::argument, call + ": " + name + " = " +
                                              std::to_string(static_cast<int>(value)) +
                                              ", must be one of its enumerators");
    };
    in_range("mode", options.mode, SearchMode::gather_scatter);
    in_range("method", options.method, SearchMethod::device);
    in_range("order", options.order, ListOrder::key);
    in_range("intersection", options.intersection, IntersectionKind::in_segment);
    if (options.active.size() > 0 && (options.overlap || intersects))
        throw Error(Status::argument, call + ": overlap and intersections need all nodes active");
}

void check_interactions(const std::string& call, const std::vector<std::uint8_t>& sees,
                        std::size_t n_lists) {
    if (sees.empty()) return;
    if (sees.size() != n_lists * n_lists)
        throw Error(Status::argument, call + ": interactions has " + std::to_string(sees.size()) +
                                          " entries, must be n_lists * n_lists = " +
                                          std::to_string(n_lists * n_lists));
    for (std::size_t a = 0; a < n_lists; ++a)
        for (std::size_t b = 0; b < n_lists; ++b) {
            const auto name = call + ": interactions[" + std::to_string(a) + "][" +
                              std::to_string(b) + "] = " + std::to_string(sees[a * n_lists + b]);
            if (sees[a * n_lists + b] > 1) throw Error(Status::argument, name + ", must be 0 or 1");
            if (sees[a * n_lists + b] != sees[b * n_lists + a])
                throw Error(Status::argument, name + " but the other way round it is " +
                                                  std::to_string(sees[b * n_lists + a]) +
                                                  ", must be symmetric");
        }
}

void check_active(const std::string& call, const ConstView<std::uint8_t>& active, Offset n) {
    if (active.size() == 0) return;
    if (static_cast<Offset>(active.size()) != n)
        throw Error(Status::argument, call + ": active has " + std::to_string(active.size()) +
                                          " values, must be " + std::to_string(n) +
                                          ", one for each node");
    for (Offset k = 0; k < n; ++k)
        if (active(k) > 1)
            throw Error(Status::argument, call + ": active[" + std::to_string(k) + "] = " +
                                              std::to_string(active(k)) + ", must be 0 or 1");
}

}  // namespace

void check_request(const std::string& call, std::span<const NodeList> lists,
                   const MapOptions& options) {
    const Offset n = check_lists(call, lists);
    check_combination(call, options);
    check_interactions(call, options.interactions, lists.size());
    check_active(call, options.active, n);
    if (options.budget.bytes < 0)
        throw Error(Status::argument, call + ": budget of " + std::to_string(options.budget.bytes) +
                                          " bytes, must be >= 0");
    if (options.skin != 0 && !(options.skin >= 1e-100 && options.skin <= 1e100))
        throw Error(Status::argument, call + ": skin = " + number(options.skin) +
                                          ", must be 0 or in [1e-100, 1e100]");
    options.domain.check(lists[0].dim());
}

SlotLayout layout_of(std::span<const NodeList> lists, const MapOptions& options) {
    std::vector<ListSize> sizes;
    for (const NodeList& list : lists) sizes.push_back({list.n(), list.n_internal()});
    View<std::uint8_t> active;
    if (options.active.size() > 0) {
        active = allocate<std::uint8_t>("map/active", static_cast<Offset>(options.active.size()));
        Kokkos::deep_copy(active, options.active);
    }
    return SlotLayout(sizes, options.stores_all_rows(), active);
}

}  // namespace connectivity
