// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The nodes of one list in the order in which a host should walk through them.
///
/// Holds its storage: valid and unchanged through rebuilds.

#include <connectivity/base/spaces.hpp>

namespace connectivity {

class NodeTraversal {
public:
    /// Node ids 0, 1, ... n-1.
    explicit NodeTraversal(Offset n) : n_(n) {}
    explicit NodeTraversal(ConstView<Slot> ids)
        : ids_(std::move(ids)), n_(static_cast<Offset>(ids_.size())) {}

    Offset size() const { return n_; }
    /// The k-th node, k in [0, size()).
    Slot operator[](Offset k) const { return ids_.size() > 0 ? ids_(k) : static_cast<Slot>(k); }

    class Iterator {
    public:
        using value_type = Slot;
        using difference_type = Offset;
        Iterator() = default;
        Iterator(const NodeTraversal* of, Offset at) : of_(of), at_(at) {}
        Slot operator*() const { return (*of_)[at_]; }
        Iterator& operator++() {
            ++at_;
            return *this;
        }
        Iterator operator++(int) { return {of_, at_++}; }
        bool operator==(const Iterator& other) const { return at_ == other.at_; }

    private:
        const NodeTraversal* of_ = nullptr;
        Offset at_ = 0;
    };
    Iterator begin() const { return {this, 0}; }
    Iterator end() const { return {this, n_}; }

private:
    ConstView<Slot> ids_;  // empty: the identity
    Offset n_;
};

}  // namespace connectivity
