// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/node_list.hpp>

#include <cmath>

namespace connectivity {

namespace {
[[noreturn]] void refuse(const std::string& name, const std::string& what) {
    throw Error(Status::argument, "node list \"" + name + "\": " + what);
}
}  // namespace

void NodeList::check_shape(const char* support_name, Offset n_support, Offset per_node) const {
    if (dim_ < 1 || dim_ > 3)
        refuse(name_, "dim = " + std::to_string(dim_) + ", must be 1, 2 or 3");
    const auto n_coordinates = static_cast<Offset>(positions_.size());
    if (n_coordinates % dim_ != 0)
        refuse(name_, std::to_string(n_coordinates) +
                          " coordinates are no multiple of dim = " + std::to_string(dim_));
    if (n_coordinates / dim_ * per_node != n_support)
        refuse(name_, std::to_string(n_coordinates / dim_) + " positions but " +
                          std::to_string(n_support) + " values of " + support_name + ", must be " +
                          std::to_string(per_node) + " a node");
    if (n_internal_ < 0 || n_internal_ > n_coordinates / dim_)
        refuse(name_, "n_internal = " + std::to_string(n_internal_) + ", must be in [0, " +
                          std::to_string(n_coordinates / dim_) + "]");
    check_kernel_extent(name_, kernel_extent_);
}

void check_kernel_extent(const std::string& name, double kernel_extent) {
    if (!(kernel_extent >= 1e-100 && kernel_extent <= 1e100))  // its square must be normal
        refuse(name, "kernel_extent = " + number(kernel_extent) +
                         ", must be > 0 and finite, in [1e-100, 1e100]");
}

NodeList NodeList::with_h(std::string name, int dim, Offset n_internal, ConstView<double> positions,
                          ConstView<double> h, double kernel_extent) {
    NodeList list;
    list.name_ = std::move(name);
    list.dim_ = dim;
    list.n_internal_ = n_internal;
    list.kernel_extent_ = kernel_extent;
    list.positions_ = positions;
    list.h_ = h;
    list.check_shape("h", static_cast<Offset>(h.size()), 1);
    list.n_ = static_cast<Offset>(h.size());
    return list;
}

NodeList NodeList::with_H(std::string name, int dim, Offset n_internal, ConstView<double> positions,
                          ConstView<double> H, double kernel_extent) {
    NodeList list;
    list.name_ = std::move(name);
    list.dim_ = dim;
    list.n_internal_ = n_internal;
    list.kernel_extent_ = kernel_extent;
    list.has_tensor_ = true;
    list.positions_ = positions;
    list.H_ = H;
    list.check_shape("H", static_cast<Offset>(H.size()), n_symmetric(dim));
    list.n_ = static_cast<Offset>(positions.size()) / dim;
    return list;
}

NodeList& NodeList::set_global_ids(ConstView<std::int64_t> ids) {
    if (static_cast<Offset>(ids.size()) != n_)
        refuse(name_, std::to_string(ids.size()) + " global ids, must be one for each of " +
                          std::to_string(n_) + " nodes");
    global_ids_ = std::move(ids);
    return *this;
}

NodeList& NodeList::set_owners(ConstView<Slot> owner) {
    if (static_cast<Offset>(owner.size()) != n_ghosts())
        refuse(name_, std::to_string(owner.size()) + " owners, must be one for each of " +
                          std::to_string(n_ghosts()) + " ghosts");
    owners_ = std::move(owner);
    return *this;
}

}  // namespace connectivity
