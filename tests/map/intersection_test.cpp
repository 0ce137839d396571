// SPDX-License-Identifier: BSD-3-Clause
// Rows of common neighbours of pairs equal their definition: all of them or those between the two.

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <support/random.hpp>
#include <support/random_case.hpp>

#include "map/intersection.hpp"

#include "label_case.hpp"

namespace connectivity::test {
namespace {

/// The definition for two slots, ascending by label. The line goes from the smaller label.
std::vector<Slot> expected_row(const LabelCase& c, Slot i, Slot j, bool in_segment) {
    if (c.label(i) > c.label(j)) std::swap(i, j);
    std::vector<Slot> row;
    for (const Slot k : c.sight().intersection(i, j))
        if (!in_segment || k == i || k == j || is_in_segment(c.source(), i, j, k)) row.push_back(k);
    return c.by_label(row);
}

template <int Dim>
struct Problem {
    Problem(const LabelCase& source, bool in_segment, const Slot* order = nullptr)
        : c(source),
          rows(c.neighbours()),
          half_rows(c.half_rows()),
          positions(c.positions()),
          labels(c.labels()),
          input{rows.view(),
                half_rows.view(),
                positions.data(),
                periods<Dim>(c.source().domain),
                in_segment,
                labels,
                order} {}
    Problem(const Problem&) = delete;

    const LabelCase& c;
    OwnedRows rows, half_rows;
    std::vector<double> positions;
    Labels labels;
    IntersectionInput<Dim> input;
};

template <int Dim>
::testing::AssertionResult every_row_is_right(const Problem<Dim>& p, const Csr& csr) {
    const auto n_pairs = static_cast<Offset>(p.half_rows.values.size());
    if (csr.n_rows() != n_pairs)
        return ::testing::AssertionFailure() << csr.n_rows() << " rows of " << n_pairs << " pairs";
    for (Slot a = 0; a < p.c.sight().n(); ++a)
        for (Offset k = p.half_rows.offsets[static_cast<std::size_t>(a)];
             k < p.half_rows.offsets[static_cast<std::size_t>(a) + 1]; ++k) {
            const Slot i = p.labels.slot(a),
                       j = p.labels.slot(p.half_rows.values[static_cast<std::size_t>(k)]);
            const std::vector<Slot> got(csr.values().data() + csr.offsets()(k),
                                        csr.values().data() + csr.offsets()(k + 1));
            const std::vector<Slot> want = expected_row(p.c, i, j, p.input.in_segment);
            if (got != want)
                return ::testing::AssertionFailure()
                       << "slots " << i << ", " << j << ": " << ::testing::PrintToString(got)
                       << " instead of " << ::testing::PrintToString(want);
        }
    return ::testing::AssertionSuccess();
}

template <class Dimension>
class Intersection : public ::testing::Test {
protected:
    static constexpr int dimension = Dimension::value;
    Intersection() { start_runtime(); }

    void check(const Problem<dimension>& p) {
        const Offset bytes = build_.prepare(p.input, rows_);
        rows_.reserve();
        build_.commit(rows_);
        EXPECT_EQ(bytes, rows_.n_values() * 4 + (rows_.n_rows() + 1) * 8);
        ASSERT_TRUE(every_row_is_right(p, rows_)) << p.c.source().text;
    }

    IntersectionBuild<dimension> build_;
    Csr rows_;
};

using Dimensions = ::testing::Types<std::integral_constant<int, 1>, std::integral_constant<int, 2>,
                                    std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Intersection, Dimensions);

TYPED_TEST(Intersection, rows_of_random_cases_equal_the_definition) {
    constexpr int dim = TypeParam::value;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        const LabelCase c(all_rows_case(seed, dim, seed % 2 == 1, 60),
                          seed % 4 < 2 ? Numbering::by_slot : Numbering::at_random, random);
        const std::vector<Slot> order = c.random_order(random);
        this->check(Problem<dim>(c, seed % 3 > 0, seed % 5 < 2 ? order.data() : nullptr));
        if (this->HasFatalFailure()) return;
    }
}

TYPED_TEST(Intersection, one_long_row_and_many_short_ones_equal_the_definition) {
    constexpr int dim = TypeParam::value;
    Random random(5);
    for (const int giant : {0, 700, 1399}) {
        std::vector<double> x, h(1400, 0.02);
        for (std::size_t k = 0; k < h.size() * dim; ++k) x.push_back(random.uniform());
        if (dim == 1) h.assign(h.size(), 0.002);
        h[static_cast<std::size_t>(giant)] = 10;
        const LabelCase c(scalar_case(dim, x, h), Numbering::by_slot, random);
        for (const bool in_segment : {false, true}) this->check(Problem<dim>(c, in_segment));
    }
}

TYPED_TEST(Intersection, a_change_of_units_changes_nothing) {
    constexpr int dim = TypeParam::value;
    Random random(7);
    std::vector<double> x;
    for (int k = 0; k < 40 * dim; ++k) x.push_back(random.uniform());
    const LabelCase c(uniform_case(dim, x, 0.4), Numbering::by_slot, random);
    Problem<dim> p(c, true);
    this->check(p);
    const std::vector<double> unscaled = p.positions;
    for (const int exponent : {-1000, -540, 540, 1000}) {
        for (std::size_t k = 0; k < unscaled.size(); ++k)
            p.positions[k] = std::ldexp(unscaled[k], exponent);
        this->check(p);
    }
}

}  // namespace
}  // namespace connectivity::test
