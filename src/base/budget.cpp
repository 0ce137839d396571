// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/base/budget.hpp>

#include <array>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>

namespace connectivity {

Offset available_memory() {
    std::ifstream meminfo("/proc/meminfo");
    std::string word;
    while (meminfo >> word)
        if (word == "MemAvailable:") {
            Offset kib = 0;
            meminfo >> kib;
            return kib * 1024;
        }
    return 0;
}

Offset Budget::allowed() const {
    if (bytes > 0) return bytes;
    const Offset free = available_memory();
    return free > 0 ? free / 10 * 8 : std::numeric_limits<Offset>::max();
}

std::string human_bytes(Offset bytes) {
    constexpr std::array units{"B", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
    auto value = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (value >= 1024 && unit + 1 < units.size()) value /= 1024, ++unit;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), unit == 0 ? "%.0f %s" : "%.1f %s", value, units[unit]);
    return text.data();
}

}  // namespace connectivity
