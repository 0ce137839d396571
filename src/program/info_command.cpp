// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <connectivity/base/budget.hpp>
#include <connectivity/base/runtime.hpp>
#include <connectivity/io/snapshot.hpp>

#include "program/commands.hpp"
#include "program/console.hpp"
#include "program/gnuplot.hpp"

namespace connectivity::program {

namespace {

std::string compiler() {
#if defined(__clang__)
    return fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
    return fmt::format("GNU {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
    return "unknown";
#endif
}

std::string build_kind() {
#ifdef NDEBUG
    return "optimised";
#else
    return "with assertions";
#endif
}

/// Vector instruction sets of this processor that the library has kernels for.
std::string instruction_sets() {
#if defined(__x86_64__) && defined(__GNUC__)
    std::string sets = "x86-64";
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) sets += ", AVX2";
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl"))
        sets += ", AVX-512";
    return sets;
#else
    return "baseline";
#endif
}

std::string plotting() {
    try {
        return find_gnuplot();
    } catch (const Error&) {
        return "gnuplot not found: --plot is not available";
    }
}

}  // namespace

void run_info() {
    start_runtime();
    const auto entry = [](const char* name, const std::string& value) {
        Console::line(fmt::format("{:<18}{}", name, value));
    };
    entry("connectivity", CONNECTIVITY_VERSION);
    entry("backends", runtime_description());
    entry("threads", std::to_string(runtime_threads()));
    entry("processor", instruction_sets());
    entry("free memory", human_bytes(available_memory()));
    entry("files", file_library());
    entry("pictures", plotting());
    entry("compiler", compiler());
    entry("build", build_kind());
}

}  // namespace connectivity::program
