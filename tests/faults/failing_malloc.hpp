// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Memory that cannot be had: in this program every allocation of the library, of Kokkos and of C++
/// comes through here, and one of them fails.

namespace connectivity::test {

/// Allocations until one fails; negative: none will.
extern long allocations_left;

/// Bytes that were asked for since somebody set it to 0.
extern long allocated_bytes;

/// Whether allocations can be made to fail here; sanitizers bring a malloc of their own.
extern const bool can_fail;

}  // namespace connectivity::test
