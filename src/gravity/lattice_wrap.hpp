// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Positions anywhere into a periodic box.

#include <cmath>

namespace connectivity::detail {

/// Place of x in [0, length) behind the box's low end, for finite x and lo. Exact but for the
/// rounding of one difference, however many boxes away x is; the far end is the near one.
inline double wrap_into_box(double x, double lo, double length) {
    double r = x - lo;
    if (r >= 0 && r < length) return r;
    r = std::fmod(x, length) - std::fmod(lo, length);  // in (-2 length, 2 length)
    if (r < 0) r += length;
    if (r < 0) r += length;
    if (r >= length) r -= length;
    return r >= 0 && r < length ? r : 0;
}

}  // namespace connectivity::detail
