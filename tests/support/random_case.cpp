// SPDX-License-Identifier: BSD-3-Clause
#include <support/random_case.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <support/random.hpp>

namespace connectivity::test {
namespace {

enum class Place { uniform, lattice, clusters, line, plane, few_points, shells };
enum class Spread { constant, factor_four, wide, with_zeros, one_giant };

/// Choices that hold for all lists of a case.
struct Scene {
    double side = 1, spacing = 0.1, support = 0.1;
    double offset[3] = {0, 0, 0};
    double largest_support = 0;  ///< half the shortest periodic axis; infinite if there is none
    Place place = Place::uniform;
    bool images = false;  ///< some positions outside the box
    double centre[3][3] = {};
};

Scene random_scene(Random& random, Case& c, int n) {
    Scene s;
    s.side = random.pick({1.0, 1.0, 10.0, 1e-3, 64.0});
    s.place = random.pick({Place::uniform, Place::uniform, Place::uniform, Place::lattice,
                           Place::lattice, Place::clusters, Place::line, Place::plane,
                           Place::few_points, Place::shells, Place::shells});
    const double offset = random.pick({0.0, 0.0, 0.0, 0.3, 1000.1, 1e5});
    s.largest_support = HUGE_VAL;
    for (int d = 0; d < c.dim; ++d) {
        const auto axis = static_cast<std::size_t>(d);
        s.offset[d] = offset * random.pick({-1.0, 1.0});
        c.domain.lo[axis] = s.offset[d];
        c.domain.hi[axis] = s.offset[d] + s.side * random.pick({1.0, 1.0, 1.0, 1.5});
        if (c.domain.periodic[axis])
            s.largest_support = std::min(s.largest_support, 0.5 * c.domain.length(d));
        for (auto& point : s.centre) point[d] = random.uniform();
    }
    const double nodes = std::max(1, n);
    s.spacing = s.side * std::pow(nodes, -1.0 / c.dim);
    if (s.place == Place::lattice)  // a power of two: differences are exact where the offset is
        s.spacing = s.side * std::exp2(std::round(std::log2(s.spacing / s.side)));
    s.support = s.spacing * (s.place == Place::lattice ? random.pick({1.0, 1.0, 2.0, 3.0})
                                                       : random.log_uniform(0.3, 4.0));
    s.images = random.chance(0.4);
    return s;
}

double coordinate(Random& random, const Scene& s, int d, int centre) {
    switch (s.place) {
        case Place::lattice:
            return s.spacing * random.below(std::max(1, static_cast<int>(s.side / s.spacing)));
        case Place::clusters: return s.side * (s.centre[centre][d] + 1e-9 * random.uniform());
        case Place::line: return d == 0 ? s.side * random.uniform() : 0.0;
        case Place::plane: return d < 2 ? s.side * random.uniform() : 0.0;
        case Place::few_points: return s.side * s.centre[centre][d];
        default: return s.side * random.uniform();
    }
}

/// From some node to the rim of a support around it, closer to it than floats can tell.
void step_to_rim(Random& random, const Scene& s, int dim, double (&step)[3]) {
    double length = 0;
    for (int d = 0; d < dim; ++d) {
        step[d] = random.uniform(-1, 1);
        length += step[d] * step[d];
    }
    const double rim = std::min(s.support, s.largest_support) *
                       (1 + random.pick({-1.0, 1.0}) * random.log_uniform(1e-17, 1e-4));
    for (int d = 0; d < dim; ++d) step[d] *= length > 0 ? rim / std::sqrt(length) : 0;
}

void place_nodes(Random& random, const Scene& s, const Case& c, int n, std::vector<double>& x) {
    for (int node = 0; node < n; ++node) {
        const bool twin = node > 0 && random.chance(0.03), outlier = random.chance(0.005);
        const bool rim = node > 0 && s.place == Place::shells && random.chance(0.9);
        const int other = node > 0 ? random.below(node) : 0, centre = random.below(3);
        double step[3] = {0, 0, 0};
        if (rim && !twin) step_to_rim(random, s, c.dim, step);
        for (int d = 0; d < c.dim; ++d) {
            double value = s.offset[d] + coordinate(random, s, d, centre);
            if (twin || rim) value = x[static_cast<std::size_t>(other * c.dim + d)] + step[d];
            if (c.domain.periodic[static_cast<std::size_t>(d)]) {
                if (s.images && random.chance(0.3))
                    value += c.domain.length(d) * (random.below(7) - 3) *
                             (random.chance(0.02) ? random.pick({1e5, 1e9}) : 1.0);
            } else if (outlier) {
                value += 1e3 * s.side * random.uniform(-1, 1);
            }
            x.push_back(value);
        }
    }
}

double random_support(Random& random, const Scene& s, Spread spread, bool first) {
    switch (spread) {
        case Spread::factor_four: return s.support * random.log_uniform(0.5, 2.0);
        case Spread::wide: return s.support * random.log_uniform(1e-4, 1e2);
        case Spread::with_zeros: return random.chance(0.3) ? 0.0 : s.support;
        case Spread::one_giant: return first ? 1e3 * s.support : s.support;
        default: return s.support;
    }
}

/// K·h <= L/2 as the library will round it.
double scalar_h(double support, double K, const Scene& s) {
    double h = std::min(support, s.largest_support) / K;
    while (K * h > s.largest_support) h = std::nextafter(h, 0.0);
    return h;
}

void random_tensor(Random& random, const Scene& s, int dim, double support, double K,
                   double* packed) {
    const double ratio = random.pick({1.0, 2.0, 10.0, 1e3, 1e6});
    double axes[3];
    for (double& axis : axes) {
        axis = support * (random.chance(0.5) ? 1.0 : random.log_uniform(1 / ratio, 1.0));
        axis = std::min(axis, 0.49 * s.largest_support) / K;
    }
    if (random.chance(0.2)) {  // aligned, powers of two: exact on lattices
        int at = 0;
        for (int a = 0; a < dim; ++a)
            for (int b = a; b < dim; ++b)
                packed[at++] = a == b ? 1 / std::exp2(std::floor(std::log2(axes[a]))) : 0.0;
    } else {
        rotated_tensor(dim, axes, random, packed);
    }
}

void give_supports(Random& random, const Scene& s, const Case& c, double K, ListData& list) {
    const int n = static_cast<int>(list.x.size()) / c.dim;
    const Spread spread = random.pick({Spread::constant, Spread::constant, Spread::factor_four,
                                       Spread::wide, Spread::with_zeros, Spread::one_giant});
    const int giant = random.below(std::max(1, n));
    for (int node = 0; node < n; ++node) {
        const double support = random_support(random, s, spread, node == giant);
        if (!list.tensor) {
            list.h.push_back(scalar_h(support, K, s));
            continue;
        }
        double packed[6];
        random_tensor(random, s, c.dim, support > 0 ? support : s.support, K, packed);
        list.H.insert(list.H.end(), packed, packed + n_symmetric(c.dim));
    }
}

/// All lengths times 2^exponent: nothing else changes, not even a bit.
void change_unit(Case& c, int exponent) {
    const auto scale = [](auto& values, int by) {
        for (double& value : values) value = std::ldexp(value, by);
    };
    for (ListData& list : c.lists)
        scale(list.x, exponent), scale(list.h, exponent), scale(list.H, -exponent);
    scale(c.domain.lo, exponent), scale(c.domain.hi, exponent);
    c.text += ", unit 2^" + std::to_string(exponent);
}

int random_size(Random& random, const CaseKind& kind) {
    if (kind.min_nodes == 0 && random.chance(0.05)) return random.below(4);
    return static_cast<int>(random.log_uniform(std::max(2, kind.min_nodes), kind.max_nodes + 0.99));
}

std::string describe(const Case& c, std::uint64_t seed, const CaseKind& kind, const Scene& s) {
    std::ostringstream text;
    text << "seed " << seed << ", dim " << kind.dim << (kind.periodic ? ", periodic" : ", open")
         << ", sizes " << kind.min_nodes << ".." << kind.max_nodes << ": place "
         << static_cast<int>(s.place) << ", offset " << s.offset[0] << ", mode "
         << static_cast<int>(c.mode) << ", ghost rows " << c.ghost_rows << ", lists";
    for (std::size_t k = 0; k < c.lists.size(); ++k)
        text << " " << c.lists[k].n_internal << "+" << c.n(k) - c.lists[k].n_internal
             << (c.lists[k].tensor ? " H" : " h");
    return text.str();
}

}  // namespace

void rotated_tensor(int dim, const double (&axes)[3], Random& random, double* packed) {
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // rows stay orthonormal
    for (int a = 0; a < dim; ++a)
        for (int b = a + 1; b < dim; ++b) {
            const double angle = random.uniform(0, 6.283185307179586);
            for (int d = 0; d < dim; ++d) {
                const double p = v[a][d], q = v[b][d];
                v[a][d] = std::cos(angle) * p - std::sin(angle) * q;
                v[b][d] = std::sin(angle) * p + std::cos(angle) * q;
            }
        }
    int at = 0;
    for (int i = 0; i < dim; ++i)
        for (int j = i; j < dim; ++j, ++at) {
            packed[at] = 0;
            for (int k = 0; k < dim; ++k) packed[at] += v[k][i] * v[k][j] / axes[k];
        }
}

Case random_case(std::uint64_t seed, const CaseKind& kind) {
    Random random(mix(seed) + static_cast<std::uint64_t>(kind.dim * 2 + kind.periodic));
    Case c;
    c.dim = kind.dim;
    const int mask = kind.periodic ? 1 + random.below((1 << kind.dim) - 1) : 0;
    for (int d = 0; d < kind.dim; ++d)
        c.domain.periodic[static_cast<std::size_t>(d)] = (mask >> d & 1) != 0;
    c.ghost_rows = random.chance(0.3);
    c.mode = random.pick({SearchMode::gather_scatter, SearchMode::gather_scatter,
                          SearchMode::gather_scatter, SearchMode::gather, SearchMode::scatter});
    const int n = random_size(random, kind), n_lists = 1 + random.below(4);
    const Scene scene = random_scene(random, c, n);
    const bool unequal = random.chance(0.3);
    const double extent = random.pick({1.0, 2.0, 2.0, 3.0, 0.75});
    c.lists.resize(static_cast<std::size_t>(n_lists));
    for (ListData& list : c.lists) {
        list.name = std::string(1, static_cast<char>('A' + (&list - c.lists.data())));
        list.extent = unequal ? random.pick({0.5, 1.0, 2.5, 4.0}) : extent;
    }
    const double K = c.kernel_extent();
    for (ListData& list : c.lists) {
        const int share = n_lists == 1          ? n
                          : random.chance(0.25) ? 0
                                                : random.below(2 * n / n_lists + 1);
        place_nodes(random, scene, c, share, list.x);
        list.tensor = random.chance(0.4);
        list.n_internal = random.pick({share, share, random.below(share + 1), 0});
        give_supports(random, scene, c, K, list);
    }
    c.text = describe(c, seed, kind, scene);
    if (random.chance(0.25)) change_unit(c, random.pick({-250, -60, 85, 200, 250}));
    return c;
}

Case cloud(int n, std::uint64_t seed, double h) {
    Random random(seed);
    std::vector<double> x;
    for (int k = 0; k < 3 * n; ++k) x.push_back(random.uniform());
    return uniform_case(3, std::move(x), h);
}

}  // namespace connectivity::test
