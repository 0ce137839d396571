// SPDX-License-Identifier: BSD-3-Clause
/// TreeNSearch: an octree over a grid, its leaves searched by AVX2. Single precision; full lists by
/// node, unsorted, a length and its neighbours each in chunks of the threads; no rows, no pairs.
///
/// Two contestants. `treensearch` is given what all are given: shuffled positions in double
/// precision. `treensearch_warm` is its best case, a host that has sorted its particles by
/// TreeNSearch's own order and holds them in single precision: sorting, numbers of the caller and
/// conversion are not timed. Both keep their object, and with it its chunks and the last cells.
/// Threads of its own, as many as Kokkos has.

#include "peer.hpp"

#include <TreeNSearch.h>

#include <connectivity/base/parallel.hpp>

namespace connectivity::bench {
namespace {

class TreeNSearch : public PeerContestant {
public:
    TreeNSearch(const Input& input, Form form) : PeerContestant(input, form, false) {
        search_.set_n_threads(n_workers());
        search_.set_search_radius(R());
        search_.add_point_set(xyz(), static_cast<int>(n()));
        search_.set_active_search(0, 0);
    }

    void place(int state) override {
        PeerContestant::place(state);
        search_.resize_point_set(0, xyz(), static_cast<int>(n()));
    }
    void build() override { search_.run(); }
    Offset result_bytes() const override {
        return (n_entries() + n()) * Offset{sizeof(int)} + n() * Offset{sizeof(int*)};
    }

protected:
    Offset n_entries() const override {
        Offset sum = 0;
        for (int i = 0; i < static_cast<int>(n()); ++i) sum += list(i).size();
        return sum;
    }
    std::vector<Offset> partners(Offset node) const override {
        const tns::NeighborList found = list(static_cast<int>(node));
        return {found.get_ptr(), found.get_ptr() + found.size()};
    }

    tns::NeighborList list(int i) const { return search_.get_neighborlist(0, 0, i); }

    tns::TreeNSearch search_;
};

class Warm final : public TreeNSearch {
public:
    Warm(const Input& input, Form form) : TreeNSearch(input, form) {
        search_.run();
        search_.prepare_zsort();
        order_ = search_.get_zsort_order(0);
        place_of_.resize(order_.size());
        for (std::size_t k = 0; k < order_.size(); ++k)
            place_of_[static_cast<std::size_t>(order_[k])] = static_cast<int>(k);
        sorted_.resize(3 * order_.size());
        Warm::place(0);
    }

    void place(int state) override {
        PeerContestant::place(state);
        for (std::size_t k = 0; k < order_.size(); ++k)
            for (std::size_t d = 0; d < 3; ++d)
                sorted_[3 * k + d] =
                    static_cast<float>(xyz()[3 * static_cast<std::size_t>(order_[k]) + d]);
        search_.resize_point_set(0, sorted_.data(), static_cast<int>(n()));
    }

protected:
    std::vector<Offset> partners(Offset node) const override {
        std::vector<Offset> found =
            TreeNSearch::partners(place_of_[static_cast<std::size_t>(node)]);
        for (Offset& j : found) j = order_[static_cast<std::size_t>(j)];
        return found;
    }

private:
    std::vector<int> order_, place_of_;
    std::vector<float> sorted_;
};

/// W3 and W7 take it minutes: its cells have the smallest radius, its leaves reach for the largest.
bool takes_part(const CaseName& c) { return has_constant_R(c) && c.form == "rows"; }
bool warm_takes_part(const CaseName& c) { return takes_part(c) && !c.first; }

}  // namespace

std::vector<Peer> treensearch_peers() {
    return {
        {"treensearch", "float; full lists, unsorted", false, takes_part,
         [](const Input& input, Form form) -> std::unique_ptr<Contestant> {
             return std::make_unique<TreeNSearch>(input, form);
         }},
        {"treensearch_warm",
         "float; full lists, unsorted, of float positions sorted by its own order before", false,
         warm_takes_part, [](const Input& input, Form form) -> std::unique_ptr<Contestant> {
             return std::make_unique<Warm>(input, form);
         }}};
}

}  // namespace connectivity::bench
