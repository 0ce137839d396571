// SPDX-License-Identifier: BSD-3-Clause
#include "program/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace connectivity::program {

Offset CountStatistics::min() const {
    const auto first =
        std::find_if(histogram.begin(), histogram.end(), [](Offset c) { return c > 0; });
    return n > 0 ? static_cast<Offset>(first - histogram.begin()) : 0;
}

Offset CountStatistics::percentile(double percent) const {
    const auto rank =
        std::max<Offset>(1, static_cast<Offset>(std::ceil(percent / 100 * static_cast<double>(n))));
    Offset below = 0;
    for (std::size_t c = 0; c < histogram.size(); ++c) {
        below += histogram[c];
        if (below >= rank) return static_cast<Offset>(c);
    }
    return max();
}

CountStatistics neighbour_statistics(const ConnectivityMap& map, int list, Offset n_internal) {
    const auto rows = map.rows();
    const Offset first = map.layout().row_offset()[static_cast<std::size_t>(list)];
    CountStatistics result;
    result.n = n_internal;
    Offset total = 0;
    for (Offset r = first; r < first + n_internal; ++r) {
        const auto count = static_cast<std::size_t>(rows[r].size());
        if (count >= result.histogram.size()) result.histogram.resize(count + 1);
        ++result.histogram[count];
        total += static_cast<Offset>(count);
    }
    if (n_internal > 0) result.mean = static_cast<double>(total) / static_cast<double>(n_internal);
    return result;
}

Difference relative_difference(const ConstView<double>& a, const ConstView<double>& b) {
    Difference result;
    double sum = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        if (b(i) == 0) continue;
        const double relative = std::abs(a(i) - b(i)) / std::abs(b(i));
        sum += relative * relative;
        result.max = std::max(result.max, relative);
        ++result.n;
    }
    if (result.n > 0) result.rms = std::sqrt(sum / static_cast<double>(result.n));
    return result;
}

}  // namespace connectivity::program
