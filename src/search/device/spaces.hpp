// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Where the device search runs, and what all its stages need: copies of host data, offsets from
/// counts, loops over items that a vector of lanes shares.
///
/// Invariants: on a host space nothing is copied; memory is kept from build to build and only
/// grows; no stage appends atomically, every list is counted, scanned and filled.

#include <vector>

#include <connectivity/base/spaces.hpp>

namespace connectivity::detail::device {

template <class Exec>
constexpr bool is_host = std::is_same_v<typename Exec::memory_space, HostMemory>;

/// View of kernels' memory.
template <class T, class Exec>
using Array = View<T, typename Exec::memory_space>;

template <class T, class Memory>
Offset bytes_of(const View<T, Memory>& view) {
    return static_cast<Offset>(view.size() * sizeof(T));
}

template <class T, class Memory>
auto front(const View<T, Memory>& view, Offset n) {
    return Kokkos::subview(view,
                           std::pair<std::size_t, std::size_t>(0, static_cast<std::size_t>(n)));
}

/// Host data where kernels can read it: the data itself on a host space, else a copy.
template <class T, class Exec>
class Uploaded {
public:
    /// The copy is made anew if `fresh`, else it is the one made last. Throws Error{memory}.
    const T* operator()(const char* label, const T* host, Offset n, bool fresh = true) {
        if constexpr (is_host<Exec>) {
            return host;
        } else {
            if (fresh && n > 0) {
                ensure_capacity(copy_, label, n);
                Kokkos::deep_copy(front(copy_, n),
                                  Kokkos::View<const T*, Kokkos::LayoutRight, HostMemory,
                                               Kokkos::MemoryUnmanaged>(host, n));
            }
            return n > 0 ? copy_.data() : nullptr;
        }
    }
    Offset bytes() const { return bytes_of(copy_); }

private:
    Array<T, Exec> copy_;
};

/// Results of kernels, and where the host reads them.
template <class T, class Exec>
class Downloaded {
public:
    /// Room for n values that kernels write. Throws Error{memory}.
    T* reserve(const char* label, Offset n) {
        ensure_capacity(device_, label, n);
        if constexpr (!is_host<Exec>) ensure_capacity(host_, label, n);
        return device_.data();
    }
    void clear(Offset n) { Kokkos::deep_copy(front(device_, n), T{0}); }

    /// The first n values, after the kernels.
    const T* fetch(Offset n) {
        Exec().fence();
        if constexpr (is_host<Exec>) {
            return device_.data();
        } else {
            Kokkos::deep_copy(front(host_, n), front(device_, n));
            return host_.data();
        }
    }
    Offset bytes() const { return bytes_of(device_) + bytes_of(host_); }

private:
    Array<T, Exec> device_;
    View<T> host_;
};

template <class Exec>
using Items = Kokkos::RangePolicy<Exec, Kokkos::IndexType<Offset>>;

struct ExclusiveScan {
    Offset* counts;
    Offset n;
    KOKKOS_INLINE_FUNCTION void operator()(Offset i, Offset& sum, bool final) const {
        const Offset count = i < n ? counts[i] : 0;
        if (final) counts[i] = sum;
        sum += count;
    }
};

/// Turns n counts into n + 1 offsets, in place; returns their sum.
template <class Exec>
Offset make_offsets(const char* label, Offset* counts, Offset n) {
    Offset total = 0;
    Kokkos::parallel_scan(label, Items<Exec>(0, n + 1), ExclusiveScan{counts, n}, total);
    Exec().fence();
    return total;
}

template <class Exec>
using Teams = Kokkos::TeamPolicy<Exec, Kokkos::Schedule<Kokkos::Dynamic>>;

/// Lanes that work on one item together: a leaf of 16 nodes is one step of half a warp.
constexpr int lanes = 16;

/// A team takes so many items, one after another on a host, side by side on a device.
template <class Exec>
constexpr int items_per_team = is_host<Exec> ? 64 : 8;

template <class Exec, class Body>
struct VectorLoop {
    Body body;
    Offset n;
    KOKKOS_INLINE_FUNCTION void operator()(const typename Teams<Exec>::member_type& team) const {
        const Offset first = static_cast<Offset>(team.league_rank()) * items_per_team<Exec>;
        Kokkos::parallel_for(Kokkos::TeamThreadRange(team, items_per_team<Exec>), [&](int k) {
            if (first + k < n) body(team, first + k);
        });
    }
};

/// body(team member, item) for items [0, n), each by a vector of lanes.
template <class Exec, class Body>
void for_each_vector(const char* label, Offset n, const Body& body) {
    if (n == 0) return;
    const int per_team = items_per_team<Exec>;
    const Offset teams = (n + per_team - 1) / per_team;
    Kokkos::parallel_for(label,
                         Teams<Exec>(static_cast<int>(teams), is_host<Exec> ? 1 : per_team, lanes),
                         VectorLoop<Exec, Body>{body, n});
}

}  // namespace connectivity::detail::device
