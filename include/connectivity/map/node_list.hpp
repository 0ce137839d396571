// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A node list: a named set of nodes, internal ones first, then ghosts.
///
/// Invariants: 1 <= dim <= 3; positions, and exactly one of h and H, agree on the number of nodes
/// n; 0 <= n_internal <= n; kernel_extent in [1e-100, 1e100]. Values (finite positions, h >= 0, H
/// positive definite) are checked by ConnectivityMap::rebuild, which reads them anyway. A node list
/// shares the Views it was given and copies nothing: move the nodes, then rebuild.

#include <string>

#include <connectivity/base/spaces.hpp>

namespace connectivity {

/// Throws Error{argument} unless it is in [1e-100, 1e100].
void check_kernel_extent(const std::string& name, double kernel_extent);

class NodeList {
public:
    /// Scalar smoothing lengths. positions [n * dim] interleaved, h [n] >= 0, both host; support
    /// radius kernel_extent*h. Throws Error{argument} if the shapes disagree.
    static NodeList with_h(std::string name, int dim, Offset n_internal,
                           ConstView<double> positions, ConstView<double> h, double kernel_extent);

    /// Tensor smoothing. H [n * n_symmetric(dim)] packed (xx,xy,xz,yy,yz,zz), 1/length, host; the
    /// support of a node is the closed ellipsoid |H r| <= kernel_extent. Throws Error{argument} if
    /// the shapes disagree.
    static NodeList with_H(std::string name, int dim, Offset n_internal,
                           ConstView<double> positions, ConstView<double> H, double kernel_extent);

    /// Names of the nodes that do not depend on how they are stored, the last word in key order:
    /// ids [n], host. Throws Error{argument} if the shape disagrees.
    NodeList& set_global_ids(ConstView<std::int64_t> ids);

    /// Which ghosts are images of nodes of this list: owner [n_ghosts], host, a node id in [0,
    /// n_internal), or -1 for a ghost of its own. An image has the Morton key and the global id of
    /// its owner and does not enlarge the box that the keys number. Throws Error{argument} if the
    /// shape disagrees; the values are checked by rebuilds in key order.
    NodeList& set_owners(ConstView<Slot> owner);

    const std::string& name() const { return name_; }
    int dim() const { return dim_; }
    Offset n() const { return n_; }
    Offset n_internal() const { return n_internal_; }
    Offset n_ghosts() const { return n_ - n_internal_; }
    bool is_ghost(Offset node) const { return node >= n_internal_; }
    bool has_tensor() const { return has_tensor_; }
    double kernel_extent() const { return kernel_extent_; }

    ConstView<double> positions() const { return positions_; }  ///< [n * dim]
    ConstView<double> h() const { return h_; }                  ///< [n], empty for tensors
    ConstView<double> H() const { return H_; }  ///< [n * n_symmetric(dim)], empty for scalars
    ConstView<std::int64_t> global_ids() const { return global_ids_; }  ///< [n], or empty
    ConstView<Slot> owners() const { return owners_; }                  ///< [n_ghosts], or empty

private:
    NodeList() = default;
    void check_shape(const char* support_name, Offset n_support, Offset per_node) const;

    std::string name_;
    int dim_ = 3;
    Offset n_ = 0, n_internal_ = 0;
    double kernel_extent_ = 2;
    bool has_tensor_ = false;
    ConstView<double> positions_, h_, H_;
    ConstView<std::int64_t> global_ids_;
    ConstView<Slot> owners_;
};

}  // namespace connectivity
