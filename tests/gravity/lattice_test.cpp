// SPDX-License-Identifier: BSD-3-Clause
// The field of far images together with sums over near ones, against Ewald's sum and what is known
// of crystals.

#include <cmath>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <gravity/lattice_field.hpp>
#include <gravity/lattice_wrap.hpp>
#include <support/ewald_brute.hpp>
#include <support/expect_error.hpp>
#include <support/hash.hpp>
#include <support/random.hpp>
#include <support/thread_bits.hpp>

namespace connectivity::test {
namespace {

using detail::LatticeField;
using Vector = std::array<double, 3>;
using Positions = std::vector<double>;  ///< [n][3]

const Vector cube{1, 1, 1}, rod{1, 1, 2}, slab{1, 3, 10}, needle{1, 1, 10};

double volume(const Vector& box) { return box[0] * box[1] * box[2]; }

struct Separate {
    explicit Separate(const Positions& all) {
        for (std::size_t i = 0; i < all.size(); ++i) x[i % 3].push_back(all[i]);
    }
    std::vector<double> x[3];
};

void gather(LatticeField& field, const Positions& y, const std::vector<double>& m) {
    const Separate sources(y);
    field.gather({sources.x[0].data(), sources.x[1].data(), sources.x[2].data(), m.data(),
                  static_cast<std::int64_t>(m.size())});
}

/// What the field adds to 0 at targets.
EwaldSums far_part(LatticeField& field, const Positions& x) {
    const Separate targets(x);
    const std::size_t n = x.size() / 3;
    std::vector<double> p(n), a[3] = {p, p, p};
    field.add({targets.x[0].data(), targets.x[1].data(), targets.x[2].data(),
               static_cast<std::int64_t>(n)},
              {p.data(), a[0].data(), a[1].data(), a[2].data()});
    EwaldSums sums{p, {}};
    for (std::size_t i = 0; i < 3 * n; ++i) sums.a.push_back(a[i % 3][i / 3]);
    return sums;
}

/// Adds the sources' near images, without what is exactly at a target.
void add_near(const LatticeField& field, const Vector& box, const Positions& y,
              const std::vector<double>& m, const Positions& x, EwaldSums& sums) {
    for (std::size_t i = 0; 3 * i < x.size(); ++i) {
        long double p = sums.p[i], a[3];
        for (int d = 0; d < 3; ++d) a[d] = sums.a[3 * i + d];
        for (std::size_t j = 0; j < m.size(); ++j)
            for (const auto& image : field.near_images()) {
                long double r[3], r2 = 0;
                for (int d = 0; d < 3; ++d) {
                    r[d] =
                        y[3 * j + d] + static_cast<long double>(image[d]) * box[d] - x[3 * i + d];
                    r2 += r[d] * r[d];
                }
                if (r2 == 0) continue;
                const long double potential = m[j] / std::sqrt(r2);
                p += potential;
                for (int d = 0; d < 3; ++d) a[d] += potential / r2 * r[d];
            }
        sums.p[i] = static_cast<double>(p);
        for (int d = 0; d < 3; ++d) sums.a[3 * i + d] = static_cast<double>(a[d]);
    }
}

EwaldSums whole(LatticeField& field, const Vector& box, const Positions& y,
                const std::vector<double>& m, const Positions& x) {
    gather(field, y, m);
    EwaldSums sums = far_part(field, x);
    add_near(field, box, y, m, x, sums);
    return sums;
}

/// Largest error of an acceleration, or of a potential, beyond the rounding of what was wanted, in
/// units of what m does at distance V^(1/3).
struct Errors {
    double a = 0, p = 0;
};

Errors errors(const EwaldSums& found, const EwaldSums& wanted, const Vector& box,
              const std::vector<double>& m) {
    double mass = 0;
    for (const double one : m) mass += std::abs(one);
    const double length = std::cbrt(volume(box)), rounding = 4e-16;
    Errors worst;
    for (std::size_t i = 0; i < found.p.size(); ++i) {
        const double *const a = found.a.data() + 3 * i, *const b = wanted.a.data() + 3 * i;
        const double off = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) -
                           rounding * std::hypot(b[0], b[1], b[2]);
        worst.a = std::max(worst.a, off * length * length / mass);
        const double off_p = std::abs(found.p[i] - wanted.p[i]) - rounding * std::abs(wanted.p[i]);
        worst.p = std::max(worst.p, off_p * length / mass);
    }
    return worst;
}

Positions random_positions(const Vector& box, std::size_t n, std::uint64_t seed) {
    Random random(seed);
    Positions x;
    for (std::size_t i = 0; i < 3 * n; ++i) x.push_back(random.uniform(0, box[i % 3]));
    return x;
}

/// Corners, middles of edges and faces, and the points next to the upper ends.
Positions special_positions(const Vector& box) {
    Positions x;
    for (int i = 0; i < 64; ++i) {
        const int digit[3] = {i % 4, i / 4 % 4, i / 16};
        for (int d = 0; d < 3; ++d)
            x.push_back(digit[d] == 0   ? 0
                        : digit[d] == 1 ? box[d] / 2
                        : digit[d] == 2 ? box[d] * 0.98
                                        : std::nextafter(box[d], 0));
    }
    return x;
}

/// In a ball of this radius about the box's corner, on all eight sides of it.
Positions clump_on_corner(const Vector& box, std::size_t n, double radius) {
    Random random(3);
    Positions x;
    for (std::size_t i = 0; i < 3 * n; ++i)
        x.push_back(detail::wrap_into_box(random.uniform(-radius, radius), 0, box[i % 3]));
    return x;
}

class FarAndNear : public ::testing::TestWithParam<std::tuple<Vector, double>> {
protected:
    FarAndNear() { start_runtime(); }
    void expect_accuracy(const Positions& y, const std::vector<double>& m, const Positions& x) {
        const auto [box, accuracy] = GetParam();
        LatticeField field(box, accuracy);
        const Errors found = errors(whole(field, box, y, m, x), ewald_brute(box, y, m, x), box, m);
        EXPECT_LE(found.a, accuracy + 1e-13);
        EXPECT_LE(found.p, accuracy + 1e-13);
    }
    Vector box() const { return std::get<0>(GetParam()); }
};

TEST_P(FarAndNear, are_ewalds_sum_for_random_sources) {
    const Positions y = random_positions(box(), 25, 1);
    std::vector<double> m;
    for (int i = 0; i < 25; ++i) m.push_back(i % 4 == 0 ? 0 : u01(8, i) - 0.3);
    expect_accuracy(y, m, random_positions(box(), 25, 2));
    expect_accuracy(y, m, y);
}

TEST_P(FarAndNear, are_ewalds_sum_for_one_source_in_a_corner) {
    Positions x = special_positions(box());
    x.resize(3 * 63);  // the last one is too close to an image
    expect_accuracy({0, 0, 0}, {1}, random_positions(box(), 40, 3));
    expect_accuracy({box()[0] / 2, 0, box()[2] * 0.999}, {-2}, x);
}

TEST_P(FarAndNear, are_ewalds_sum_for_sources_and_targets_on_faces_and_corners) {
    const Positions y = special_positions(box());
    std::vector<double> m(64, 1);
    m[0] = 0.5;
    // Targets beside faces, but not within rounding of an image.
    Positions x;
    for (int i = 0; i < 64; ++i)
        for (int d = 0; d < 3; ++d)
            x.push_back(std::min(y[3 * i + d] + 0.01 * box()[d], 0.999 * box()[d]));
    expect_accuracy(y, m, x);
}

TEST_P(FarAndNear, are_ewalds_sum_for_a_clump_on_a_corner) {
    const Positions y = clump_on_corner(box(), 25, 0.1 * box()[0]);
    expect_accuracy(y, std::vector<double>(25, 1), random_positions(box(), 25, 4));
    expect_accuracy(y, std::vector<double>(25, 1), clump_on_corner(box(), 10, 0.2 * box()[0]));
}

TEST_P(FarAndNear, are_ewalds_sum_where_expansions_converge_least) {
    // The source in the low corner of a cell, targets in the high corners of all cells.
    const auto grid = detail::plan_lattice(box(), std::get<1>(GetParam())).grid;
    Positions x;
    for (int cell = 0; cell < grid.size(); cell += 1 + grid.size() / 300)
        for (int d = 0; d < 3; ++d) x.push_back((grid.place(cell)[d] + 0.999) * grid.side[d]);
    expect_accuracy({0, 0, 0}, {1}, x);
}

INSTANTIATE_TEST_SUITE_P(Lattice, FarAndNear,
                         ::testing::Combine(::testing::Values(cube, rod, slab, needle),
                                            ::testing::Values(1e-3, 1e-7, 1e-10)));

/// A crystal of n³ cells of ions in the unit cube.
void add_ions(const std::vector<Vector>& in_cell, double charge, int n, Positions& x,
              std::vector<double>& charges) {
    for (int cell = 0; cell < n * n * n; ++cell)
        for (const Vector& at : in_cell) {
            const int place[3] = {cell % n, cell / n % n, cell / (n * n)};
            for (int d = 0; d < 3; ++d) x.push_back((place[d] + at[d]) / n);
            charges.push_back(charge);
        }
}

TEST(LatticeField, gives_the_madelung_constants) {
    start_runtime();
    LatticeField field(cube, 1e-11);
    for (const int n : {1, 2, 3}) {
        Positions x;
        std::vector<double> charges;
        add_ions({{0, 0, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}}, 1, n, x, charges);
        add_ions({{0.5, 0.5, 0.5}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}}, -1, n, x, charges);
        const EwaldSums salt = whole(field, cube, x, charges, x);
        for (std::size_t i = 0; i < charges.size(); ++i)
            ASSERT_NEAR(salt.p[i] * charges[i] / (2 * n), -1.747564594633182190, 1e-10);
        x.clear();
        charges.clear();
        add_ions({{0, 0, 0}}, 1, n, x, charges);
        add_ions({{0.5, 0.5, 0.5}}, -1, n, x, charges);
        const EwaldSums cesium = whole(field, cube, x, charges, x);
        for (std::size_t i = 0; i < charges.size(); ++i)
            ASSERT_NEAR(cesium.p[i] * charges[i] * std::sqrt(0.75) / n, -1.762674773070988, 1e-10);
    }
}

TEST(LatticeField, forces_on_a_perfect_lattice_are_zero) {
    start_runtime();
    for (const Vector& box : {cube, rod, Vector{1, 2, 3}}) {
        LatticeField field(box, 1e-10);
        Positions x;
        const int n = 4;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n * box[1]; ++j)
                for (int k = 0; k < n * box[2]; ++k)
                    x.insert(x.end(), {(i + 0.3) / n, (j + 0.9) / n, k / double(n)});
        const std::vector<double> m(x.size() / 3, 1.0 / static_cast<double>(x.size()));
        const EwaldSums sums = whole(field, box, x, m, x);
        for (const double a : sums.a) ASSERT_NEAR(a, 0, 1e-10);
        for (const double p : sums.p) ASSERT_NEAR(p, -2.8372974794806195 * n * m[0], 1e-10);
    }
}

TEST(LatticeField, shifting_everything_changes_nothing) {
    start_runtime();
    for (const Vector& box : {cube, slab}) {
        const double accuracy = 1e-8;
        LatticeField field(box, accuracy);
        const Positions y = random_positions(box, 30, 6);
        const std::vector<double> m(30, 1);
        const EwaldSums before = whole(field, box, y, m, y);
        for (const double shift : {0.1, 0.5, -7.77, 1234.5}) {
            Positions shifted;
            for (std::size_t i = 0; i < y.size(); ++i)
                shifted.push_back(detail::wrap_into_box(y[i] + shift, 0, box[i % 3]));
            const Errors change = errors(whole(field, box, shifted, m, shifted), before, box, m);
            EXPECT_LE(change.a, 2 * accuracy);
            EXPECT_LE(change.p, 2 * accuracy);
        }
    }
}

TEST(LatticeField, one_particle_feels_its_images_and_the_background) {
    start_runtime();
    LatticeField field(cube, 1e-10);
    for (const Positions& x : {Positions{0, 0, 0}, {0.999, 0, 0.5}, {0.3, 0.4, 0.77}}) {
        const EwaldSums sums = whole(field, cube, x, {2}, x);
        EXPECT_NEAR(sums.p[0], -2 * 2.8372974794806195, 1e-9);
        for (const double a : sums.a) EXPECT_NEAR(a, 0, 2e-10);
    }
}

TEST(LatticeField, no_particles_do_nothing) {
    start_runtime();
    LatticeField field(cube, 1e-6);
    gather(field, {0.1, 0.2, 0.3}, {1});
    gather(field, {}, {});
    const EwaldSums sums = far_part(field, {0.5, 0.5, 0.5});
    EXPECT_EQ(sums.p[0], 0);
    EXPECT_EQ(sums.a, std::vector<double>(3, 0));
    EXPECT_TRUE(far_part(field, {}).p.empty());
}

TEST(LatticeField, is_added_to_what_is_there) {
    start_runtime();
    LatticeField field(cube, 1e-6);
    gather(field, {0.1, 0.2, 0.3}, {1});
    const double x = 0.9, y = 0.6, z = 0.4;
    const EwaldSums once = far_part(field, {x, y, z});
    double p = 100, ax = 200, ay = 300, az = 400;
    field.add({&x, &y, &z, 1}, {&p, &ax, &ay, &az});
    EXPECT_NEAR(p, 100 + once.p[0], 1e-12);
    EXPECT_NEAR(ax, 200 + once.a[0], 1e-12);
    EXPECT_NEAR(ay, 300 + once.a[1], 1e-12);
    EXPECT_NEAR(az, 400 + once.a[2], 1e-12);
}

TEST(LatticeField, has_no_scale) {
    start_runtime();
    for (const double length : {1e-12, 1e-3, 1e12}) {
        const Vector box{length, 2 * length, length};
        LatticeField field(box, 1e-9);
        const Positions y = random_positions(box, 20, 6), x = random_positions(box, 20, 7);
        const std::vector<double> m(20, 1e20);
        const Errors found = errors(whole(field, box, y, m, x), ewald_brute(box, y, m, x), box, m);
        EXPECT_LE(found.a, 1e-9);
        EXPECT_LE(found.p, 1e-9);
    }
}

TEST(LatticeField, conserves_momentum_to_rounding) {
    start_runtime();
    for (const Vector& box : {cube, rod, slab}) {
        LatticeField field(box, 1e-4);
        const Positions y = random_positions(box, 3000, 11);
        std::vector<double> m;
        for (int i = 0; i < 3000; ++i) m.push_back(u01(12, i));
        gather(field, y, m);
        const EwaldSums sums = far_part(field, y);
        double total[3] = {}, sum = 0;
        for (std::size_t i = 0; i < sums.a.size(); ++i) {
            total[i % 3] += m[i / 3] * sums.a[i];
            sum += std::abs(m[i / 3] * sums.a[i]);
        }
        for (const double one : total) EXPECT_LE(std::abs(one), 1e-14 * sum);
    }
}

TEST(LatticeField, a_second_solution_of_the_same_size_allocates_nothing) {
    start_runtime();
    LatticeField field(rod, 1e-5);
    const std::vector<double> m(40000, 1);
    gather(field, random_positions(rod, 40000, 1), m);
    far_part(field, random_positions(rod, 40000, 2));
    const Offset bytes = field.bytes();
    EXPECT_GT(bytes, 40000 * 6);
    gather(field, random_positions(rod, 40000, 3), m);
    far_part(field, random_positions(rod, 40000, 4));
    EXPECT_EQ(field.bytes(), bytes);
}

TEST(LatticeField, refuses_boxes_that_are_none_or_too_long) {
    start_runtime();
    const auto make = [](const Vector& box, double accuracy) {
        return [=] { LatticeField(box, accuracy); };
    };
    const double nan = std::nan("");
    EXPECT_TRUE(fails_with(Status::box, {"side 1", "0", "> 0"}, make({1, 0, 1}, 1e-6)));
    EXPECT_TRUE(fails_with(Status::box, {"side 0", "nan"}, make({nan, 1, 1}, 1e-6)));
    EXPECT_TRUE(fails_with(Status::box, {"side 2", "inf"}, make({1, 1, HUGE_VAL}, 1e-6)));
    EXPECT_TRUE(fails_with(Status::box, {"10.5", "at most 10"}, make({1, 10.5, 1}, 1e-6)));
    EXPECT_TRUE(fails_with(Status::argument, {"accuracy", "at least"}, make(cube, 1e-13)));
    EXPECT_TRUE(fails_with(Status::argument, {"accuracy", "nan"}, make(cube, nan)));
}

TEST(LatticeField, near_images_come_with_their_opposites_and_all_neighbours) {
    for (const Vector& box : {cube, rod, slab, needle, Vector{10, 1, 10}, Vector{2, 5, 3}})
        for (const double accuracy : {1e-3, 1e-7, 1e-12}) {
            const auto near = detail::plan_lattice(box, accuracy).near;
            EXPECT_EQ(near[0], (std::array<int, 3>{0, 0, 0}));
            EXPECT_LE(near.size(), std::size_t{detail::max_near_images});
            const auto has = [&near](int i, int j, int k) {
                return std::count(near.begin(), near.end(), std::array<int, 3>{i, j, k}) == 1;
            };
            for (const auto& image : near) EXPECT_TRUE(has(-image[0], -image[1], -image[2]));
            for (int i = 0; i < 27; ++i) EXPECT_TRUE(has(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
        }
}

TEST(LatticeBits, print) {
    start_runtime();
    Fnv1a hash;
    for (const Vector& box : {cube, slab}) {
        LatticeField field(box, 1e-5);
        const std::size_t n = 50000;
        gather(field, random_positions(box, n, 1), std::vector<double>(n, 1.0 / 3));
        const EwaldSums sums = far_part(field, random_positions(box, n, 2));
        for (const auto* const part : {&sums.p, &sums.a}) hash.add_view(*part);
    }
    print_fingerprint(hash.value());
}

TEST(LatticeBits, one_two_and_three_threads_agree) {
    expect_same_bits_with_one_two_and_three_threads("LatticeBits.print");
}

}  // namespace
}  // namespace connectivity::test
