// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Loops over chunks of boxes.

#include <algorithm>

#include <connectivity/base/parallel.hpp>

namespace connectivity::detail {

inline Offset n_chunks(Offset n, Offset size) { return (n + size - 1) / size; }

/// body(chunk, first, last) for all chunks of [0, n), in parallel if there are several; must not
/// throw.
template <class Body>
void for_each_chunk(const std::string& label, Offset n, Offset size, const Body& body) {
    if (n <= 0) return;
    for_each_dynamic(label, n_chunks(n, size), [&](int, Offset chunk) {
        body(chunk, chunk * size, std::min(n, (chunk + 1) * size));
    });
}

}  // namespace connectivity::detail
