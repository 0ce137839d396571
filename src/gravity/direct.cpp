// SPDX-License-Identifier: BSD-3-Clause
#include "direct.hpp"

#include <algorithm>
#include <cstring>

#include <connectivity/base/parallel.hpp>

namespace connectivity::detail {

namespace {

constexpr Offset max_block = 128;     ///< targets that one worker takes at a time
constexpr Offset wanted_items = 64;   ///< of work, for a balance between a few dozen threads
constexpr Offset least_chunk = 4096;  ///< sources, if there are not enough targets for that

/// How the work is cut: blocks of targets, and chunks of sources where blocks alone are too few.
struct Cut {
    Offset block, n_blocks, chunk, n_chunks;

    Cut(Offset n_targets, Offset n_sources) {
        block = std::clamp((n_targets / 16 + 31) / 32 * 32, Offset{32}, max_block);
        n_blocks = (n_targets + block - 1) / block;
        const Offset chunks = (wanted_items + n_blocks - 1) / n_blocks;
        chunk = std::max(least_chunk, (n_sources / chunks + 1023) / 1024 * 1024);
        n_chunks = chunks == 1 ? 1 : (n_sources + chunk - 1) / chunk;
        if (n_chunks == 1) chunk = n_sources;
    }
};

/// A block of targets, gathered and moved.
struct Block {
    double x[max_block], y[max_block], z[max_block], e[max_block];
    double p[max_block] = {}, ax[max_block] = {}, ay[max_block] = {}, az[max_block] = {};
    Offset id[max_block];
    Offset n;

    Block(const NearSources<double>& s, const DirectTargets& t, Offset begin, Offset end)
        : n(end - begin) {
        for (Offset k = 0; k < n; ++k) {
            const Offset i = t.which ? t.which[begin + k] : t.first + begin + k;
            id[k] = i;
            x[k] = s.x[i] + t.shift[0];
            y[k] = s.y[i] + t.shift[1];
            z[k] = s.z[i] + t.shift[2];
            e[k] = s.e ? s.e[i] : 0;
        }
    }
    NearTargets<double> targets() { return {x, y, z, e, p, ax, ay, az, n}; }
};

/// Finds the sources that may be in the same place as a target: a bit for each of 4096 values of a
/// hash of x.
class Places {
public:
    explicit Places(const Block& block) {
        for (Offset k = 0; k < block.n; ++k) {
            const std::uint64_t h = hash(block.x[k]);
            bits_[h / 64] |= std::uint64_t{1} << h % 64;
        }
    }
    bool may_hold(double x) const {
        const std::uint64_t h = hash(x);
        return (bits_[h / 64] >> h % 64 & 1) != 0;
    }

private:
    static std::uint64_t hash(double x) {
        x += 0.0;  // -0 is 0
        std::uint64_t bits;
        std::memcpy(&bits, &x, sizeof bits);
        return bits * 0x9E3779B97F4A7C15u >> 52;
    }
    std::uint64_t bits_[64] = {};
};

/// The kernel leaves out what is at r = 0, the target itself among it.
void add_coincident(const NearSources<double>& s, Offset begin, Offset end, Block& block) {
    const Places places(block);
    for (Offset j = begin; j < end; ++j) {
        if (!places.may_hold(s.x[j])) continue;
        for (Offset k = 0; k < block.n; ++k) {
            if (s.x[j] != block.x[k] || s.y[j] != block.y[k] || s.z[j] != block.z[k]) continue;
            const double e = std::max(s.e[j], block.e[k]);
            if (block.id[k] != j && e > 0) block.p[k] += s.m[j] / e;
        }
    }
}

/// Adds the sums of a block to those of all targets from `begin`.
void add_to(const DirectSums& sums, Offset begin, const Block& block) {
    for (Offset k = 0; k < block.n; ++k) {
        sums.p[begin + k] += block.p[k];
        sums.ax[begin + k] += block.ax[k];
        sums.ay[begin + k] += block.ay[k];
        sums.az[begin + k] += block.az[k];
    }
}

}  // namespace

void direct_sum(PairLaw law, const NearSources<double>& s, const DirectTargets& t,
                const DirectSums& sums, std::vector<double>& scratch) {
    if (t.n == 0 || s.n == 0) return;
    const Cut cut(t.n, s.n);
    const auto part = [&](Offset chunk) {  // the sums over a chunk of sources
        double* const p = scratch.data() + chunk * 4 * t.n;
        return cut.n_chunks == 1 ? sums : DirectSums{p, p + t.n, p + 2 * t.n, p + 3 * t.n};
    };
    if (cut.n_chunks > 1) scratch.assign(static_cast<std::size_t>(cut.n_chunks * 4 * t.n), 0.0);
    const DirectKernels& kernels = direct_kernels();
    for_each_dynamic("gravity/direct", cut.n_blocks * cut.n_chunks, [&](int, Offset item) {
        const Offset chunk = item / cut.n_blocks, first = item % cut.n_blocks * cut.block;
        const Offset begin = chunk * cut.chunk, end = std::min(begin + cut.chunk, s.n);
        Block block(s, t, first, std::min(first + cut.block, t.n));
        kernels.add64(law,
                      {s.x + begin, s.y + begin, s.z + begin, s.m + begin,
                       s.e ? s.e + begin : nullptr, end - begin},
                      block.targets());
        if (law == PairLaw::plummer) add_coincident(s, begin, end, block);
        add_to(part(chunk), first, block);
    });
    if (cut.n_chunks == 1) return;
    for (Offset chunk = 0; chunk < cut.n_chunks; ++chunk)
        for (Offset k = 0; k < t.n; ++k) {
            const DirectSums sum = part(chunk);
            sums.p[k] += sum.p[k];
            sums.ax[k] += sum.ax[k];
            sums.ay[k] += sum.ay[k];
            sums.az[k] += sum.az[k];
        }
}

}  // namespace connectivity::detail
