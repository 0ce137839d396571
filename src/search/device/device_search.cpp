// SPDX-License-Identifier: BSD-3-Clause
#include "device_search.hpp"

#include <algorithm>

namespace connectivity::detail {

template <int Dim>
void DeviceSearch<Dim>::cut(const Offset* offsets, Offset n, std::vector<Range>& ranges) const {
    const Offset most = limit_ / Offset{sizeof(Slot)};
    ranges.clear();
    for (Offset first = 0; first < n;) {
        Offset last =
            std::upper_bound(offsets + first + 1, offsets + n + 1, offsets[first] + most) -
            offsets - 1;
        last = std::max(last, first + 1);
        ranges.push_back({first, last});
        first = last;
    }
}

template <int Dim>
template <class Body>
void DeviceSearch<Dim>::sweep_batch(const device::Problem<Dim>& problem, const GroupOrder& order,
                                    const Range& blocks, const Body& body) {
    candidates_.reserve(candidate_offsets_[blocks.last] - candidate_offsets_[blocks.first]);
    candidates_.fill(problem, near_, blocks.first, blocks.last);
    const Offset first = order.block_leaf[blocks.first], last = order.block_leaf[blocks.last];
    const Offset* const offsets = lists_.count(problem, candidates_, blocks.first, first, last);
    cut(offsets, last - first, parts_);
    for (const Range& part : parts_) {
        lists_.reserve(offsets[part.last] - offsets[part.first]);
        lists_.fill(problem, candidates_, blocks.first, first + part.first, first + part.last);
        body(first + part.first, first + part.last);
        ++n_parts_;
    }
}

template <int Dim>
template <class Body>
void DeviceSearch<Dim>::sweep(const device::Problem<Dim>& problem, const GroupOrder& order,
                              const Body& body) {
    n_parts_ = 0;
    cut(candidate_offsets_, problem.n_blocks, batches_);
    for (const Range& blocks : batches_) sweep_batch(problem, order, blocks, body);
}

template <int Dim>
void DeviceSearch<Dim>::run(const SearchNodes<Dim>& nodes, const GroupOrder& order,
                            const SlotLayout& layout, const SearchRequest& request,
                            Products products, Report& report) {
    const auto problem = nodes_.update(nodes, order, layout, request);
    near_.find(problem);
    candidate_offsets_ = candidates_.count(problem, near_);
    rows_.begin(problem, layout);
    sweep(problem, order,
          [&](Offset first, Offset last) { rows_.count(problem, lists_, first, last); });
    report.counter("candidates") = candidate_offsets_[problem.n_blocks];
    report.counter("blocks") = problem.n_blocks;
    report.counter("device_parts") = n_parts_;
    try {
        products.prepare(rows_.counts(), layout, request.budget);
        rows_.reserve(products);
    } catch (...) {
        products.abandon();
        throw;
    }
    const auto fill = [&](Offset first, Offset last) { rows_.fill(problem, lists_, first, last); };
    if (n_parts_ == 1)
        fill(0, problem.n_leaves);
    else
        sweep(problem, order, fill);
    rows_.finish(products);
    if (request.rows) products.rows.publish();
    if (request.half_rows) products.halves.publish();
}

template <int Dim>
Offset DeviceSearch<Dim>::bytes() const {
    return nodes_.bytes() + near_.bytes() + candidates_.bytes() + lists_.bytes() + rows_.bytes();
}

template class DeviceSearch<1>;
template class DeviceSearch<2>;
template class DeviceSearch<3>;

}  // namespace connectivity::detail
