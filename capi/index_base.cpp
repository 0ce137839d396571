// SPDX-License-Identifier: BSD-3-Clause
#include "index_base.hpp"

#include <connectivity/base/parallel.hpp>

namespace connectivity::capi {

IndexBase::IndexBase(std::int32_t base, const std::string& name) : base_(base) {
    if (base != 0 && base != 1)
        throw Error(Status::argument, name + " = " + std::to_string(base) + ", must be 0 or 1");
}

void IndexBase::copy_out(const Slot* ours, Offset n, Slot* theirs) const {
    if (ours == theirs && is_zero()) return;
    if (n <= few_items) {
        for (Offset k = 0; k < n; ++k) theirs[k] = ours[k] + base_;
        return;
    }
    Kokkos::parallel_for("capi/index_base",
                         Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
                         [=, base = base_](const Offset k) { theirs[k] = ours[k] + base; });
    HostExec().fence();
}

ConstView<Slot> BasedCopy::of(const ConstView<Slot>& ours, IndexBase base, Generation generation) {
    if (base.is_zero()) return ours;
    const auto n = static_cast<Offset>(ours.size());
    return made(n, generation, [&](Slot* theirs) { base.copy_out(ours.data(), n, theirs); });
}

}  // namespace connectivity::capi
