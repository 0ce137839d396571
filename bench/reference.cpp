// SPDX-License-Identifier: BSD-3-Clause
#include "reference.hpp"

#include <algorithm>

#include <connectivity/base/parallel.hpp>
#include <connectivity/base/runtime.hpp>

#include "peers/peer.hpp"

namespace connectivity::bench {
namespace {

struct Nodes {
    int dim;
    Offset n;
    const double *x, *R, *H;  ///< H is null where the radii count

    bool sees(Offset i, const double* r) const {
        double sum = 0;
        if (H == nullptr) {
            for (int d = 0; d < dim; ++d) sum += r[d] * r[d];
            return sum <= R[i] * R[i];
        }
        const double* const h = H + i * (dim == 3 ? 6 : 3);
        for (int a = 0; a < dim; ++a) {
            double component = 0;
            for (int b = 0; b < dim; ++b) component += h[packed(a, b)] * r[b];
            sum += component * component;
        }
        return sum <= 1;
    }

    bool are_neighbours(Offset i, Offset j) const {
        double r[3];
        for (int d = 0; d < dim; ++d) r[d] = x[i * dim + d] - x[j * dim + d];
        return sees(i, r) || sees(j, r);
    }

    int packed(int a, int b) const {
        const int low = std::min(a, b), high = std::max(a, b);
        return low * dim - low * (low - 1) / 2 + high - low;
    }
};

Nodes nodes_of(const Input& input, bool tensor, int state) {
    const Cloud& c = input.cloud;
    const std::vector<double>& H = tensor ? input.H : c.H;
    return {c.dim, c.n, input.x(state), c.R.data(), H.empty() ? nullptr : H.data()};
}

Offset brute_force_pairs(const Nodes& nodes) {
    std::vector<Offset> later(static_cast<std::size_t>(nodes.n), 0);
    for_each_dynamic("bench/brute_force", nodes.n, [&](int, Offset i) {
        Offset n = 0;
        for (Offset j = i + 1; j < nodes.n; ++j) n += nodes.are_neighbours(i, j) ? 1 : 0;
        later[static_cast<std::size_t>(i)] = n;
    });
    Offset n_pairs = 0;
    for (const Offset n : later) n_pairs += n;
    return n_pairs;
}

/// The first that can tell, or null.
const Peer* counting_peer(const std::string& cloud) {
    CaseName c;
    const std::size_t at = cloud.find('@');
    c.workload = cloud.substr(0, at), c.form = "pairs", c.threads = "2";
    if (at != std::string::npos) c.size = cloud.substr(at + 1);
    for (const Peer& peer : peers())
        if (peer.exact && peer.takes_part(c)) return &peer;
    return nullptr;
}

}  // namespace

std::vector<Offset> reference_pairs(const Input& input, bool tensor) {
    constexpr Offset few = 20000;
    start_runtime();
    const auto n_states = static_cast<std::size_t>(input.n_moved()) + 1;
    std::vector<Offset> n_pairs(n_states, -1);
    const Peer* const peer = tensor ? nullptr : counting_peer(input.cloud.name);
    if (input.cloud.n <= few) {
        for (int state = 0; state <= input.n_moved(); ++state)
            n_pairs[static_cast<std::size_t>(state)] =
                brute_force_pairs(nodes_of(input, tensor, state));
    } else if (peer != nullptr) {
        const auto counting = peer->make(input, Form::pairs);
        for (int state = 0; state <= input.n_moved(); ++state) {
            counting->place(state);
            counting->build();
            n_pairs[static_cast<std::size_t>(state)] = counting->n_pairs();
        }
    }
    return n_pairs;
}

std::vector<Offset> neighbours_of(const Input& input, bool tensor, int state, Offset node) {
    const Nodes nodes = nodes_of(input, tensor, state);
    std::vector<Offset> found;
    for (Offset j = 0; j < nodes.n; ++j)
        if (j != node && nodes.are_neighbours(node, j)) found.push_back(j);
    return found;
}

}  // namespace connectivity::bench
