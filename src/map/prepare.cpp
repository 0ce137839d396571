// SPDX-License-Identifier: BSD-3-Clause
#include "prepare.hpp"

#include <array>
#include <string>

#include "append.hpp"
#include "support.hpp"

namespace connectivity {

namespace {

/// One list, as the checking pass reads it.
template <int Dim>
struct ListReader {
    const double* positions;
    const double* h;  // nullptr for tensors
    const double* H;  // nullptr for scalars
    double extent;    // maximum over all lists
    double skin;
    double* widened;  // where tensors with the skin around them go; nullptr without skin
    std::array<double, Dim> half_length;  // of periodic axes, infinity elsewhere
    HalfWidths widths;                    // whether there are periodic axes

    /// First fault of a node, and its squared reach if there is none.
    Fault examine(Offset node, double& reach2) const {
        for (int d = 0; d < Dim; ++d)
            if (!std::isfinite(positions[node * Dim + d])) return Fault::position;
        return h != nullptr ? examine_scalar(h[node], reach2) : examine_tensor(node, reach2);
    }

    /// How far the support of a node without other faults reaches along an axis.
    double width(Offset node, int d) const {
        return h != nullptr
                   ? extent * h[node] + skin
                   : extent * tensor_support<Dim>(tested(node), HalfWidths::all).half_width[d];
    }

private:
    const double* tensor(Offset node) const { return H + node * n_symmetric(Dim); }
    /// The tensor that the search will read.
    const double* tested(Offset node) const {
        return widened != nullptr ? widened + node * n_symmetric(Dim) : tensor(node);
    }

    Fault examine_scalar(double length, double& reach2) const {
        if (!(length >= 0) || !std::isfinite(length)) return Fault::support;
        for (int d = 0; d < Dim; ++d)
            if (!(extent * length + skin <= half_length[d])) return Fault::half_box;
        reach2 = skin > 0 ? widened_reach2(length, extent, skin) : scalar_reach2(length, extent);
        return Fault::none;
    }

    Fault examine_tensor(Offset node, double& reach2) const {
        TensorSupport<Dim> support = tensor_support<Dim>(tensor(node), widths);
        if (!support.positive_definite) return Fault::not_spd;
        if (widened != nullptr) {
            if (!widen_tensor<Dim>(tensor(node), extent, skin, widened + node * n_symmetric(Dim)))
                return Fault::ill_conditioned;
            support = tensor_support<Dim>(tested(node), widths);
        }
        for (int d = 0; d < Dim; ++d)
            if (!(extent * support.half_width[d] <= half_length[d])) return Fault::half_box;
        const double reach = extent * support.radius;
        reach2 =
            reach * reach * (1 + 1e-14) + std::numeric_limits<double>::min();  // never rounds to 0
        return Fault::none;
    }
};

template <int Dim>
ListReader<Dim> reader(const NodeList& list, double extent, double skin, const Domain& domain) {
    ListReader<Dim> r{list.positions().data(),
                      list.has_tensor() ? nullptr : list.h().data(),
                      list.has_tensor() ? list.H().data() : nullptr,
                      extent,
                      skin,
                      nullptr,
                      {},
                      domain.any_periodic(Dim) ? HalfWidths::all : HalfWidths::none};
    for (int d = 0; d < Dim; ++d)
        r.half_length[d] =
            domain.periodic[d] ? 0.5 * domain.length(d) : std::numeric_limits<double>::infinity();
    return r;
}

/// Fills reach2 for one list. Returns the first node with a fault, or n.
template <int Dim>
Offset check_list(const ListReader<Dim>& read, Offset n, double* reach2) {
    Offset first = n;
    Kokkos::parallel_reduce(
        "map/check", Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
        [=](const Offset i, Offset& lowest) {
            if (read.examine(i, reach2[i]) != Fault::none && i < lowest) lowest = i;
        },
        Kokkos::Min<Offset>(first));
    return first < n ? first : n;
}

template <int Dim>
std::string describe_tensor(const double* tensor) {
    std::string text = "H = (";
    for (int k = 0; k < n_symmetric(Dim); ++k) text += (k > 0 ? ", " : "") + number(tensor[k]);
    return text + ")";
}

/// Says what is wrong with the first offending node and how many share its fault.
template <int Dim>
[[noreturn]] void report_fault(const ListReader<Dim>& read, std::span<const NodeList> lists,
                               std::size_t l, Offset node) {
    double reach2 = 0;
    const Fault fault = read.examine(node, reach2);
    Offset count = 0;
    for (Offset i = node; i < lists[l].n(); ++i) count += read.examine(i, reach2) == fault;
    std::string text = "node list " + std::to_string(l) + " (\"" + lists[l].name() + "\"), node " +
                       std::to_string(node) + ": ";
    Status status = Status::nonfinite;
    if (fault == Fault::position) {
        int d = 0;
        while (std::isfinite(read.positions[node * Dim + d])) ++d;
        text += "position[" + std::to_string(d) + "] = " + number(read.positions[node * Dim + d]) +
                ", must be finite";
    } else if (fault == Fault::support) {
        status = Status::support;
        text += "h = " + number(read.h[node]) + ", must be finite and >= 0";
    } else if (fault == Fault::not_spd) {
        status = Status::not_spd;
        text += describe_tensor<Dim>(read.H + node * n_symmetric(Dim)) +
                ", must be finite and positive definite";
    } else if (fault == Fault::ill_conditioned) {
        status = Status::not_spd;
        text += describe_tensor<Dim>(read.H + node * n_symmetric(Dim)) +
                ", must have a condition number below 7e12 with a skin";
    } else {
        status = Status::half_box;
        int d = 0;
        while (d < Dim && read.width(node, d) <= read.half_length[d]) ++d;
        if (fault == Fault::none || d == Dim)
            throw Error(Status::internal,
                        text + "was refused and is legal now: did it change during the call?");
        text += (read.h != nullptr ? "support radius " : "half width of the support ") +
                number(read.width(node, d)) + " is larger than half the length of periodic axis " +
                std::to_string(d) + ", " + number(read.half_length[d]);
    }
    throw Error(status, text + "; " + std::to_string(count) + " such node" +
                            (count > 1 ? "s" : "") + " in this list");
}

template <int Dim>
double largest_extent(std::span<const NodeList> lists) {
    double extent = 0;
    for (const NodeList& list : lists) extent = std::max(extent, list.kernel_extent());
    return extent;
}

/// Positions of all lists, joined only if there is more than one.
template <int Dim>
ConstView<double> join_positions(std::span<const NodeList> lists, Offset n,
                                 PreparedStorage& storage) {
    if (lists.size() == 1) return lists[0].positions();
    ensure_capacity(storage.positions, "map/positions", n * Dim);
    Offset at = 0;
    for (const NodeList& list : lists) at = append(storage.positions, at, list.positions());
    HostExec().fence();
    return Kokkos::subview(storage.positions, std::pair<std::size_t, std::size_t>(0, n * Dim));
}

bool any_tensor(std::span<const NodeList> lists) {
    return std::any_of(lists.begin(), lists.end(),
                       [](const NodeList& l) { return l.has_tensor(); });
}

/// Tensors of all lists: empty if none has any; zeros stand for nodes with scalar h. Widened ones
/// are in the storage already.
template <int Dim>
ConstView<double> join_tensors(std::span<const NodeList> lists, Offset n, bool widened,
                               PreparedStorage& storage) {
    if (!any_tensor(lists)) return {};
    if (lists.size() == 1 && !widened) return lists[0].H();
    constexpr Offset size = n_symmetric(Dim);
    if (!widened) ensure_capacity(storage.H, "map/H", n * size);
    Offset at = 0;
    for (const NodeList& list : lists) {
        if (!list.has_tensor())
            Kokkos::deep_copy(Kokkos::subview(storage.H, std::pair<std::size_t, std::size_t>(
                                                             at, at + list.n() * size)),
                              0.0);
        else if (!widened)
            append(storage.H, at, list.H());
        at += list.n() * size;
    }
    HostExec().fence();
    return Kokkos::subview(storage.H, std::pair<std::size_t, std::size_t>(0, n * size));
}

}  // namespace

template <int Dim>
SearchNodes<Dim> prepare_nodes(std::span<const NodeList> lists, const Domain& domain,
                               PreparedStorage& storage, double skin) {
    SearchNodes<Dim> nodes;
    const bool widens_tensors = skin > 0 && any_tensor(lists);
    const double extent = largest_extent<Dim>(lists);
    for (const NodeList& list : lists) nodes.n += list.n();
    nodes.extent2 = extent * extent;
    nodes.periods = periods<Dim>(domain);
    ensure_capacity(storage.reach2, "map/reach2", nodes.n);
    if (widens_tensors) ensure_capacity(storage.H, "map/H", nodes.n * n_symmetric(Dim));
    Offset at = 0;
    for (std::size_t l = 0; l < lists.size(); at += lists[l].n(), ++l) {
        auto read = reader<Dim>(lists[l], extent, skin, domain);
        if (widens_tensors) read.widened = storage.H.data() + at * n_symmetric(Dim);
        const Offset bad = check_list<Dim>(read, lists[l].n(), storage.reach2.data() + at);
        if (bad < lists[l].n()) report_fault<Dim>(read, lists, l, bad);
    }
    nodes.reach2 = Kokkos::subview(storage.reach2, std::pair<std::size_t, std::size_t>(0, nodes.n));
    nodes.positions = join_positions<Dim>(lists, nodes.n, storage);
    nodes.H = join_tensors<Dim>(lists, nodes.n, widens_tensors, storage);
    return nodes;
}

template SearchNodes<1> prepare_nodes<1>(std::span<const NodeList>, const Domain&, PreparedStorage&,
                                         double);
template SearchNodes<2> prepare_nodes<2>(std::span<const NodeList>, const Domain&, PreparedStorage&,
                                         double);
template SearchNodes<3> prepare_nodes<3>(std::span<const NodeList>, const Domain&, PreparedStorage&,
                                         double);

}  // namespace connectivity
