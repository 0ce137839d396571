// SPDX-License-Identifier: BSD-3-Clause
/// cornerstone-octree: an octree over nodes in Hilbert order, one traversal a node, by OpenMP.
/// Double precision; gather only, which are rows where R is constant: full lists by nodes in
/// Hilbert order, numbered in that order, unsorted, each in a stretch as long as the longest;
/// counts beside them. The stretches grow when a list does not fit, and the build is repeated.
///
/// Positions are read in the order of the build before, so that they are nearly sorted; the sort
/// is its own, by one thread. Order, tree and memory are kept from build to build.

#include "peer.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include <cstone/findneighbors.hpp>
#include <cstone/primitives/gather.hpp>
#include <cstone/sfc/sfc.hpp>
#include <cstone/tree/csarray.hpp>
#include <cstone/tree/octree.hpp>

namespace connectivity::bench {
namespace {

using Key = std::uint64_t;
using Box = cstone::Box<double>;
constexpr unsigned bucket_size = 16;

class Cornerstone final : public PeerContestant {
public:
    Cornerstone(const Input& input, Form form) : PeerContestant(input, form, true) {
        const std::size_t size = input.cloud.R.size();
        order_.resize(size), keys_.resize(size), counts_.resize(size);
        std::iota(order_.begin(), order_.end(), cstone::LocalIndex{0});
        for (auto& axis : x_) axis.resize(size);
        leaves_ = {0, cstone::nodeRange<Key>(0)};
        leaf_counts_ = {static_cast<unsigned>(size)};
    }

    void build() override {
        const Box box = sort();
        update_tree(box);
        for (;; longest_ *= 2) {
            neighbors_.resize(keys_.size() * longest_);
            cstone::findNeighbors(x_[0].data(), x_[1].data(), x_[2].data(), R() / 2, 0,
                                  static_cast<cstone::LocalIndex>(n()), box, view(), longest_,
                                  neighbors_.data(), counts_.data());
            if (*std::max_element(counts_.begin(), counts_.end()) <= longest_) break;
        }
    }

    Offset result_bytes() const override {
        return static_cast<Offset>((neighbors_.size() + counts_.size()) * sizeof(unsigned));
    }

protected:
    Offset n_entries() const override {
        return std::accumulate(counts_.begin(), counts_.end(), Offset{0});
    }
    std::vector<Offset> partners(Offset node) const override {
        const auto self = static_cast<std::size_t>(
            std::find(order_.begin(), order_.end(), static_cast<unsigned>(node)) - order_.begin());
        std::vector<Offset> found;
        for (unsigned k = 0; k < counts_[self]; ++k)
            found.push_back(order_[neighbors_[self * longest_ + k]]);
        return found;
    }

private:
    void gather_positions() {
        const double* const from = xyz();
#pragma omp parallel for
        for (std::size_t k = 0; k < order_.size(); ++k)
            for (std::size_t d = 0; d < 3; ++d) x_[d][k] = from[3 * std::size_t{order_[k]} + d];
    }

    Box bounds() const {
        double low[3], high[3];
        for (int d = 0; d < 3; ++d) {
            const auto [first, last] = std::minmax_element(x_[d].begin(), x_[d].end());
            low[d] = *first - R(), high[d] = *last + R();
        }
        return {low[0], high[0], low[1], high[1], low[2], high[2]};
    }

    Box sort() {
        gather_positions();
        const Box box = bounds();
        cstone::computeSfcKeys(x_[0].data(), x_[1].data(), x_[2].data(),
                               cstone::sfcKindPointer(keys_.data()), keys_.size(), box);
        cstone::sort_by_key(keys_.begin(), keys_.end(), order_.begin());
        gather_positions();
        return box;
    }

    void update_tree(const Box& box) {
        while (!cstone::updateOctree<Key>(keys_, bucket_size, leaves_, leaf_counts_)) {
        }
        tree_.resize(static_cast<cstone::TreeNodeIndex>(cstone::nNodes(leaves_)));
        cstone::updateInternalTree<Key>(leaves_, tree_.data());
        layout_.assign(leaf_counts_.size() + 1, 0);
        std::inclusive_scan(leaf_counts_.begin(), leaf_counts_.end(), layout_.begin() + 1);
        const auto n_tree_nodes = static_cast<std::size_t>(tree_.numNodes);
        centers_.resize(n_tree_nodes), sizes_.resize(n_tree_nodes);
        cstone::nodeFpCenters<Key>({tree_.prefixes.data(), n_tree_nodes}, centers_.data(),
                                   sizes_.data(), box);
    }

    cstone::OctreeNsView<double, Key> view() const {
        return {tree_.numLeafNodes,
                tree_.numNodes,
                tree_.prefixes.data(),
                tree_.childOffsets.data(),
                tree_.parents.data(),
                tree_.internalToLeaf.data(),
                tree_.leafToInternal.data(),
                tree_.levelRange.data(),
                nullptr,
                layout_.data(),
                centers_.data(),
                sizes_.data()};
    }

    std::vector<cstone::LocalIndex> order_;  ///< caller's number of each sorted node
    std::vector<double> x_[3];
    std::vector<Key> keys_, leaves_;
    std::vector<unsigned> leaf_counts_, counts_;
    cstone::OctreeData<Key, cstone::execution::Cpu> tree_;
    std::vector<cstone::LocalIndex> layout_, neighbors_;
    std::vector<cstone::Vec3<double>> centers_, sizes_;
    unsigned longest_ = 128;
};

/// W5, with its far corners: 1e-5 of the pairs are missing, which would be an error here.
bool takes_part(const CaseName& c) {
    return has_constant_R(c) && c.workload != "W5" && c.form == "rows";
}

}  // namespace

std::vector<Peer> cornerstone_peers() {
    return {{"cornerstone", "double; full lists of fixed length in Hilbert order, unsorted", true,
             takes_part, [](const Input& input, Form form) -> std::unique_ptr<Contestant> {
                 return std::make_unique<Cornerstone>(input, form);
             }}};
}

}  // namespace connectivity::bench
