// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Bodies of the sums over pairs over a type `V` of vector operations. Included once by each
/// instruction set's file, after its V's; everything lives in an anonymous namespace, so that no
/// two instruction sets share a function.
///
/// V has: T, F (vector of T), lanes, tile (vectors of targets that fit the registers), step
/// (sources at a time), load, store, set, add, sub, mul, max, fma, sum (of the lanes), all_zero;
/// inverse_root(d2, r2): root_scale / sqrt(d2) or 0 where r2 is 0, whose result may be infinite or
/// NaN where d2 is extreme; exact_inverse_root, the same without a scale and for any d2. V for
/// double has: first(n), the lanes below n <= lanes; load_some(p, those), which touches no others;
/// store of all lanes to floats.

#include "direct_kernels.hpp"

namespace connectivity::detail {
namespace {

/// Terms are added up in three steps, because the rounding errors of a sum grow with the number of
/// its terms: over a block of sources in registers, over a run of blocks, over the runs.
constexpr std::int64_t source_block = 256, source_run = 32 * source_block;

/// A reduction over the lanes costs about as much as so many vectors of pairs.
constexpr std::int64_t reduction_cost = 4;

template <class V>
struct Point {
    typename V::F x, y, z, e;
};

template <class V>
struct PairSums {
    typename V::F p, x, y, z;

    PairSums() : p(V::set(0)), x(p), y(p), z(p) {}
    bool finite() const {
        const auto zero = V::set(0);
        return V::all_zero(V::fma(p, zero, V::fma(x, zero, V::fma(y, zero, V::mul(z, zero)))));
    }
};

/// Adds what sources do to targets, lane by lane. Not exact: in the scale of unscaled(), fast,
/// infinite or NaN if the cube of a root overflows.
template <class V, PairLaw law, bool exact>
inline void add_pairs(const Point<V>& target, const Point<V>& source, typename V::F m,
                      PairSums<V>& sums) {
    const auto dx = V::sub(source.x, target.x), dy = V::sub(source.y, target.y),
               dz = V::sub(source.z, target.z);
    const auto r2 = V::fma(dx, dx, V::fma(dy, dy, V::mul(dz, dz)));
    auto d2 = r2;
    if constexpr (law == PairLaw::plummer) {
        const auto e = V::max(target.e, source.e);
        d2 = V::fma(e, e, r2);
    } else if constexpr (law == PairLaw::sph_exa) {
        const auto e = V::add(target.e, source.e);
        d2 = V::max(V::mul(e, e), r2);
    }
    if constexpr (exact) {
        const auto r = V::exact_inverse_root(d2, r2), mr = V::mul(m, r), mrr = V::mul(mr, r);
        sums.p = law == PairLaw::sph_exa ? V::fma(mr, V::mul(V::mul(r2, r), r), sums.p)
                                         : V::add(sums.p, mr);
        sums.x = V::fma(mrr, V::mul(dx, r), sums.x);
        sums.y = V::fma(mrr, V::mul(dy, r), sums.y);
        sums.z = V::fma(mrr, V::mul(dz, r), sums.z);
    } else {
        const auto r = V::inverse_root(d2, r2), mr = V::mul(m, r), f = V::mul(mr, V::mul(r, r));
        sums.p = law == PairLaw::sph_exa ? V::fma(f, r2, sums.p) : V::add(sums.p, mr);
        sums.x = V::fma(f, dx, sums.x);
        sums.y = V::fma(f, dy, sums.y);
        sums.z = V::fma(f, dz, sums.z);
    }
}

/// What the sums have to be multiplied with.
template <class V, PairLaw law, bool exact>
struct Unscaled {
    static constexpr typename V::T root = exact ? 1 : 1 / V::root_scale, a = root * root * root,
                                   p = law == PairLaw::sph_exa ? a : root;
};

template <class T>
NearSources<T> part(const NearSources<T>& s, std::int64_t begin, std::int64_t n) {
    return {s.x + begin, s.y + begin, s.z + begin, s.m + begin, s.e ? s.e + begin : nullptr, n};
}

template <class T>
NearTargets<T> part(const NearTargets<T>& t, std::int64_t begin, std::int64_t n) {
    return {t.x + begin,
            t.y + begin,
            t.z + begin,
            t.e ? t.e + begin : nullptr,
            t.p + begin,
            t.ax + begin,
            t.ay + begin,
            t.az + begin,
            n};
}

/// Vectors of targets against sources one by one. Leaves the sums alone and returns false if they
/// are not finite and not `exact`.
template <class V, PairLaw law, int Tile, bool exact>
bool add_tile(const NearSources<typename V::T>& s, const NearTargets<typename V::T>& t) {
    constexpr bool soft = law != PairLaw::newton;
    Point<V> target[Tile];
    PairSums<V> sums[Tile];
    for (int k = 0; k < Tile; ++k) {
        const int i = k * V::lanes;
        target[k] = {V::load(t.x + i), V::load(t.y + i), V::load(t.z + i),
                     soft ? V::load(t.e + i) : V::set(0)};
    }
    const auto add = [&](std::int64_t j) {
        const Point<V> source{V::set(s.x[j]), V::set(s.y[j]), V::set(s.z[j]),
                              V::set(soft ? s.e[j] : 0)};
        const auto m = V::set(s.m[j]);
        for (int k = 0; k < Tile; ++k) add_pairs<V, law, exact>(target[k], source, m, sums[k]);
    };
    std::int64_t j = 0;
    for (; j + V::step <= s.n; j += V::step)
        for (int k = 0; k < V::step; ++k) add(j + k);
    for (; j < s.n; ++j) add(j);
    if constexpr (!exact)
        for (const auto& sum : sums)
            if (!sum.finite()) return false;
    using Scale = Unscaled<V, law, exact>;
    const auto p = V::set(Scale::p), a = V::set(Scale::a);
    for (int k = 0; k < Tile; ++k) {
        const int i = k * V::lanes;
        V::store(t.p + i, V::fma(p, sums[k].p, V::load(t.p + i)));
        V::store(t.ax + i, V::fma(a, sums[k].x, V::load(t.ax + i)));
        V::store(t.ay + i, V::fma(a, sums[k].y, V::load(t.ay + i)));
        V::store(t.az + i, V::fma(a, sums[k].z, V::load(t.az + i)));
    }
    return true;
}

/// Targets one by one against vectors of sources: no lane is idle, however few targets there are.
template <class V, PairLaw law, int Tile, bool exact>
bool add_targets(const NearSources<typename V::T>& s, const NearTargets<typename V::T>& t) {
    using T = typename V::T;
    constexpr bool soft = law != PairLaw::newton;
    Point<V> target[Tile];
    PairSums<V> sums[Tile];
    for (int k = 0; k < Tile; ++k)
        target[k] = {V::set(t.x[k]), V::set(t.y[k]), V::set(t.z[k]), V::set(soft ? t.e[k] : 0)};
    const auto add = [&](const T* x, const T* y, const T* z, const T* e, const T* mass) {
        const Point<V> source{V::load(x), V::load(y), V::load(z), soft ? V::load(e) : V::set(0)};
        const auto m = V::load(mass);
        for (int k = 0; k < Tile; ++k) add_pairs<V, law, exact>(target[k], source, m, sums[k]);
    };
    std::int64_t j = 0;
    for (; j + V::lanes <= s.n; j += V::lanes)
        add(s.x + j, s.y + j, s.z + j, soft ? s.e + j : nullptr, s.m + j);
    if (j < s.n) {  // the rest, filled up with copies of the last that have no mass
        T x[V::lanes], y[V::lanes], z[V::lanes], e[V::lanes], m[V::lanes];
        for (int k = 0; k < V::lanes; ++k) {
            const std::int64_t from = j + k < s.n ? j + k : s.n - 1;
            x[k] = s.x[from], y[k] = s.y[from], z[k] = s.z[from], e[k] = soft ? s.e[from] : 0;
            m[k] = j + k < s.n ? s.m[from] : 0;
        }
        add(x, y, z, e, m);
    }
    if constexpr (!exact)
        for (const auto& sum : sums)
            if (!sum.finite()) return false;
    using Scale = Unscaled<V, law, exact>;
    for (int k = 0; k < Tile; ++k) {
        t.p[k] += Scale::p * V::sum(sums[k].p);
        t.ax[k] += Scale::a * V::sum(sums[k].x);
        t.ay[k] += Scale::a * V::sum(sums[k].y);
        t.az[k] += Scale::a * V::sum(sums[k].z);
    }
    return true;
}

template <class V, PairLaw law, int Tile>
inline void add_full_targets(const NearSources<typename V::T>& s,
                             const NearTargets<typename V::T>& t) {
    if (!add_targets<V, law, Tile, false>(s, t)) add_targets<V, law, Tile, true>(s, t);
}

template <class V, PairLaw law, int Tile>
inline void add_full_tile(const NearSources<typename V::T>& s,
                          const NearTargets<typename V::T>& t) {
    if (!add_tile<V, law, Tile, false>(s, t)) add_tile<V, law, Tile, true>(s, t);
}

/// Fewer targets than a tile: one by one, or, if there are few sources, filled up with copies of
/// the last to vectors.
template <class V, PairLaw law>
void add_few(const NearSources<typename V::T>& s, const NearTargets<typename V::T>& t) {
    using T = typename V::T;
    if (t.n * (s.n / V::lanes + reduction_cost) <= s.n * ((t.n + V::lanes - 1) / V::lanes)) {
        std::int64_t i = 0;
        for (; i + 2 <= t.n; i += 2) add_full_targets<V, law, 2>(s, part(t, i, 2));
        if (i < t.n) add_full_targets<V, law, 1>(s, part(t, i, 1));
        return;
    }
    for (std::int64_t first = 0; first < t.n; first += V::lanes) {
        const auto some = part(t, first, t.n - first < V::lanes ? t.n - first : V::lanes);
        T x[V::lanes], y[V::lanes], z[V::lanes], e[V::lanes];
        T p[V::lanes] = {}, ax[V::lanes] = {}, ay[V::lanes] = {}, az[V::lanes] = {};
        for (int k = 0; k < V::lanes; ++k) {
            const std::int64_t i = k < some.n ? k : some.n - 1;
            x[k] = some.x[i], y[k] = some.y[i], z[k] = some.z[i];
            e[k] = law != PairLaw::newton ? some.e[i] : 0;
        }
        add_full_tile<V, law, 1>(s, {x, y, z, e, p, ax, ay, az, V::lanes});
        for (std::int64_t i = 0; i < some.n; ++i) {
            some.p[i] += p[i], some.ax[i] += ax[i];
            some.ay[i] += ay[i], some.az[i] += az[i];
        }
    }
}

template <class V, PairLaw law>
void add_law(const NearSources<typename V::T>& sources, const NearTargets<typename V::T>& t) {
    for (std::int64_t begin = 0; begin < sources.n; begin += source_block) {
        const std::int64_t rest = sources.n - begin;
        const auto s = part(sources, begin, rest < source_block ? rest : source_block);
        constexpr int tile = V::tile * V::lanes;
        std::int64_t i = 0;
        for (; i + tile <= t.n; i += tile) add_full_tile<V, law, V::tile>(s, part(t, i, tile));
        if (i < t.n) add_few<V, law>(s, part(t, i, t.n - i));
    }
}

/// More than a run of sources: runs on some targets at a time.
template <class V, PairLaw law>
void add_runs(const NearSources<typename V::T>& s, const NearTargets<typename V::T>& t) {
    if (s.n <= source_run) return add_law<V, law>(s, t);
    constexpr std::int64_t n_together = 128;
    for (std::int64_t first = 0; first < t.n; first += n_together) {
        const auto to = part(t, first, t.n - first < n_together ? t.n - first : n_together);
        for (std::int64_t begin = 0; begin < s.n; begin += source_run) {
            const std::int64_t rest = s.n - begin;
            typename V::T p[n_together] = {}, ax[n_together] = {}, ay[n_together] = {},
                          az[n_together] = {};
            add_law<V, law>(part(s, begin, rest < source_run ? rest : source_run),
                            {to.x, to.y, to.z, to.e, p, ax, ay, az, to.n});
            for (std::int64_t i = 0; i < to.n; ++i) {
                to.p[i] += p[i], to.ax[i] += ax[i];
                to.ay[i] += ay[i], to.az[i] += az[i];
            }
        }
    }
}

template <class V>
void add(PairLaw law, const NearSources<typename V::T>& s, const NearTargets<typename V::T>& t) {
    switch (law) {
        case PairLaw::newton: return add_runs<V, PairLaw::newton>(s, t);
        case PairLaw::plummer: return add_runs<V, PairLaw::plummer>(s, t);
        case PairLaw::sph_exa: return add_runs<V, PairLaw::sph_exa>(s, t);
    }
}

/// Runs are short: whole vectors are stored, and what is too much is overwritten by the next run.
template <class V, class To>
void gather(const GatherFrom& from, const SourceRun* runs, std::int64_t n_runs, To* to,
            std::int64_t stride) {
    static_assert(V::lanes <= gather_slack);
    const auto scale = V::set(from.scale);
    for (const SourceRun* run = runs; run != runs + n_runs; to += run++->n) {
        const double *const shift = from.shift + 3 * run->image, *const x = from.x[0] + run->first,
                            *const y = from.x[1] + run->first, *const z = from.x[2] + run->first,
                            *const m = from.mass + run->first;
        const auto x0 = V::set(from.centre[0] - shift[0]), y0 = V::set(from.centre[1] - shift[1]),
                   z0 = V::set(from.centre[2] - shift[2]);
        for (int k = 0; k < run->n; k += V::lanes) {
            const auto some = V::first(run->n - k < V::lanes ? run->n - k : V::lanes);
            V::store(to + k, V::mul(V::sub(V::load_some(x + k, some), x0), scale));
            V::store(to + k + stride, V::mul(V::sub(V::load_some(y + k, some), y0), scale));
            V::store(to + k + 2 * stride, V::mul(V::sub(V::load_some(z + k, some), z0), scale));
            V::store(to + k + 3 * stride, V::load_some(m + k, some));
            if (from.softening != nullptr)
                V::store(to + k + 4 * stride,
                         V::mul(V::load_some(from.softening + run->first + k, some), scale));
        }
    }
}

}  // namespace
}  // namespace connectivity::detail
