// SPDX-License-Identifier: BSD-3-Clause
#include "kernels.hpp"

#include <cstdlib>
#include <string_view>

namespace connectivity::detail {

namespace {

enum class Isa { portable, avx2, avx512 };

Isa choose() {
#if defined(CONNECTIVITY_X86_KERNELS)
    const char* const asked = std::getenv("CONNECTIVITY_ISA");
    const std::string_view wish = asked != nullptr ? asked : "";
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                      __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                      __builtin_cpu_supports("popcnt");
    const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") &&
                        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                        __builtin_cpu_supports("avx512bw");
    if (avx512 && wish != "avx2" && wish != "portable") return Isa::avx512;
    if (avx2 && wish != "portable") return Isa::avx2;
#endif
    return Isa::portable;
}

}  // namespace

template <int Dim>
const Kernels<Dim>& kernels() {
    static const Isa isa = choose();
#if defined(CONNECTIVITY_X86_KERNELS)
    if (isa == Isa::avx512) return avx512_kernels<Dim>();
    if (isa == Isa::avx2) return avx2_kernels<Dim>();
#endif
    (void)isa;
    return portable_kernels<Dim>();
}

template const Kernels<1>& kernels<1>();
template const Kernels<2>& kernels<2>();
template const Kernels<3>& kernels<3>();

}  // namespace connectivity::detail
