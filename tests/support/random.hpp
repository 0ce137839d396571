// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Counter-based random numbers (splitmix64): the k-th number of a seed is the same everywhere.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace connectivity::test {

constexpr std::uint64_t golden = 0x9E3779B97F4A7C15ull;

/// Finaliser of splitmix64.
constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
}

/// k-th number of a seed, uniform in [0, 1).
constexpr double u01(std::uint64_t seed, std::uint64_t k) {
    return static_cast<double>(mix(seed + (k + 1) * golden) >> 11) * 0x1.0p-53;
}

/// A stream of numbers: of a seed, or cut from bytes that somebody else chose (a fuzzer), as few
/// bytes a number as will do and zeros after the last.
class Random {
public:
    explicit Random(std::uint64_t seed) : seed_(seed) {}
    explicit Random(std::span<const std::uint8_t> bytes) : bytes_(bytes), has_bytes_(true) {}

    std::uint64_t bits() { return has_bytes_ ? take(8) : mix(seed_ + ++k_ * golden); }
    double uniform() {
        return has_bytes_ ? static_cast<double>(take(2)) * 0x1.0p-16
                          : static_cast<double>(bits() >> 11) * 0x1.0p-53;
    }
    double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
    double log_uniform(double lo, double hi) { return lo * std::pow(hi / lo, uniform()); }
    /// A number of 0, 1, ..., n - 1.
    int below(int n) {
        const std::uint64_t number = has_bytes_ ? take(n <= 256 ? 1 : 4) : bits();
        return static_cast<int>(number % static_cast<std::uint64_t>(n));
    }
    bool chance(double p) {
        return (has_bytes_ ? static_cast<double>(take(1)) * 0x1.0p-8 : uniform()) < p;
    }
    /// Are all bytes used up?
    bool exhausted() const { return has_bytes_ && bytes_.empty(); }

    template <class T, std::size_t N>
    T pick(const T (&choices)[N]) {
        return choices[below(static_cast<int>(N))];
    }

private:
    std::uint64_t take(std::size_t n) {
        std::uint64_t number = 0;
        n = std::min(n, bytes_.size());
        for (std::size_t k = 0; k < n; ++k) number |= std::uint64_t{bytes_[k]} << (8 * k);
        bytes_ = bytes_.subspan(n);
        return number;
    }

    std::uint64_t seed_ = 0, k_ = 0;
    std::span<const std::uint8_t> bytes_;
    bool has_bytes_ = false;
};

}  // namespace connectivity::test
