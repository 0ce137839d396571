// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The nodes of one list with room for ghosts: a copy of what the host gave, and images behind it.
///
/// Cost: 8 (dim + 1 or n_symmetric(dim)) + 4 bytes a node; storage grows by a quarter and is kept.

#include <connectivity/boundary/ghost_lists.hpp>
#include <connectivity/boundary/rigid_map.hpp>
#include <connectivity/map/node_list.hpp>

namespace connectivity::detail {

/// Makes room for n values, the first n_kept of which stay.
template <class T>
void grow(View<T>& view, const char* label, Offset n_kept, Offset n) {
    if (n <= static_cast<Offset>(view.size()) && view.use_count() <= 1) return;
    auto grown =
        allocate<T>(label, n <= static_cast<Offset>(view.size()) ? static_cast<Offset>(view.size())
                                                                 : n + n / 4);
    std::copy_n(view.data(), n_kept, grown.data());
    view = grown;
}

class GhostNodes {
public:
    /// Takes the internal nodes of a list, ghosts dropped. Throws Error{memory}.
    void take(const NodeList& list);

    /// The same nodes in another place: values only. The number of internal nodes and the kind of
    /// support must be the same.
    void move(const NodeList& list);

    /// Makes images of the controls behind the last node. Throws Error{memory}.
    void append(const GhostBlock& ghosts, const RigidMap& map);

    /// Makes images of the controls again, in place.
    void place(const GhostBlock& ghosts, const RigidMap& map);

    /// Drops ghosts with keep = 0. keep and old2new are those of this list.
    void drop(const Slot* keep, const Slot* old2new);

    /// The first n nodes.
    NodeList list(Offset n_nodes) const;

    Offset n = 0, n_internal = 0;
    int dim = 3;
    bool tensor = false;
    double kernel_extent = 2;
    const double* positions() const { return x_.data(); }
    const double* support() const { return support_.data(); }
    const std::string& name() const { return name_; }
    Offset bytes() const;

private:
    int per_node() const { return tensor ? n_symmetric(dim) : 1; }
    void copy_values(const NodeList& list);
    template <int Dim>
    void place_in(const GhostBlock& ghosts, const RigidMap& map);
    void copy_node(Offset from, Offset to);

    std::string name_;
    bool has_ids_ = false;
    View<double> x_, support_;
    View<Slot> owner_;  // [n_ghosts]
    View<std::int64_t> ids_;
};

}  // namespace connectivity::detail
