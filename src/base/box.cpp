// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/base/box.hpp>

#include <string>

#include <connectivity/base/error.hpp>

namespace connectivity {

void Domain::check(int dim) const {
    for (int d = 0; d < dim; ++d) {
        if (!periodic[d]) continue;
        const double length = hi[d] - lo[d];
        if (std::isfinite(lo[d]) && std::isfinite(hi[d]) && std::isfinite(length) && length > 0)
            continue;
        throw Error(Status::box, "box: periodic axis " + std::to_string(d) + " runs from " +
                                     std::to_string(lo[d]) + " to " + std::to_string(hi[d]) +
                                     "; both ends must be finite and the upper one larger");
    }
}

}  // namespace connectivity
