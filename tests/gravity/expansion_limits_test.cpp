// SPDX-License-Identifier: BSD-3-Clause
// Laws of expansions and cells at the edge: scales, images, short lists, symmetry, rates of error.
#include <gtest/gtest.h>

#include <limits>

#include "expansion_chains.hpp"

namespace connectivity::test {
namespace {

struct ExpansionLaws : testing::TestWithParam<const ExpansionKernels*> {
    const ExpansionKernels& k = *GetParam();
};

/// Relative error of the potential of a particle on the edge of a cell that faces the other cell.
double error_of_facing(const ExpansionKernels& k, int order, const Vec& d, Real r_from, Real r_to) {
    Cells cells(order);
    const std::int32_t from = cells.add({0, 0, 0}, static_cast<double>(r_from)),
                       to = cells.add(d, static_cast<double>(r_to));
    Cloud source, target;
    source.add(r_from * d, 1);
    target.add((1 - r_to) * d, 1);
    Field field(1);
    k.p2m(order, source.bodies(), cells.cell(from));
    const std::vector<std::int32_t> list{from};
    k.m2l(order, cells.arrays(), list_of(list), cells.cell(to));
    k.l2p(order, cells.cell(to), target.points(), field.out());
    const Real exact = 1 / norm(target.at(0) - source.at(0));
    return static_cast<double>(std::abs(field.p[0] - exact) / exact);
}

TEST_P(ExpansionLaws, the_error_is_the_ratio_of_radii_and_distance_to_the_power_of_order_plus_1) {
    for (const Vec& d : {Vec{0, 0, 1}, Vec{0.6L, 0.48L, -0.64L}})
        for (const Real x : {0.3L, 0.6L, 0.8L})
            for (int order = 1; order <= 20; ++order) {
                const double expected = static_cast<double>(std::pow(x, order + 1));
                EXPECT_NEAR(error_of_facing(k, order, d, x * 0.25L, x * 0.75L), expected,
                            1e-3 * expected + 1e-14)
                    << order;
            }
}

TEST_P(ExpansionLaws, no_scale_of_lengths_matters) {
    for (const int order : {1, 2, 5, 9, 12, 13, 20})
        for (const double unit : {1e-12, 1e12, 1e-70, 1e70}) {
            const Vec d{0.6L, 0.48L, -0.64L};
            Chain a(order, d, 0.4 * unit, 0.3 * unit, unit), b = a, c = a;
            EXPECT_LE(moments_to_points(k, a), round_off) << order << ' ' << unit;
            EXPECT_LE(moments_to_local(k, b), round_off) << order << ' ' << unit;
            EXPECT_LE(particles_to_local(k, c), round_off) << order << ' ' << unit;
        }
}

TEST_P(ExpansionLaws, cells_may_differ_in_size_as_much_as_they_like) {
    for (const int order : {1, 2, 5, 9, 12, 13, 20})
        for (const double small : {1e-7, 1e-20, 1e-100}) {
            const Vec d{0.6L, 0.48L, -0.64L};
            Chain a(order, d, 0.5, small), b(order, d, small, 0.5);
            a.sources = ball(7, {0, 0, 0}, 0.5, 1);
            b.sources = ball(7, {0, 0, 0}, small, 1);
            EXPECT_LE(moments_to_local(k, a), round_off) << order << ' ' << small;
            EXPECT_LE(moments_to_local(k, b), round_off) << order << ' ' << small;
        }
}

TEST_P(ExpansionLaws, a_list_of_any_length_is_the_sum_of_its_entries) {
    for (int order = 1; order <= 20; ++order)
        for (const int n : {0, 1, 2, 7, 8, 9, 17}) {
            Cells cells(order);
            std::vector<std::int32_t> list;
            for (int i = 0; i < n; ++i) {
                const Vec at{3 + Real(i) / 7, Real(i % 3) - 1, Real(i % 5) - 2};
                list.push_back(cells.add(at, 0.5));
                k.p2m(order, ball(3, at, 0.5, 10u + static_cast<unsigned>(i)).bodies(),
                      cells.cell(list.back()));
            }
            const std::int32_t whole = cells.add({0, 0, 0}, 0.5),
                               single = cells.add({0, 0, 0}, 0.5);
            k.m2l(order, cells.arrays(), list_of(list), cells.cell(whole));
            for (const std::int32_t id : list)
                k.m2l(order, cells.arrays(), list_of({id}), cells.cell(single));
            const detail::Expansion a = cells.cell(whole), b = cells.cell(single);
            double largest = 0;
            for (int j = 0; j < detail::n_coefficients(order); ++j)
                largest = std::max(largest, std::abs(b.coefficients[j]));
            for (int j = 0; j < detail::n_coefficients(order); ++j)
                EXPECT_NEAR(a.coefficients[j], b.coefficients[j], 1e-15 * (n + 4) * largest);
            if (n == 0) {
                EXPECT_EQ(a.coefficients[0], 0);
            }
        }
}

TEST_P(ExpansionLaws, an_image_is_the_cell_moved_by_its_shift) {
    std::vector<double> shift(81);
    for (int i = 0; i < 27; ++i)
        for (int a = 0; a < 3; ++a)
            shift[3 * i + a] = 4 * ((a == 0 ? i : a == 1 ? i / 3 : i / 9) % 3 - 1);
    for (const int order : {2, 3, 6, 14}) {
        Cells cells(order);
        std::vector<std::int32_t> list, moved;
        std::vector<std::uint8_t> image;
        for (int i = 0; i < 27; ++i) {
            if (i == 13) continue;
            const Vec at{Real(i) / 27, 0.25L, -0.5L},
                by{shift[3 * i], shift[3 * i + 1], shift[3 * i + 2]};
            const Cloud cloud = ball(3, at, 0.5, 7);
            list.push_back(cells.add(at, 0.5));
            image.push_back(static_cast<std::uint8_t>(i));
            k.p2m(order, cloud.bodies(), cells.cell(list.back()));
            moved.push_back(cells.add(at + by, 0.5));
            std::copy_n(cells.cell(list.back()).coefficients, detail::n_coefficients(order),
                        cells.cell(moved.back()).coefficients);
        }
        const std::int32_t a = cells.add({0, 0, 0}, 0.5), b = cells.add({0, 0, 0}, 0.5);
        const detail::CellList images{list.data(), 26, image.data(), shift.data()};
        k.m2l(order, cells.arrays(), images, cells.cell(a));
        k.m2l(order, cells.arrays(), list_of(moved), cells.cell(b));
        for (int j = 0; j < detail::n_coefficients(order); ++j)
            EXPECT_NEAR(cells.cell(a).coefficients[j], cells.cell(b).coefficients[j], 1e-13);
        const Cloud targets = ball(9, {0, 0, 0}, 0.5, 8);
        Field c(9), d(9);
        k.m2p(order, cells.arrays(), images, targets.points(), c.out());
        k.m2p(order, cells.arrays(), list_of(moved), targets.points(), d.out());
        for (std::size_t i = 0; i < 9; ++i) {
            EXPECT_NEAR(c.p[i], d.p[i], 1e-13);
            EXPECT_NEAR(c.ax[i], d.ax[i], 1e-13);
        }
    }
}

/// Total force on the particles of B from the expansion of A, and the sum of its parts' sizes.
Vec total_force(const ExpansionKernels& k, int order, const Cloud& a, const Cloud& b,
                const std::array<Vec, 2>& centres, const std::array<double, 2>& scales,
                Real& size) {
    Cells cells(order);
    const std::int32_t from = cells.add(centres[0], scales[0]),
                       to = cells.add(centres[1], scales[1]);
    k.p2m(order, a.bodies(), cells.cell(from));
    k.m2l(order, cells.arrays(), list_of({from}), cells.cell(to));
    Field field(b.size());
    k.l2p(order, cells.cell(to), b.points(), field.out());
    Vec total{};
    for (std::size_t i = 0; i < b.x.size(); ++i) {
        const Vec force = Real(b.m[i]) * Vec{field.ax[i], field.ay[i], field.az[i]};
        total = total + force;
        size += norm(force);
    }
    return total;
}

TEST_P(ExpansionLaws, forces_of_two_cells_on_each_other_are_opposite) {
    for (int order = 1; order <= 20; ++order)
        for (const Vec& d : directions()) {
            const Cloud a = ball(13, {0, 0, 0}, 0.5, 1), b = ball(17, d, 0.25, 2);
            Real size = 0;
            const Vec there = total_force(k, order, a, b, {Vec{}, d}, {0.5, 0.25}, size),
                      back = total_force(k, order, b, a, {d, Vec{}}, {0.25, 0.5}, size);
            EXPECT_LE(static_cast<double>(norm(there + back) / size), 2e-15) << order;
        }
}

TEST_P(ExpansionLaws, mass_is_summed_exactly_and_a_constant_field_stays) {
    for (int order = 1; order <= 20; ++order) {
        Cells cells(order);
        std::vector<std::int32_t> children;
        double mass = 0;
        for (int i = 0; i < 11; ++i) {
            const Vec at{Real(i % 3) - 1, Real(i % 2), Real(i) / 5 - 1};
            children.push_back(cells.add(at, 0.5));
            Cloud cloud = ball(9, at, 0.5, 20u + static_cast<unsigned>(i));
            for (double& m : cloud.m) mass += m = std::floor(8 * m);
            k.p2m(order, cloud.bodies(), cells.cell(children.back()));
        }
        const std::int32_t parent = cells.add({0, 0, 0}, 2);
        k.m2m(order, cells.arrays(), list_of(children), cells.cell(parent));
        EXPECT_EQ(cells.cell(parent).coefficients[0], mass);

        std::fill(cells.coefficients.begin(), cells.coefficients.end(), 0.0);
        cells.cell(parent).coefficients[0] = 1;
        k.l2l(order, cells.cell(parent), cells.arrays(), list_of(children),
              cells.coefficients.data());
        const Cloud targets = ball(9, {0, 0, 0}, 0.5, 8);
        for (const std::int32_t child : children) {
            Field field(9);
            k.l2p(order, cells.cell(child), targets.points(), field.out());
            for (std::size_t i = 0; i < 9; ++i) {
                EXPECT_EQ(field.p[i], 1);
                EXPECT_EQ(std::abs(field.ax[i]) + std::abs(field.ay[i]) + std::abs(field.az[i]), 0);
            }
        }
    }
}

TEST_P(ExpansionLaws, a_particle_at_the_centre_and_no_mass_are_fine) {
    for (int order = 1; order <= 20; ++order) {
        Chain c(order, {0.6L, 0.48L, -0.64L}, 0.4, 0.3);
        c.sources = Cloud{};
        c.sources.add({0, 0, 0}, 3);
        c.sources.add({0.1L, 0, 0}, 0);
        c.targets = Cloud{};
        c.targets.add(c.cells.centre(c.to), 1);
        Chain d = c, e = c;
        EXPECT_LE(moments_to_points(k, c), round_off);
        EXPECT_LE(moments_to_local(k, d), round_off);
        EXPECT_LE(particles_to_local(k, e), round_off);
    }
}

TEST_P(ExpansionLaws, what_is_behind_a_row_is_not_used) {
    for (int order = 1; order <= 20; ++order) {
        Chain c(order, {0.6L, 0.48L, -0.64L}, 0.4, 0.3);
        for (const std::int32_t cell : {c.from, c.to})
            std::fill(c.cells.cell(cell).coefficients + detail::n_coefficients(order),
                      c.cells.cell(cell).coefficients + detail::expansion_stride(order),
                      std::numeric_limits<double>::quiet_NaN());
        Chain d = c;
        EXPECT_LE(moments_to_points(k, c), round_off);
        EXPECT_LE(moments_to_local(k, d), round_off);
        for (int j = detail::n_coefficients(order); j < detail::expansion_stride(order); ++j)
            EXPECT_TRUE(std::isnan(d.cells.cell(d.to).coefficients[j]));
    }
}

TEST_P(ExpansionLaws, the_power_of_one_particle_is_its_mass_times_the_powers_of_its_distance) {
    constexpr int order = 20;
    Cells cells(order);
    const std::int32_t c = cells.add({0, 0, 0}, 2);
    Cloud cloud;
    cloud.add({1, -0.5L, 0.75L}, -3);
    k.p2m(order, cloud.bodies(), cells.cell(c));
    double power[order + 1];
    detail::expansion_power(order, cells.cell(c).coefficients, power);
    for (int n = 0; n <= order; ++n) {
        const double expected = static_cast<double>(3 * std::pow(norm(cloud.at(0)) / 2, n));
        EXPECT_NEAR(power[n], expected, 1e-14 * expected);
    }
}

INSTANTIATE_TEST_SUITE_P(all, ExpansionLaws, testing::ValuesIn(all_expansion_kernels()),
                         [](const auto& tested) { return tested.param->name; });

}  // namespace
}  // namespace connectivity::test
