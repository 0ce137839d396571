// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Loops that the compiler unrolls for certain, with counters that are constants.

#define CONNECTIVITY_INLINE __attribute__((always_inline))

namespace connectivity::detail {
namespace {

template <int K>
struct Int {
    constexpr operator int() const { return K; }
};

/// f(Int<First>), f(Int<First + Step>), ... up to Last.
template <int First, int Last, int Step = 1, class F>
CONNECTIVITY_INLINE inline void each(F&& f) {
    if constexpr (First <= Last) {
        f(Int<First>{});
        each<First + Step, Last, Step>(f);
    }
}

}  // namespace
}  // namespace connectivity::detail
