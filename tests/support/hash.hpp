// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// FNV-1a over bytes: a fingerprint of results, to compare runs of different processes.

#include <cstddef>
#include <cstdint>

namespace connectivity::test {

class Fnv1a {
public:
    void add(const void* data, std::size_t bytes) {
        const auto* c = static_cast<const unsigned char*>(data);
        for (std::size_t k = 0; k < bytes; ++k) value_ = (value_ ^ c[k]) * 1099511628211ull;
    }
    /// All elements of a host View.
    template <class View>
    void add_view(const View& view) {
        add(view.data(), view.size() * sizeof(*view.data()));
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 14695981039346656037ull;
};

}  // namespace connectivity::test
