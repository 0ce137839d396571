// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the opaque handle of connectivity_gravity.h is, and the owner of its views.

#include <cstdint>
#include <optional>

#include <connectivity/gravity/gravity.hpp>

#include "connectivity_gravity.h"
#include "registry.hpp"
#include "structs.hpp"

struct conn_gravity final : connectivity::capi::Handle {
    const std::int64_t context_budget;
    std::optional<connectivity::Gravity> gravity{std::in_place};  ///< none after Kokkos stopped
    int dim = 3;                                                  ///< of the last positions
    std::uint64_t generation = 0;                                 ///< 0: there are no forces

    explicit conn_gravity(std::int64_t budget) : context_budget(budget) {}
    const char* kind() const noexcept override { return "gravity"; }
    void drop_views() noexcept override {
        gravity.reset();
        generation = 0;
    }
};

namespace connectivity::capi {

CONNECTIVITY_FIRST_LAYOUT(conn_gravity_options, budget_bytes);
CONNECTIVITY_FIRST_LAYOUT(conn_gravity_info, scratch_bytes);
CONNECTIVITY_FIRST_LAYOUT(conn_gravity_view, owner);

/// What has forces behind the handle. Throws Error{null | handle | not_built}.
const conn_gravity& solved_gravity(const conn_gravity* gravity);

struct GravityPin final : Handle {
    ConstView<double> acceleration, potential, error_bound;

    const char* kind() const noexcept override { return "the owner of a gravity view"; }
    void drop_views() noexcept override { acceleration = potential = error_bound = {}; }
};

}  // namespace connectivity::capi
