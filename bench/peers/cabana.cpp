// SPDX-License-Identifier: BSD-3-Clause
/// Cabana: a Verlet list from cells of the size of R. Double precision; compressed rows, full or
/// half, unsorted. Runs on the Kokkos of the benchmark, which has to be 4.1 or later. The list is
/// allocated anew in every build. Of its layouts the compressed one, of its loops one team a cell.

#include "peer.hpp"

#include <algorithm>

#include <Cabana_Core.hpp>

#include <connectivity/base/spaces.hpp>

namespace connectivity::bench {
namespace {

template <class Tag, int Dim>
class CabanaPeer final : public PeerContestant {
public:
    CabanaPeer(const Input& input, Form form) : PeerContestant(input, form, true) {}

    void build() override {
        using Positions =
            Kokkos::View<double* [Dim], Kokkos::LayoutRight, HostMemory, Kokkos::MemoryUnmanaged>;
        const auto n_nodes = static_cast<std::size_t>(n());
        double low[Dim], high[Dim];
        bounds(low, high);
        // It only reads them, but does not compile for constants.
        list_.build(HostExec(), Positions(const_cast<double*>(x()), n_nodes), 0, n_nodes, R(), 1.0,
                    low, high);
    }

    Offset result_bytes() const override { return (n_entries() + 2 * n()) * Offset{sizeof(int)}; }

protected:
    Offset n_entries() const override { return static_cast<Offset>(list_._data.neighbors.size()); }
    std::vector<Offset> partners(Offset node) const override {
        const auto& rows = list_._data;
        std::vector<Offset> found;
        for (Offset i = this->rows() ? node : 0; i < (this->rows() ? node + 1 : n()); ++i)
            for (int k = 0; k < rows.counts(i); ++k) {
                const Offset j = rows.neighbors(rows.offsets(i) + k);
                if (i == node || j == node) found.push_back(i == node ? j : i);
            }
        return found;
    }

private:
    /// Of the grid of cells, which the caller has to tell; less than a cell wide, it fails.
    void bounds(double (&low)[Dim], double (&high)[Dim]) const {
        const double* const from = x();
        for (int d = 0; d < Dim; ++d) {
            Kokkos::MinMaxScalar<double> range;
            Kokkos::parallel_reduce(
                "bench/cabana/bounds", Kokkos::RangePolicy<HostExec>(0, n()),
                [=](const Offset i, Kokkos::MinMaxScalar<double>& r) {
                    r.min_val = std::min(r.min_val, from[Dim * i + d]);
                    r.max_val = std::max(r.max_val, from[Dim * i + d]);
                },
                Kokkos::MinMax<double>(range));
            low[d] = range.min_val - R() / 2, high[d] = range.max_val + R() / 2;
        }
    }

    Cabana::VerletList<HostMemory, Tag, Cabana::VerletLayoutCSR, Cabana::TeamOpTag, Dim> list_;
};

/// W5 needs 7e13 cells, which it does not notice. Rows of variable R are wrong in this layout, and
/// the others want the longest row times the number of nodes.
bool takes_part(const CaseName& c) {
    return has_constant_R(c) && c.workload != "W5" && c.form != "both";
}

template <class Tag>
std::unique_ptr<Contestant> make(const Input& input, Form form) {
    if (input.cloud.dim == 2) return std::make_unique<CabanaPeer<Tag, 2>>(input, form);
    return std::make_unique<CabanaPeer<Tag, 3>>(input, form);
}

std::unique_ptr<Contestant> make(const Input& input, Form form) {
    return form == Form::rows ? make<Cabana::FullNeighborTag>(input, form)
                              : make<Cabana::HalfNeighborTag>(input, form);
}

}  // namespace

std::vector<Peer> cabana_peers() {
    return {{"cabana", "double; compressed full or half rows, unsorted", true, takes_part, make}};
}

}  // namespace connectivity::bench
