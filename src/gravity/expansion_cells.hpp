// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Operators between expansions: M2M, M2L, L2L, each along the axis z of a turned frame, O(P³).
///
/// Along z, with t = |d| / s and ratio = s' / s:
///     M2M  M'_nm = sum_k t^k / k! ratio^(n-k) M_n-k,m
///     M2L  F_nm = (-1)^(n+m) (s_A/R)^n / R sum_k<=P-n (n+k)! (s_B/R)^k M_km; only m <= P/2 count
///     L2L  F'_nm = ratio^n sum_k t^k / k! F_n+k,m

#include "expansion_lanes.hpp"
#include "expansion_turn.hpp"

namespace connectivity::detail {
namespace {

/// A vector of cells: where they are from a centre. Lanes without a cell repeat the first with
/// weight 0; others have weight 1.
template <class V>
struct Lanes {
    using D = typename V::D;
    int some;
    std::int32_t id[V::lanes];
    D r[3], scale, weight;

    Lanes(const CellArrays& cells, const CellList& list, std::int64_t first, const double* centre) {
        some = left<V>(list.n, first);
        const double* const position[3] = {cells.x, cells.y, cells.z};
        for (int k = 0; k < V::lanes; ++k) id[k] = list.id[first + (k < some ? k : 0)];
        for (int a = 0; a < 3; ++a) r[a] = V::sub(V::gather(position[a], id), V::set(centre[a]));
        if (list.image != nullptr) {
            std::int32_t at[V::lanes];
            for (int k = 0; k < V::lanes; ++k) at[k] = 3 * list.image[first + (k < some ? k : 0)];
            for (int a = 0; a < 3; ++a) r[a] = V::add(r[a], V::gather(list.shift + a, at));
        }
        scale = V::gather(cells.scale, id);
        weight = first_lanes<V>(some, V::set(1), V::set(0));
    }

    void gather(const CellArrays& cells, int n, D* out) const {
        const double* row[V::lanes];
        for (int k = 0; k < V::lanes; ++k) row[k] = cells.coefficients + id[k] * cells.stride;
        gather_rows<V>(row, n, out);
    }
    /// The direction from the cells to the centre.
    void turn_round() {
        for (D& x : r) x = V::sub(V::set(0), x);
    }
};

template <class V>
using Coefficients = typename V::D[n_coefficients(max_expansion_order) + 8];

/// power[n] = first * base^n
template <class V>
inline void powers(int order, typename V::D first, typename V::D base, typename V::D* power) {
    power[0] = first;
    for (int n = 1; n <= order; ++n) power[n] = V::mul(power[n - 1], base);
}

/// t^n / n!
template <class V>
inline void shift_powers(int order, typename V::D t, typename V::D* power) {
    power[0] = V::set(1);
    for (int n = 1; n <= order; ++n) power[n] = V::mul(power[n - 1], V::mul(t, V::set(1.0 / n)));
}

/// sum_k power_k in_n-k,m or, of locals, sum_k power_k in_n+k,m, for all n and m.
template <class V, bool Local>
inline void shift_along_z(int order, const typename V::D* power, const typename V::D* in,
                          typename V::D* out) {
    for (int n = 0; n <= order; ++n)
        for (int j = 0; j < 2 * n + 1; ++j) {  // (j + 1) / 2 is m
            const int last = Local ? order - n : n - (j + 1) / 2;
            auto sum = V::set(0);
            for (int k = 0; k <= last; ++k) {
                const int from = Local ? n + k : n - k;
                sum = V::fma(power[k], in[from * from + j], sum);
            }
            out[n * n + j] = sum;
        }
}

template <class V>
void m2m(int order, const CellArrays& cells, const CellList& children, const Expansion& parent) {
    using D = typename V::D;
    const int n = n_coefficients(order);
    Coefficients<V> in, turned, sums;
    for (int k = 0; k < n; ++k) sums[k] = V::set(0);
    for (std::int64_t first = 0; first < children.n; first += V::lanes) {
        const Lanes<V> lanes(cells, children, first, parent.centre);
        lanes.gather(cells, n, in);
        Frame<V> frame;
        frame.set(order, lanes.r);
        const D unit = V::set(1 / parent.scale);
        const D r2 = V::fma(lanes.r[0], lanes.r[0],
                            V::fma(lanes.r[1], lanes.r[1], V::mul(lanes.r[2], lanes.r[2])));
        D ratio[max_expansion_order + 1], power[max_expansion_order + 1];
        powers<V>(order, lanes.weight, V::mul(lanes.scale, unit), ratio);
        shift_powers<V>(order, V::mul(V::mul(r2, frame.inverse), unit), power);
        for (int k = 0; k <= order; ++k) {
            turn_to_axis<V>(k, swaps.moments, frame, k, in + k * k, turned + k * k);
            for (int j = 0; j < 2 * k + 1; ++j)
                turned[k * k + j] = V::mul(turned[k * k + j], ratio[k]);
        }
        shift_along_z<V, false>(order, power, turned, in);
        for (int k = 0; k <= order; ++k) {
            turn_from_axis<V>(k, swaps.moments, frame, k, in + k * k, turned);
            for (int j = 0; j < 2 * k + 1; ++j)
                sums[k * k + j] = V::add(sums[k * k + j], turned[j]);
        }
    }
    add_sums<V>(sums, n, parent.coefficients);
}

template <class V>
void l2l(int order, const Expansion& parent, const CellArrays& cells, const CellList& children,
         double* locals) {
    using D = typename V::D;
    const int n = n_coefficients(order);
    Coefficients<V> in, turned;
    for (std::int64_t first = 0; first < children.n; first += V::lanes) {
        const Lanes<V> lanes(cells, children, first, parent.centre);
        for (int k = 0; k < n; ++k) in[k] = V::set(parent.coefficients[k]);
        Frame<V> frame;
        frame.set(order, lanes.r);
        const D unit = V::set(1 / parent.scale);
        const D r2 = V::fma(lanes.r[0], lanes.r[0],
                            V::fma(lanes.r[1], lanes.r[1], V::mul(lanes.r[2], lanes.r[2])));
        D ratio[max_expansion_order + 1], power[max_expansion_order + 1];
        powers<V>(order, lanes.weight, V::mul(lanes.scale, unit), ratio);
        shift_powers<V>(order, V::mul(V::mul(r2, frame.inverse), unit), power);
        for (int k = 0; k <= order; ++k)
            turn_to_axis<V>(k, swaps.locals, frame, k, in + k * k, turned + k * k);
        shift_along_z<V, true>(order, power, turned, in);
        for (int k = 0; k <= order; ++k) {
            turn_from_axis<V>(k, swaps.locals, frame, k, in + k * k, turned + k * k);
            for (int j = 0; j < 2 * k + 1; ++j)
                turned[k * k + j] = V::mul(turned[k * k + j], ratio[k]);
        }
        double* row[V::lanes];
        for (int k = 0; k < V::lanes; ++k) row[k] = locals + lanes.id[k] * cells.stride;
        scatter_rows<V>(turned, lanes.some, n, row);
    }
}

inline int least(int a, int b) { return a < b ? a : b; }

/// The middle of M2L, in the turned frame: (k, m) of `in` is multiplied by source[k], (n, m) of
/// `out` by target[n].
template <class V>
inline void m2l_along_z(int order, const typename V::D* source, const typename V::D* target,
                        const typename V::D* in, typename V::D* out) {
    using D = typename V::D;
    for (int m = 0; 2 * m <= order; ++m)
        for (int part = m > 0 ? -1 : 0; part <= 0; ++part) {
            const int at = 2 * m + part;
            D scaled[max_expansion_order + 1];
            for (int k = m; k <= order - m; ++k) scaled[k] = V::mul(in[k * k + at], source[k]);
            for (int n = m; n <= order - m; ++n) {
                D sum = V::set(0);
                for (int k = m; k <= order - n; ++k)
                    sum = V::fma(V::set(factorial.value[n + k]), scaled[k], sum);
                sum = V::mul(sum, target[n]);
                out[n * n + at] = (n + m) % 2 == 0 ? sum : V::sub(V::set(0), sum);
            }
        }
}

template <class V>
void m2l(int order, const CellArrays& cells, const CellList& sources, const Expansion& target) {
    using D = typename V::D;
    const int n = n_coefficients(order);
    Coefficients<V> in, turned, sums;
    for (int k = 0; k < n; ++k) sums[k] = V::set(0);
    for (std::int64_t first = 0; first < sources.n; first += V::lanes) {
        Lanes<V> lanes(cells, sources, first, target.centre);
        lanes.turn_round();
        lanes.gather(cells, n, in);
        Frame<V> frame;
        frame.set(order, lanes.r);
        D from[max_expansion_order + 1], to[max_expansion_order + 1];
        powers<V>(order, lanes.weight, V::mul(lanes.scale, frame.inverse), from);
        powers<V>(order, frame.inverse, V::mul(V::set(target.scale), frame.inverse), to);
        for (int k = 0; k <= order; ++k)
            turn_to_axis<V>(k, swaps.moments, frame, least(k, order - k), in + k * k,
                            turned + k * k);
        m2l_along_z<V>(order, from, to, turned, in);
        for (int k = 0; k <= order; ++k) {
            turn_from_axis<V>(k, swaps.locals, frame, least(k, order - k), in + k * k, turned);
            for (int j = 0; j < 2 * k + 1; ++j)
                sums[k * k + j] = V::add(sums[k * k + j], turned[j]);
        }
    }
    add_sums<V>(sums, n, target.coefficients);
}

}  // namespace
}  // namespace connectivity::detail
