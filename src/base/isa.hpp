// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The instruction set that vector kernels may use on this processor, asked once.
///
/// CONNECTIVITY_ISA=portable or avx2 in the environment takes a narrower one. Where the build has
/// no kernels for x86 the answer is `portable`.

namespace connectivity::detail {

enum class Isa { portable, avx2, avx512 };

Isa isa();

}  // namespace connectivity::detail
