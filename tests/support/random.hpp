// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Counter-based random numbers (splitmix64): the k-th number of a seed is the same everywhere.

#include <cmath>
#include <cstdint>

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

/// A stream of numbers of one seed.
class Random {
public:
    explicit Random(std::uint64_t seed) : seed_(seed) {}

    std::uint64_t bits() { return mix(seed_ + ++k_ * golden); }
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
    double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
    double log_uniform(double lo, double hi) { return lo * std::pow(hi / lo, uniform()); }
    /// A number of 0, 1, ..., n - 1.
    int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
    bool chance(double p) { return uniform() < p; }

    template <class T, std::size_t N>
    T pick(const T (&choices)[N]) {
        return choices[below(static_cast<int>(N))];
    }

private:
    std::uint64_t seed_, k_ = 0;
};

}  // namespace connectivity::test
