// SPDX-License-Identifier: BSD-3-Clause
#include <support/workloads.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <stdexcept>

#include <support/random.hpp>

namespace connectivity::test {
namespace {

using std::numbers::pi;

// The documented hashes were taken with fused products and sums, so the fusion is written out here.

/// Radius of a ball with `neighbours` others at a given density.
double radius(double neighbours, double density) {
    return std::cbrt((neighbours + 1.0) * 3.0 / (4.0 * pi * density));
}

/// Points with three components each, and radii.
struct Points {
    std::vector<double> x, R;

    void resize(Offset n, double constant_R) {
        x.assign(static_cast<std::size_t>(3 * n), 0.0);
        R.assign(static_cast<std::size_t>(n), constant_R);
    }
    Offset n() const { return static_cast<Offset>(R.size()); }
    double& at(Offset p, int d) { return x[static_cast<std::size_t>(3 * p + d)]; }
};

double random_of(std::uint64_t seed, Offset p, int k) {
    return u01(seed, static_cast<std::uint64_t>(4 * p + k));
}

/// Nodes as a share of a million.
double share(Offset n) { return static_cast<double>(n) / 1e6; }

int scaled(int side, double scale) {
    return std::max(1, static_cast<int>(std::lround(side * scale)));
}

Points lattice(const int (&side)[3], double jitter, std::uint64_t seed, double R) {
    Points points;
    points.resize(Offset{side[0]} * side[1] * side[2], R);
    Offset p = 0;
    for (int k = 0; k < side[2]; ++k)
        for (int j = 0; j < side[1]; ++j)
            for (int i = 0; i < side[0]; ++i, ++p) {
                const int cell[3] = {i, j, k};
                for (int d = 0; d < 3; ++d)
                    points.at(p, d) = std::fma(jitter, random_of(seed, p, d) - 0.5, cell[d] + 0.5);
            }
    return points;
}

void put_on_sphere(Points& points, Offset p, double r, std::uint64_t seed) {
    const double cosine = 2 * random_of(seed, p, 1) - 1;
    const double phi = 2 * pi * random_of(seed, p, 2),
                 sine = std::sqrt(std::fma(-cosine, cosine, 1.0));
    points.at(p, 0) = r * sine * std::cos(phi);
    points.at(p, 1) = r * sine * std::sin(phi);
    points.at(p, 2) = r * cosine;
}

Points plummer(Offset n) {
    Points points;
    points.resize(n, 0);
    for (Offset p = 0; p < points.n(); ++p) {
        const double m = 0.99 * random_of(103, p, 0);
        const double q = 1.0 / std::cbrt(m * m);
        const double r = m == 0 ? 0 : 1.0 / std::sqrt(q - 1.0);
        put_on_sphere(points, p, r, 103);
        const double t = std::fma(r, r, 1.0);
        const double central = static_cast<double>(n) / 0.99 * 3 / (4 * pi);
        points.R[static_cast<std::size_t>(p)] = radius(60, central / (t * t * std::sqrt(t)));
    }
    return points;
}

Points plane(Offset n) {
    const int side = scaled(1000, std::sqrt(share(n)));
    Points points = lattice({side, side, 1}, 0.4, 104, std::sqrt(26.0 / pi));
    for (Offset p = 0; p < points.n(); ++p) points.at(p, 2) = 0;
    return points;
}

/// The mid radius makes the volume of the shell proportional to n: 141 at a million nodes.
Points shell(Offset n) {
    constexpr double half = 2, far = 5e4;
    const double mid =
        std::sqrt(std::max(half * half, 19881 * share(n) + (share(n) - 1) * half * half / 3));
    const double inner = mid - half, outer = mid + half;
    const double cube = inner * inner * inner, volume = outer * outer * outer - cube;
    Points points;
    points.resize(n, radius(60, 1));
    for (Offset p = 0; p < n; ++p)
        put_on_sphere(points, p, std::cbrt(std::fma(volume, random_of(105, p, 0), cube)), 105);
    for (int corner = 0; corner < std::min<Offset>(8, n); ++corner)
        for (int d = 0; d < 3; ++d) points.at(corner, d) = (corner >> d & 1) != 0 ? far : -far;
    return points;
}

Points tank(Offset n) {
    const double scale = std::cbrt(share(n));
    const int sides[3] = {scaled(200, scale), scaled(50, scale), scaled(100, scale)};
    Points points = lattice(sides, 0.1, 106, radius(30, 1));
    const double size[3] = {4.0 * sides[0], 1.0 * sides[1], 2.0 * sides[2]};
    for (Offset p = 0; p < points.n(); p += 1000)
        for (int d = 0; d < 3; ++d) points.at(p, d) = size[d] * random_of(1106, p, d);
    return points;
}

Points two_sizes(Offset n) {
    const double small = radius(8, 1), side = 100 * std::cbrt(share(n));
    Points points;
    points.resize(n, small);
    for (Offset p = 0; p < n; ++p) {
        for (int d = 0; d < 3; ++d) points.at(p, d) = side * random_of(107, p, d);
        if (random_of(107, p, 3) < 0.01) points.R[static_cast<std::size_t>(p)] = 10 * small;
    }
    return points;
}

std::uint64_t hash_of(const std::vector<double>& values) {
    std::uint64_t hash = 0;
    for (const double value : values)
        hash = hash * 1099511628211ull + std::bit_cast<std::uint64_t>(value);
    return hash;
}

/// Fisher-Yates with the counter-based generator.
std::vector<Offset> shuffled(Offset n) {
    std::vector<Offset> order(static_cast<std::size_t>(n));
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Offset>(k);
    for (std::uint64_t k = order.size() - 1; k > 0; --k)
        std::swap(order[k], order[mix(0xC0FFEEull + (k + 1) * golden) % (k + 1)]);
    return order;
}

Points jittered(const int (&sides)[3], double scale, std::uint64_t seed) {
    return lattice({scaled(sides[0], scale), scaled(sides[1], scale), scaled(sides[2], scale)}, 0.4,
                   seed, radius(60, 1));
}

struct Recipe {
    const char* name;
    int dim;
    bool constant_R;
    Offset n;  ///< standard size; pairs and hash belong to it
    Offset n_pairs;
    std::uint64_t hash;
    Points (*make)(Offset n);
};

const Recipe recipes[] = {
    {"W1", 3, true, 1000000, 31141276, 0x77657a2aa51dbbf7ull,
     [](Offset n) {
         return jittered({100, 100, 100}, std::cbrt(share(n)), 101);
     }},
    {"W2", 3, true, 100000, 3016522, 0xea879acbdfee552full,
     [](Offset n) {
         return jittered({50, 50, 40}, std::cbrt(10 * share(n)), 102);
     }},
    {"W3", 3, false, 1000000, 32594744, 0x9d14d2be8b6f3fdbull, plummer},
    {"W4", 2, true, 1000000, 11783030, 0xed248b2996b9ac5eull, plane},
    {"W5", 3, true, 1000000, 23534570, 0x8826a6a727bc567eull, shell},
    {"W6", 3, true, 1000000, 13011005, 0x2fa3729f315b21eeull, tank},
    {"W7", 3, false, 1000000, 80631534, 0x46f884a3b3ff39fbull, two_sizes},
};

/// The size after the @ of a name, or the recipe's own.
Offset size_in(const std::string& name, Offset standard) {
    const std::size_t at = name.find('@');
    if (at == std::string::npos) return standard;
    const char* const text = name.c_str() + at + 1;
    char* end = nullptr;
    const double n = std::strtod(text, &end);
    if (end == text || *end != 0 || !(n >= 1 && n <= 1e8))
        throw std::invalid_argument("size of workload " + name + ": a number of 1 to 1e8");
    return std::llround(n);
}

}  // namespace

Workload make_workload(const std::string& name) {
    const auto* const recipe =
        std::find_if(std::begin(recipes), std::end(recipes),
                     [&](const Recipe& r) { return name.substr(0, name.find('@')) == r.name; });
    if (recipe == std::end(recipes))
        throw std::invalid_argument("no workload named " + name + "; known: W1 ... W7, W1@1e4");
    const Offset n = size_in(name, recipe->n);
    const Points points = recipe->make(n);
    Workload w;
    w.name = name;
    w.dim = recipe->dim;
    w.n = points.n();
    w.constant_R = recipe->constant_R;
    w.hash = hash_of(points.x);
    if (n == recipe->n) w.n_pairs = recipe->n_pairs, w.wanted_hash = recipe->hash;
    for (const Offset p : shuffled(w.n)) {
        for (int d = 0; d < w.dim; ++d)
            w.x.push_back(points.x[static_cast<std::size_t>(3 * p + d)]);
        w.R.push_back(points.R[static_cast<std::size_t>(p)]);
    }
    return w;
}

}  // namespace connectivity::test
