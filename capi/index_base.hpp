// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Numbers of nodes as a host counts them, from 0 or 1, while ours count from 0: the one place
/// where they change. Positions (offsets, ranks, numbers of pairs, rows and lists) never do.

#include <string>

#include <connectivity/base/spaces.hpp>

#include "connectivity.h"

namespace connectivity::capi {

class IndexBase {
public:
    IndexBase() = default;
    /// Throws Error{argument} unless 0 or 1; `name` is the argument's.
    IndexBase(std::int32_t base, const std::string& name);

    bool is_zero() const { return base_ == 0; }
    Slot out(Slot ours) const { return ours + base_; }
    /// -1 for what is below the base and hence no node.
    Slot in(Slot theirs) const { return theirs < base_ ? -1 : theirs - base_; }

    /// theirs[k] = out(ours[k]); the two may be one array.
    void copy_out(const Slot* ours, Offset n, Slot* theirs) const;

    friend bool operator==(const IndexBase&, const IndexBase&) = default;

private:
    Slot base_ = 0;
};

/// Memory for a list of slots as a host counts them that differs from ours: made once a generation.
class BasedCopy {
public:
    /// `ours` itself if the numbers are the same. Throws Error{memory}.
    ConstView<Slot> of(const ConstView<Slot>& ours, IndexBase base, Generation generation);
    /// The same for a list that fill(data) writes with its final numbers.
    template <class Fill>
    ConstView<Slot> made(Offset n, Generation generation, const Fill& fill) {
        if (generation_ != generation) {
            generation_ = 0;
            ensure_capacity(copy_, "capi/index_base", n);
            fill(copy_.data());
            generation_ = generation;
        }
        return Kokkos::subview(copy_, std::pair<Offset, Offset>(0, n));
    }
    Offset bytes() const { return static_cast<Offset>(copy_.size() * sizeof(Slot)); }

private:
    View<Slot> copy_;
    Generation generation_ = 0;  // that it holds
};

/// Of all lists of a map.
struct BasedLists {
    BasedCopy rows, overlap, intersection, pair_i, pair_j, key_order;

    Offset bytes() const {
        return rows.bytes() + overlap.bytes() + intersection.bytes() + pair_i.bytes() +
               pair_j.bytes() + key_order.bytes();
    }
};

}  // namespace connectivity::capi
