// SPDX-License-Identifier: BSD-3-Clause
// Sums of pair fields at the nodes: the loops of map/pair_sum.hpp for a number of components that
// is known at run time only.

#include <algorithm>

#include "arguments.hpp"
#include "guard.hpp"
#include "map_work.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

using Loop =
    Kokkos::RangePolicy<HostExec, Kokkos::Schedule<Kokkos::Dynamic>, Kokkos::IndexType<Offset>>;

/// What pairs add to their two ends.
struct Contributions {
    const double* values;
    int n;            ///< components at a node
    int per_pair;     ///< values of a pair: n, or 2 n
    int second = 0;   ///< first value for the second node
    double sign = 1;  ///< of the second node
};

Contributions read_contributions(const PairValues& field, std::int32_t symmetry) {
    const int n = field.n_components();
    switch (symmetry) {
        case CONN_ANTISYMMETRIC: return {field.data(), n, n, 0, -1};
        case CONN_SYMMETRIC: return {field.data(), n, n, 0, 1};
        case CONN_TWO_SIDED:
            if (n % 2 == 0) return {field.data(), n / 2, n, n / 2, 1};
            throw Error(Status::argument, "field has n_components = " + std::to_string(n) +
                                              ", must be even for CONN_TWO_SIDED");
        default:
            throw Error(Status::argument,
                        "symmetry = " + std::to_string(symmetry) +
                            ", must be CONN_ANTISYMMETRIC, CONN_SYMMETRIC or CONN_TWO_SIDED");
    }
}

/// The sum of one node, along its row.
struct AddRow {
    RowPairs::View<> of;
    Contributions pairs;
    double* out;

    void operator()(const Offset row) const {
        const Slot node = of.slot(row), half = of.pairs.half_row(node);
        const Offset end = of.rows.offsets((row + 1) * of.rows.n_lists);
        double* const sum = out + Offset{node} * pairs.n;
        for (Offset e = of.rows.offsets(row * of.rows.n_lists); e < end; ++e) {
            const bool is_first = half < of.pairs.half_row(of.rows.slots(e));
            const double* const v =
                pairs.values + of[e] * pairs.per_pair + (is_first ? 0 : pairs.second);
            const double sign = is_first ? 1 : pairs.sign;
            for (int c = 0; c < pairs.n; ++c) sum[c] += sign * v[c];
        }
    }
};

/// What the pairs of one half row add to both ends.
struct AddHalfRow {
    NodePairList::View<> list;
    Contributions pairs;
    double* out;

    void operator()(const Offset row) const {
        const Offset begin = list.offsets(row), end = list.offsets(row + 1);
        if (begin == end) return;
        double sum[PairValues::max_components];
        std::fill_n(sum, pairs.n, 0.0);
        for (Offset k = begin; k < end; ++k) {
            const double* const v = pairs.values + k * pairs.per_pair;
            double* const j = out + Offset{list.j(k)} * pairs.n;
            for (int c = 0; c < pairs.n; ++c) {
                sum[c] += v[c];
                Kokkos::atomic_add(j + c, pairs.sign * v[pairs.second + c]);
            }
        }
        double* const i = out + Offset{list.node(row)} * pairs.n;
        for (int c = 0; c < pairs.n; ++c) Kokkos::atomic_add(i + c, sum[c]);
    }
};

/// The pair of every row entry, made once a generation. Throws Error{not_built}, Error{memory}.
RowPairs::View<> row_pairs_of(conn_map& map) {
    if (!map.row_pairs.is_current(*map.map)) map.row_pairs.rebuild(*map.map);
    return map.row_pairs.view(*map.map);
}

void add_rows(const RowPairs::View<>& of, const Contributions& pairs, double* out) {
    Kokkos::parallel_for("capi/pair_sum/rows", Loop(0, of.rows.n_rows(), Kokkos::ChunkSize(64)),
                         AddRow{of, pairs, out});
    HostExec().fence();
}

void add_half_rows(const NodePairList::View<>& list, const Contributions& pairs, double* out) {
    Kokkos::parallel_for("capi/pair_sum/atomic", Loop(0, list.n_slots(), Kokkos::ChunkSize(64)),
                         AddHalfRow{list, pairs, out});
    HostExec().fence();
}

}  // namespace

conn_status conn_pair_field_sum(const conn_pair_field* field, conn_map* map, int32_t symmetry,
                                int32_t how, double* out, int64_t capacity) {
    return guarded_with_runtime(__func__, [&] {
        const auto& values = Registry::instance().get<const conn_pair_field>(field, "field").values;
        auto& ours = Registry::instance().get<conn_map>(map, "map");
        const NodePairList& list = ours.map->pairs();
        values.require_current(list);
        const Contributions pairs = read_contributions(values, symmetry);
        if (how != CONN_SUM_DETERMINISTIC && how != CONN_SUM_ATOMIC)
            throw Error(Status::argument,
                        "how = " + std::to_string(how) +
                            ", must be CONN_SUM_DETERMINISTIC or CONN_SUM_ATOMIC");
        const Offset n_values = ours.map->layout().n_slots() * pairs.n;
        check_capacity(capacity, n_values);
        if (n_values > 0) required(out, "out");
        RowPairs::View<> rows;
        if (how == CONN_SUM_DETERMINISTIC) rows = row_pairs_of(ours), note_memory(ours);
        detail::fill_pairs(out, n_values, 0.0);
        if (how == CONN_SUM_DETERMINISTIC)
            add_rows(rows, pairs, out);
        else
            add_half_rows(list.view(), pairs, out);
    });
}
