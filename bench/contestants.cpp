// SPDX-License-Identifier: BSD-3-Clause
#include "contestants.hpp"

#include <algorithm>
#include <stdexcept>

#include <connectivity/base/runtime.hpp>
#include <connectivity/map/connectivity_map.hpp>

#include "host_step.hpp"
#include "pair_sums.hpp"
#include "peers/peer.hpp"

namespace connectivity::bench {
namespace {

SearchMethod method_of(const std::string& variant) {
    for (const SearchMethod method :
         {SearchMethod::brute, SearchMethod::cells, SearchMethod::groups, SearchMethod::device})
        if (variant == name_of(method)) return method;
    if (!variant.empty() && variant != "3lists" && variant != "tensor" && !is_feature(variant))
        throw std::invalid_argument("no variant named " + variant);
    return SearchMethod::automatic;
}

/// Asks for what a feature variant is about, beside rows and pairs.
void ask_for(const std::string& feature, MapOptions& options) {
    if (feature == "key") options.order = ListOrder::key;
    if (feature == "overlap") options.overlap = true;
    if (feature == "intersection") options.intersection = IntersectionKind::in_segment;
}

class Ours final : public Contestant {
public:
    Ours(const Input& input, Form form, const std::string& variant) {
        ask_for(variant, options_);
        options_.rows = form != Form::pairs;
        options_.pairs = form != Form::rows;
        options_.method = method_of(variant);
        const std::vector<double>& H = variant == "tensor" ? input.H : input.cloud.H;
        for (int state = 0; state <= input.n_moved(); ++state)
            states_.push_back(lists_of(input, state, variant == "3lists" ? 3 : 1, H));
    }

    void place(int state) override { state_ = static_cast<std::size_t>(state); }
    void build() override { map_.rebuild(states_[state_], options_); }
    Offset n_row_entries() const override { return options_.rows ? map_.rows().size() : 0; }
    Offset n_pairs() const override { return options_.pairs ? map_.pairs().size() : 0; }

    Offset result_bytes() const override {
        const auto bytes = [](const auto& offsets, Offset n_values) {
            return n_values * Offset{sizeof(Slot)} +
                   static_cast<Offset>(offsets.size() * sizeof(Offset));
        };
        return (options_.rows ? bytes(map_.rows().offsets, n_row_entries()) : 0) +
               (options_.pairs ? bytes(map_.pairs().view().offsets, n_pairs()) : 0);
    }

    bool agrees(Offset node, const std::vector<Offset>& neighbours) const override {
        const auto later = std::upper_bound(neighbours.begin(), neighbours.end(), node);
        bool same = true;
        if (options_.rows) {
            const auto found = map_.rows()[node];
            std::vector<Slot> row(found.begin(), found.end());
            if (options_.order == ListOrder::key) std::sort(row.begin(), row.end());
            same = std::equal(row.begin(), row.end(), neighbours.begin(), neighbours.end());
        }
        if (options_.pairs && options_.order == ListOrder::slot) {
            const auto pairs = map_.pairs().view();
            same =
                same && std::equal(pairs.data() + pairs.offsets(node),
                                   pairs.data() + pairs.offsets(node + 1), later, neighbours.end());
        }
        return same;
    }

    double check_ms() const override { return map_.report().find("nodes")->ms; }

private:
    /// The nodes come shuffled: equal parts in the order given are a random deal, and keep each
    /// node's slot.
    static std::vector<NodeList> lists_of(const Input& input, int state, int n_lists,
                                          const std::vector<double>& H) {
        const Cloud& c = input.cloud;
        const auto view = [](const double* values, Offset first, Offset n, Offset per_node) {
            return ConstView<double>(values + first * per_node,
                                     static_cast<std::size_t>(n * per_node));
        };
        std::vector<NodeList> lists;
        for (int k = 0; k < n_lists; ++k) {
            const Offset first = c.n * k / n_lists, n = c.n * (k + 1) / n_lists - first;
            const std::string name = c.name + std::to_string(k);
            const auto x = view(input.x(state), first, n, c.dim);
            lists.push_back(
                H.empty() ? NodeList::with_h(name, c.dim, n, x, view(c.R.data(), first, n, 1), 1)
                          : NodeList::with_H(name, c.dim, n, x,
                                             view(H.data(), first, n, n_symmetric(c.dim)), 1));
        }
        return lists;
    }

    std::vector<std::vector<NodeList>> states_;
    std::size_t state_ = 0;
    MapOptions options_;
    ConnectivityMap map_;
};

}  // namespace

bool is_feature(const std::string& variant) {
    return variant == "key" || variant == "overlap" || variant == "intersection";
}

Form form_of(const std::string& name) {
    if (name == "rows") return Form::rows;
    if (name == "pairs") return Form::pairs;
    if (name == "both") return Form::both;
    throw std::invalid_argument("no form named " + name);
}

Input make_input(const std::string& cloud, bool tensor) {
    constexpr int n_moved = 4;
    Input input;
    input.cloud = make_cloud(cloud);
    for (int k = 1; input.cloud.moves && k <= n_moved; ++k)
        input.moved.push_back(displaced(input.cloud, k));
    if (tensor) input.H = stretched(input.cloud);
    return input;
}

std::unique_ptr<Contestant> make_contestant(const std::string& who, const std::string& variant,
                                            const Input& input, Form form) {
    start_runtime();
    if (is_host_step(variant)) return make_host_step(input, variant);
    if (is_pair_sum(variant)) return make_pair_sums(input, variant);
    if (who == "ours") return std::make_unique<Ours>(input, form, variant);
    if (const Peer* const peer = peer_named(who)) return peer->make(input, form);
    throw std::invalid_argument("no contestant named " + who);
}

}  // namespace connectivity::bench
