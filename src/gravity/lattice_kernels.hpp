// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Moments to locals through the far images of a periodic box, eight pairs of cells at once: those
/// that reflections in the middle planes of the box make of one. One kernel per instruction set,
/// chosen at run time. Raw pointers only; nothing is allocated.

namespace connectivity::detail {

constexpr int n_reflections = 8;  ///< lanes; bit d of the number: axis d is turned round

/// locals += the terms j + k <= order of (-1)^j sum_kl conj(M_kl) T_(j+k,l+q), which is exact for
/// the force of A on B being that of B on A. `sums` [(order+1)²] are T; `moments` and `locals` are
/// [(order+1)²][n_reflections]. Layout and meaning as in expansion_kernels.hpp, order <= 20.
using LatticeKernel = void (*)(int order, const double* sums, const double* moments,
                               double* locals);

/// The kernel for this processor; see base/isa.hpp.
LatticeKernel lattice_kernel();

void lattice_kernel_portable(int order, const double* sums, const double* moments, double* locals);
// On x86-64.
void lattice_kernel_avx2(int order, const double* sums, const double* moments, double* locals);
void lattice_kernel_avx512(int order, const double* sums, const double* moments, double* locals);

}  // namespace connectivity::detail
