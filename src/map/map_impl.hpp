// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a map keeps from build to build beside its lists, and how it starts work.

#include <tuple>

#include <connectivity/base/kokkos_shim.hpp>
#include <connectivity/base/runtime.hpp>
#include <connectivity/map/connectivity_map.hpp>

#include "derived_build.hpp"
#include "drift.hpp"
#include "patch.hpp"
#include "prepare.hpp"

namespace connectivity {

/// Joined inputs; one searcher and one maker of derived lists for each dimension in use; with a
/// skin the state to measure drift from; storage of the lists before a patch.
struct ConnectivityMap::Impl {
    PreparedStorage storage;
    DriftReference reference;
    std::tuple<Search<1>, Search<2>, Search<3>> searches;
    std::tuple<DerivedBuild<1>, DerivedBuild<2>, DerivedBuild<3>> derived_builds;
    Patch patch;

    template <int Dim>
    Search<Dim>& search() {
        return std::get<Dim - 1>(searches);
    }
    template <int Dim>
    DerivedBuild<Dim>& derived() {
        return std::get<Dim - 1>(derived_builds);
    }
};

/// Runs body() where Kokkos may launch kernels, also for a caller inside an OpenMP region. Throws
/// Error{callback} inside a traversal of this map, which uses the threads.
template <class Body>
void ConnectivityMap::launch(const char* what, const Body& body) const {
    if (traversing_)
        throw Error(Status::callback,
                    std::string(what) + ": called from the function of a traversal of this map");
    shim::outside_parallel_region([&] {
        start_runtime();
        try {
            body();
        } catch (const std::bad_alloc&) {
            throw Error(Status::memory, std::string(what) + ": out of memory");
        }
    });
}

/// Throws Error: argument, too_many, box. `call` is the function whose arguments these are.
void check_request(const std::string& call, std::span<const NodeList> lists,
                   const MapOptions& options);

SlotLayout layout_of(std::span<const NodeList> lists, const MapOptions& options);

}  // namespace connectivity
