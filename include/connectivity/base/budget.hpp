// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The memory budget: what a build may allocate, checked before it allocates.

#include <string>

#include <connectivity/base/types.hpp>

namespace connectivity {

/// Bytes of memory that are free now on this host (0 where the system does not tell).
Offset available_memory();

struct Budget {
    /// Largest number of bytes a product may take; 0 means 80 % of the memory that is free when the
    /// build starts.
    Offset bytes = 0;

    friend bool operator==(const Budget&, const Budget&) = default;

    /// The number in force now.
    Offset allowed() const;

    /// Does a product of so many bytes fit? Small ones fit without asking the system, which costs
    /// 50 us.
    bool allows(Offset needed) const {
        constexpr Offset small = Offset{16} << 20;
        return (bytes <= 0 && needed <= small) || needed <= allowed();
    }
};

/// "12.3 GiB"
std::string human_bytes(Offset bytes);

}  // namespace connectivity
