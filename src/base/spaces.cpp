// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/base/spaces.hpp>

#include <cstdint>
#include <string_view>

#include <connectivity/base/budget.hpp>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace connectivity::detail {

void advise_huge_pages(void* data, std::size_t bytes) noexcept {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    constexpr std::uintptr_t page = 4096;
    constexpr std::size_t smallest = std::size_t{4} << 20;
    if (data == nullptr || bytes < smallest) return;
    const auto first = (reinterpret_cast<std::uintptr_t>(data) + page - 1) & ~(page - 1);
    const auto last = (reinterpret_cast<std::uintptr_t>(data) + bytes) & ~(page - 1);
    madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#else
    (void)data, (void)bytes;
#endif
}

void throw_allocation_failed(const std::string& label, Offset n, std::size_t size,
                             const char* why) {
    const std::string_view reason(why);  // Kokkos adds lines of advice
    throw Error(Status::memory, "allocation of \"" + label + "\" failed: " + std::to_string(n) +
                                    " elements of " + std::to_string(size) +
                                    " bytes: " + std::string(reason.substr(0, reason.find('\n'))));
}

}  // namespace connectivity::detail
