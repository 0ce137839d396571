// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The double predicate as a vector kernel: decides as Significance does, bit for bit. Part of
/// kernels_impl.hpp, which says what V is.

#include "kernels.hpp"

namespace connectivity::detail {
namespace {

/// H of one node or of several, and the difference it is applied to.
template <class V, int Dim>
inline typename V::D eta2(const typename V::D (&h)[Dim * (Dim + 1) / 2],
                          const typename V::D (&r)[Dim]) {
    // Packed by rows of the upper triangle: where (row, column) stands.
    constexpr int at[3][3] = {{0, 1, 2}, {1, Dim == 2 ? 2 : 3, 4}, {2, 4, 5}};
    typename V::D sum{};
    for (int a = 0; a < Dim; ++a) {
        auto e = V::mul(h[at[a][0]], r[0]);
        for (int b = 1; b < Dim; ++b) e = V::add(e, V::mul(h[at[a][b]], r[b]));
        sum = a == 0 ? V::mul(e, e) : V::add(sum, V::mul(e, e));
    }
    return sum;
}

/// The double predicate of one node against several.
template <class V, int Dim>
struct Predicate {
    static constexpr int n_h = Dim * (Dim + 1) / 2;
    using D = typename V::D;

    const PredicateData<Dim>& nodes;
    D x[Dim], h[n_h], reach2, extent2;
    bool tensor;

    Predicate(const PredicateData<Dim>& data, long slot)
        : nodes(data),
          reach2(V::set_wide(data.reach2[slot])),
          extent2(V::set_wide(data.extent2)),
          tensor(data.H != nullptr && data.H[slot * n_h] != 0.0) {
        for (int d = 0; d < Dim; ++d) x[d] = V::set_wide(data.positions[slot * Dim + d]);
        for (int k = 0; k < n_h; ++k) h[k] = V::set_wide(tensor ? data.H[slot * n_h + k] : 0.0);
    }

    unsigned seen_by(const int* other, const D (&r)[Dim], D r2) const {
        D reach2_of[1];
        V::gather_rows(nodes.reach2, other, reach2_of);
        const unsigned in_ball = V::le(r2, reach2_of[0]);
        if (nodes.H == nullptr) return in_ball;
        D g[n_h];
        V::gather_rows(nodes.H, other, g);
        const unsigned scalar = V::equal(g[0], V::set_wide(0));
        return (in_ball & scalar) | (V::le(eta2<V, Dim>(g, r), extent2) & ~scalar);
    }

    /// Which of the next few others are neighbours.
    unsigned operator()(const int* other) const {
        D r[Dim];
        V::gather_rows(nodes.positions, other, r);
        for (int d = 0; d < Dim; ++d) {
            r[d] = V::sub(x[d], r[d]);
            if (nodes.period[d] > 0) {
                const D length = V::set_wide(nodes.period[d]);
                r[d] = V::sub(r[d], V::mul(length, V::nearest(V::div(r[d], length))));
            }
        }
        D r2 = V::mul(r[0], r[0]);
        for (int d = 1; d < Dim; ++d) r2 = V::add(r2, V::mul(r[d], r[d]));
        constexpr unsigned all = (1u << V::wide_lanes) - 1;
        unsigned found = 0;
        if (nodes.own) found = tensor ? V::le(eta2<V, Dim>(h, r), extent2) : V::le(r2, reach2);
        return nodes.others && found != all ? found | seen_by(other, r, r2) : found;
    }
};

template <class V, int Dim>
void confirm(const PredicateData<Dim>& nodes, int slot, const int* label, int words,
             std::uint64_t* bits) {
    const Predicate<V, Dim> sees(nodes, slot);
    int other[word_size + list_slack];
    for (int w = 0; w < words; ++w) {
        const int n = V::unpack(other, bits[w], label + w * word_size);
        for (int k = n; k < n + V::wide_lanes; ++k) other[k] = slot;
        std::uint64_t found = 0;
        for (int k = 0; k < n; k += V::wide_lanes)
            found |= static_cast<std::uint64_t>(sees(other + k)) << k;
        bits[w] = V::deposit(found, bits[w]);
    }
}

}  // namespace
}  // namespace connectivity::detail
