// SPDX-License-Identifier: BSD-3-Clause
#include "base/isa.hpp"

#include <cstdlib>
#include <string_view>

namespace connectivity::detail {

namespace {

Isa choose() {
#if defined(__x86_64__)
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

Isa isa() {
    static const Isa chosen = choose();
    return chosen;
}

}  // namespace connectivity::detail
