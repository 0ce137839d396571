// SPDX-License-Identifier: BSD-3-Clause
// Nodes exactly on the boundary of a support: the relation is closed, symmetric, and counts equal
// exact integers.

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/random.hpp>

namespace connectivity::test {
namespace {

/// Pairs of a case in every method; all methods must agree, every row must be answered.
Offset count_pairs(const Case& c) {
    Offset n_pairs = -1;
    for (const SearchMethod method : all_methods) {
        ConnectivityMap map;
        rebuild(map, c, method);
        const auto rows = map.rows();
        Offset asymmetric = 0;
        for (Offset i = 0; i < rows.n_rows(); ++i)
            for (const Slot j : rows[i])
                asymmetric +=
                    !std::binary_search(rows[j].begin(), rows[j].end(), static_cast<Slot>(i));
        EXPECT_EQ(asymmetric, 0) << name_of(method);
        EXPECT_EQ(rows.size(), 2 * map.pairs().size()) << name_of(method);
        EXPECT_TRUE(n_pairs < 0 || n_pairs == map.pairs().size()) << name_of(method);
        n_pairs = map.pairs().size();
    }
    return n_pairs;
}

/// Where an exact lattice may lie without losing a bit, and in which order its nodes come.
struct Placing {
    double spacing = 1, offset = 0;
    bool shuffled = false;
};

const Placing placings[] = {
    {1, 0, false}, {1, 0, true}, {1, 1024, true}, {0x1p-10, 0, true}, {0x1p-10, -512, true}};

/// 8^3 lattice; diagonal(z) is the diagonal of H for layer z, in units of the inverse spacing.
template <class Diagonal>
Case lattice(const Placing& placing, double grow, const Diagonal& diagonal) {
    std::vector<int> order(512);
    std::iota(order.begin(), order.end(), 0);
    Random random(5);
    for (int k = 511; placing.shuffled && k > 0; --k)
        std::swap(order[static_cast<std::size_t>(k)],
                  order[static_cast<std::size_t>(random.below(k + 1))]);
    std::vector<double> x, H;
    for (const int node : order) {
        const int at[3] = {node % 8, node / 8 % 8, node / 64};
        const std::array<double, 3> h = diagonal(at[2]);
        for (const int k : at) x.push_back(placing.offset + placing.spacing * k);
        for (const double component : {h[0], 0.0, 0.0, h[1], 0.0, h[2]})
            H.push_back(component * grow / placing.spacing);
    }
    return tensor_case(3, x, H, 1);
}

/// The same with scalar supports of radius `radius` spacings.
Case scalar_lattice(const Placing& placing, double radius) {
    Case c = lattice(placing, 1, [](int) { return std::array{1.0, 1.0, 1.0}; });
    c.lists[0].tensor = false;
    c.lists[0].H.clear();
    c.lists[0].h.assign(512, radius * placing.spacing);
    return c;
}

void make_periodic(Case& c, const Placing& placing) {
    c.domain.periodic = {true, true, true};
    c.domain.lo = {placing.offset, placing.offset, placing.offset};
    for (double& end : c.domain.hi) end = placing.offset + 8 * placing.spacing;
}

const double a_bit_more = std::nextafter(1.0, 2.0), a_bit_less = std::nextafter(1.0, 0.0);

TEST(BoundaryLattice, open_with_radius_two_has_6220_pairs_and_5068_inside) {
    const auto half = [](int) { return std::array{0.5, 0.5, 0.5}; };
    for (const Placing& placing : placings) {
        EXPECT_EQ(count_pairs(lattice(placing, 1, half)), 6220);
        EXPECT_EQ(count_pairs(lattice(placing, a_bit_more, half)), 5068);
        EXPECT_EQ(count_pairs(scalar_lattice(placing, 2)), 6220);
        EXPECT_EQ(count_pairs(scalar_lattice(placing, 2 * a_bit_less)), 5068);
    }
}

TEST(BoundaryLattice, periodic_with_radius_two_has_8192_pairs_and_6656_inside) {
    const auto half = [](int) { return std::array{0.5, 0.5, 0.5}; };
    for (const Placing& placing : placings)
        for (const bool images : {false, true})
            for (const double radius : {2.0, 2 * a_bit_less}) {
                Case tensor = lattice(placing, radius < 2 ? a_bit_more : 1, half),
                     scalar = scalar_lattice(placing, radius);
                Random random(6);
                for (Case* c : {&tensor, &scalar}) {
                    make_periodic(*c, placing);
                    for (double& x : c->lists[0].x)
                        x += images ? 8 * placing.spacing * (random.below(9) - 4) : 0;
                    EXPECT_EQ(count_pairs(*c), radius < 2 ? 6656 : 8192);
                }
            }
}

TEST(BoundaryLattice, layers_of_two_supports_have_9048_pairs_and_7960_inside) {
    const auto layers = [](int z) {
        const double h = z % 2 == 1 ? 0.5 : 0.25;
        return std::array{0.5, 0.5, h};
    };
    for (const Placing& placing : placings) {
        EXPECT_EQ(count_pairs(lattice(placing, 1, layers)), 9048);
        EXPECT_EQ(count_pairs(lattice(placing, a_bit_more, layers)), 7960);
    }
}

TEST(BoundaryLattice, needles_of_a_million_to_one_have_11712_pairs_and_11008_inside) {
    const auto needle = [](int) { return std::array{1.0, 0.25, 0x1p-20}; };
    for (const Placing& placing : placings) {
        EXPECT_EQ(count_pairs(lattice(placing, 1, needle)), 11712);
        EXPECT_EQ(count_pairs(lattice(placing, a_bit_more, needle)), 11008);
    }
}

TEST(BoundaryLattice, integer_positions_agree_with_integer_arithmetic) {
    Random random(7);
    for (int round = 0; round < 5; ++round) {
        std::vector<double> x, h;
        for (int k = 0; k < 3 * 700; ++k) x.push_back(random.below(24));
        for (int k = 0; k < 700; ++k) h.push_back(random.below(6));
        Offset wanted = 0;
        for (std::size_t i = 0; i < 700; ++i)
            for (std::size_t j = i + 1; j < 700; ++j) {
                long r2 = 0;
                for (std::size_t d = 0; d < 3; ++d) {
                    const long r = std::lround(x[3 * i + d]) - std::lround(x[3 * j + d]);
                    r2 += r * r;
                }
                const long reach = std::lround(std::max(h[i], h[j]));
                wanted += reach > 0 && r2 <= reach * reach;
            }
        EXPECT_EQ(count_pairs(scalar_case(3, x, h, 1)), wanted);
    }
}

/// Periodic lattice whose spacing is no binary fraction, anywhere: of the pairs two spacings apart,
/// rounding includes some. The counts are those of differences wrapped in double, found
/// independently.
TEST(BoundaryPeriodic, both_ends_of_every_pair_agree_although_rounding_decides) {
    struct Row {
        int n;
        double offset;
        Offset included;
    };
    for (const auto& [n, offset, included] :
         {Row{20, 0, 18000}, Row{20, 0.3, 12000}, Row{20, 1000.1, 4800}, Row{23, 0, 25392},
          Row{23, 0.3, 25392}, Row{23, 1000.1, 34914}}) {
        std::vector<double> x;
        for (int k = 0; k < n * n * n; ++k)
            for (const int at : {k % n, k / n % n, k / (n * n)})
                x.push_back(offset + static_cast<double>(at) / n);
        Case c = uniform_case(3, x, 1.0 / n, 2);
        c.domain.periodic = {true, true, true};
        c.domain.hi = {1, 1, 1};
        const Offset inside =
            Offset{13} * n * n * n;  // distances 1, sqrt 2 and sqrt 3: 3 + 6 + 4 a node
        for (const SearchMethod method :
             {SearchMethod::cells, SearchMethod::groups, SearchMethod::automatic}) {
            ConnectivityMap map;
            rebuild(map, c, method);
            const auto rows = map.rows();
            Offset asymmetric = 0;
            for (Offset i = 0; i < rows.n_rows(); ++i)
                for (const Slot j : rows[i])
                    asymmetric +=
                        !std::binary_search(rows[j].begin(), rows[j].end(), static_cast<Slot>(i));
            EXPECT_EQ(asymmetric, 0) << n << " " << offset << " " << name_of(method);
            EXPECT_EQ(map.pairs().size() - inside, included)
                << n << " " << offset << " " << name_of(method);
        }
    }
}

}  // namespace
}  // namespace connectivity::test
