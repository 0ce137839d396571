// SPDX-License-Identifier: BSD-3-Clause
/// The layouts of connectivity_gravity.h, locked as those of layout.cpp: the Fortran module and
/// other mirrors of the header rely on them.

#include <cstddef>
#include <type_traits>

#include "connectivity_gravity.h"

namespace {

template <class T>
constexpr bool is_plain = std::is_standard_layout_v<T>&& std::is_trivially_copyable_v<T>;

#define CONN_CHECK_OFFSET(type, member, at) static_assert(offsetof(type, member) == (at))

static_assert(is_plain<conn_gravity_options> && sizeof(conn_gravity_options) == 160);
CONN_CHECK_OFFSET(conn_gravity_options, struct_size, 0);
CONN_CHECK_OFFSET(conn_gravity_options, method, 8);
CONN_CHECK_OFFSET(conn_gravity_options, order, 12);
CONN_CHECK_OFFSET(conn_gravity_options, tolerance, 16);
CONN_CHECK_OFFSET(conn_gravity_options, epsilon, 24);
CONN_CHECK_OFFSET(conn_gravity_options, acceptance, 32);
CONN_CHECK_OFFSET(conn_gravity_options, leaf, 36);
CONN_CHECK_OFFSET(conn_gravity_options, near_precision, 40);
CONN_CHECK_OFFSET(conn_gravity_options, symmetric, 44);
CONN_CHECK_OFFSET(conn_gravity_options, softening, 48);
CONN_CHECK_OFFSET(conn_gravity_options, n_samples, 52);
CONN_CHECK_OFFSET(conn_gravity_options, error_bound, 56);
CONN_CHECK_OFFSET(conn_gravity_options, periodic, 60);
CONN_CHECK_OFFSET(conn_gravity_options, constant, 72);
CONN_CHECK_OFFSET(conn_gravity_options, box_lo, 80);
CONN_CHECK_OFFSET(conn_gravity_options, box_hi, 104);
CONN_CHECK_OFFSET(conn_gravity_options, seed, 128);
CONN_CHECK_OFFSET(conn_gravity_options, previous_acceleration, 136);
CONN_CHECK_OFFSET(conn_gravity_options, n_previous, 144);
CONN_CHECK_OFFSET(conn_gravity_options, budget_bytes, 152);

static_assert(is_plain<conn_gravity_info> && sizeof(conn_gravity_info) == 160);
CONN_CHECK_OFFSET(conn_gravity_info, struct_size, 0);
CONN_CHECK_OFFSET(conn_gravity_info, n, 8);
CONN_CHECK_OFFSET(conn_gravity_info, generation, 16);
CONN_CHECK_OFFSET(conn_gravity_info, method, 24);
CONN_CHECK_OFFSET(conn_gravity_info, order, 28);
CONN_CHECK_OFFSET(conn_gravity_info, acceptance, 32);
CONN_CHECK_OFFSET(conn_gravity_info, near_precision, 36);
CONN_CHECK_OFFSET(conn_gravity_info, epsilon, 40);
CONN_CHECK_OFFSET(conn_gravity_info, n_samples, 48);
CONN_CHECK_OFFSET(conn_gravity_info, n_near, 56);
CONN_CHECK_OFFSET(conn_gravity_info, n_far, 64);
CONN_CHECK_OFFSET(conn_gravity_info, acceleration_rms, 72);
CONN_CHECK_OFFSET(conn_gravity_info, acceleration_p99, 80);
CONN_CHECK_OFFSET(conn_gravity_info, acceleration_max, 88);
CONN_CHECK_OFFSET(conn_gravity_info, field_rms, 96);
CONN_CHECK_OFFSET(conn_gravity_info, field_p99, 104);
CONN_CHECK_OFFSET(conn_gravity_info, field_max, 112);
CONN_CHECK_OFFSET(conn_gravity_info, potential_rms, 120);
CONN_CHECK_OFFSET(conn_gravity_info, potential_p99, 128);
CONN_CHECK_OFFSET(conn_gravity_info, potential_max, 136);
CONN_CHECK_OFFSET(conn_gravity_info, reached, 144);
CONN_CHECK_OFFSET(conn_gravity_info, dim, 148);
CONN_CHECK_OFFSET(conn_gravity_info, scratch_bytes, 152);

static_assert(is_plain<conn_gravity_view> && sizeof(conn_gravity_view) == 64);
CONN_CHECK_OFFSET(conn_gravity_view, struct_size, 0);
CONN_CHECK_OFFSET(conn_gravity_view, n, 8);
CONN_CHECK_OFFSET(conn_gravity_view, generation, 16);
CONN_CHECK_OFFSET(conn_gravity_view, space, 24);
CONN_CHECK_OFFSET(conn_gravity_view, device_id, 28);
CONN_CHECK_OFFSET(conn_gravity_view, acceleration, 32);
CONN_CHECK_OFFSET(conn_gravity_view, potential, 40);
CONN_CHECK_OFFSET(conn_gravity_view, error_bound, 48);
CONN_CHECK_OFFSET(conn_gravity_view, owner, 56);

#undef CONN_CHECK_OFFSET

static_assert(CONN_GRAVITY_AUTOMATIC == 0 && CONN_GRAVITY_DIRECT == 1 && CONN_GRAVITY_WALK == 2 &&
              CONN_GRAVITY_FMM == 3);
static_assert(CONN_ACCEPT_AUTOMATIC == 0 && CONN_ACCEPT_FIELD == 1 &&
              CONN_ACCEPT_ACCELERATION == 2 && CONN_ACCEPT_GEOMETRIC == 3);
static_assert(CONN_SOFTENING_PLUMMER == 0 && CONN_SOFTENING_SPH_EXA == 1);
static_assert(CONN_NEAR_AUTOMATIC == 0 && CONN_NEAR_FLOAT32 == 1 && CONN_NEAR_FLOAT64 == 2);
static_assert(CONN_STRUCT_GRAVITY_OPTIONS == 18 && CONN_STRUCT_GRAVITY_INFO == 19 &&
              CONN_STRUCT_GRAVITY_VIEW == 20);

}  // namespace
