// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a map keeps from build to build beside its lists, and how it starts work.

#include <optional>
#include <tuple>

#include <connectivity/base/kokkos_shim.hpp>
#include <connectivity/base/runtime.hpp>
#include <connectivity/map/connectivity_map.hpp>

#include "derived_build.hpp"
#include "drift.hpp"
#include "patch.hpp"
#include "prepare.hpp"

namespace connectivity {

/// Joined inputs; a searcher and a maker of derived lists for the dimension in use; with a skin the
/// state to measure drift from; storage of the lists before a patch. What is not needed is not
/// there: letting go of it cannot fail.
struct ConnectivityMap::Impl {
    PreparedStorage storage;
    DriftReference reference;
    std::tuple<std::optional<Search<1>>, std::optional<Search<2>>, std::optional<Search<3>>>
        searches;
    std::tuple<std::optional<DerivedBuild<1>>, std::optional<DerivedBuild<2>>,
               std::optional<DerivedBuild<3>>>
        derived_builds;
    std::optional<Patch> patch;

    template <int Dim>
    Search<Dim>& search() {
        auto& search = std::get<Dim - 1>(searches);
        return search ? *search : search.emplace();
    }
    template <int Dim>
    DerivedBuild<Dim>& derived() {
        auto& derived = std::get<Dim - 1>(derived_builds);
        return derived ? *derived : derived.emplace();
    }
    Patch& patches() { return patch ? *patch : patch.emplace(); }

    /// Lets go of what other dimensions hold, and of derived lists unless they are `derived`.
    template <int Dim>
    void keep_only(bool derived) noexcept {
        if (Dim != 1) std::get<0>(searches).reset();
        if (Dim != 2) std::get<1>(searches).reset();
        if (Dim != 3) std::get<2>(searches).reset();
        if (Dim != 1 || !derived) std::get<0>(derived_builds).reset();
        if (Dim != 2 || !derived) std::get<1>(derived_builds).reset();
        if (Dim != 3 || !derived) std::get<2>(derived_builds).reset();
    }
    Offset derived_bytes() const {
        return std::apply(
            [](const auto&... builds) { return ((builds ? builds->bytes() : 0) + ...); },
            derived_builds);
    }
};

/// Runs body() where Kokkos may launch kernels, also for a caller inside an OpenMP region. Throws
/// Error{callback} inside a traversal of this map, which uses the threads.
template <class Body>
void ConnectivityMap::launch(const char* what, const Body& body) const {
    if (traversing_)
        throw Error(Status::callback,
                    std::string(what) + ": called from the function of a traversal of this map");
    run_kernels(what, body);
}

/// Number of nodes in all lists. Throws Error: argument (no list, dimensions differ), too_many.
Offset check_lists(const std::string& call, std::span<const NodeList> lists);

/// Throws Error: argument, too_many, box. `call` is the function whose arguments these are.
void check_request(const std::string& call, std::span<const NodeList> lists,
                   const MapOptions& options);

SlotLayout layout_of(std::span<const NodeList> lists, const MapOptions& options);

}  // namespace connectivity
