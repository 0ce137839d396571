// SPDX-License-Identifier: BSD-3-Clause
/// ArborX: a bounding volume hierarchy with one node a leaf. Single precision, its default, to
/// which the caller's positions are converted in every build; compressed rows, unsorted, in an
/// order that depends on the threads. Runs on the Kokkos of the benchmark, which has to be 4.5 or
/// later. Tree and result are allocated anew in every build: the interface has no other way.
///
/// Constant R: its full and half neighbour lists. Variable R: pairs only, by a query that gathers
/// within R of each node and keeps the pairs that the node with the larger (R, number) owns.

#include "peer.hpp"

#include <ArborX.hpp>
#include <detail/ArborX_NeighborList.hpp>

#include <connectivity/base/spaces.hpp>

namespace connectivity::bench {
namespace {

template <int Dim>
using Points = Kokkos::View<ArborX::Point<Dim, float>*, HostMemory>;

template <int Dim>
struct Balls {
    Points<Dim> x;
    const double* R;
};

struct KeepOwned {
    const double* R;

    template <class Predicate, class Value, class Output>
    void operator()(const Predicate& ball, const Value& other, const Output& output) const {
        const auto i = ArborX::getData(ball), j = static_cast<int>(other.index);
        if (R[j] < R[i] || (R[j] == R[i] && j < i)) output(j);
    }
};

}  // namespace
}  // namespace connectivity::bench

template <int Dim>
struct ArborX::AccessTraits<connectivity::bench::Balls<Dim>> {
    using memory_space = connectivity::HostMemory;
    using Balls = connectivity::bench::Balls<Dim>;
    static std::size_t size(const Balls& balls) { return balls.x.size(); }
    static auto get(const Balls& balls, std::size_t i) {
        return attach(intersects(Sphere{balls.x(i), static_cast<float>(balls.R[i])}),
                      static_cast<int>(i));
    }
};

namespace connectivity::bench {
namespace {

template <int Dim>
class ArborXPeer final : public PeerContestant {
public:
    ArborXPeer(const Input& input, Form form)
        : PeerContestant(input, form, false),
          points_("bench/arborx/points", input.cloud.R.size()) {}

    void build() override {
        convert();
        const HostExec space;
        if (!cloud().constant_R) {
            const ArborX::BoundingVolumeHierarchy tree(
                space, ArborX::Experimental::attach_indices<int>(points_));
            const double* const radii = cloud().R.data();
            tree.query(space, Balls<Dim>{points_, radii}, KeepOwned{radii}, values_, offsets_);
        } else if (rows()) {
            ArborX::Experimental::findFullNeighborList(space, points_, static_cast<float>(R()),
                                                       offsets_, values_);
        } else {
            ArborX::Experimental::findHalfNeighborList(space, points_, static_cast<float>(R()),
                                                       offsets_, values_);
        }
        space.fence();
    }

    Offset result_bytes() const override {
        return static_cast<Offset>((values_.size() + offsets_.size()) * sizeof(int));
    }

protected:
    Offset n_entries() const override { return static_cast<Offset>(values_.size()); }
    std::vector<Offset> partners(Offset node) const override {
        return partners_in(offsets_.data(), values_.data(), n(), node, !rows());
    }

private:
    void convert() {
        const double* const from = x();
        const auto to = points_;
        Kokkos::parallel_for("bench/arborx/convert", Kokkos::RangePolicy<HostExec>(0, n()),
                             [=](const Offset i) {
                                 for (int d = 0; d < Dim; ++d)
                                     to(i)[d] = static_cast<float>(from[i * Dim + d]);
                             });
    }

    Points<Dim> points_;
    Kokkos::View<int*, HostMemory> offsets_{"bench/arborx/offsets", 0};
    Kokkos::View<int*, HostMemory> values_{"bench/arborx/values", 0};
};

/// Hard scenes are beyond single precision. Rows of W3 and W7: full lists have one R for all.
bool takes_part(const CaseName& c) {
    return c.workload[0] == 'W' && (c.form == "pairs" || (c.form == "rows" && has_constant_R(c)));
}

std::unique_ptr<Contestant> make(const Input& input, Form form) {
    if (input.cloud.dim == 2) return std::make_unique<ArborXPeer<2>>(input, form);
    return std::make_unique<ArborXPeer<3>>(input, form);
}

}  // namespace

std::vector<Peer> arborx_peers() {
    return {{"arborx", "float; compressed full or half rows, unsorted", false, takes_part, make}};
}

}  // namespace connectivity::bench
