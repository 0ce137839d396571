// SPDX-License-Identifier: BSD-3-Clause
// Bad input ends in an error that names the first offending list and node, and the map stays as it
// was.

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random.hpp>

namespace connectivity::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
const double signalling = std::numeric_limits<double>::signaling_NaN();

ListData random_list(const std::string& name, int dim, bool tensor, Random& random) {
    ListData list;
    list.name = name;
    list.tensor = tensor;
    list.n_internal = 50;
    for (int k = 0; k < 60 * dim; ++k) list.x.push_back(random.uniform());
    for (int k = 0; k < 60; ++k) {
        if (!tensor) list.h.push_back(0.1);
        for (int a = 0; tensor && a < dim; ++a)
            for (int b = a; b < dim; ++b) list.H.push_back(a == b ? 10.0 : 1.0);
    }
    return list;
}

/// Scalar, tensor and again scalar nodes; the middle list has 60 nodes.
Case three_lists(int dim) {
    Random random(7);
    Case c;
    c.dim = dim;
    c.lists = {random_list("gas", dim, false, random), random_list("dust", dim, true, random),
               random_list("wall", dim, false, random)};
    return c;
}

/// A map with a known content, and the proof that a failed rebuild changed nothing of it.
class BadInput : public ::testing::TestWithParam<int> {
protected:
    void SetUp() override {
        good_ = three_lists(dim());
        expected_ = brute_force(good_);
        rebuild(map_, good_);
        ASSERT_TRUE(equals(map_, expected_));
        generation_ = map_.generation();
        data_ = map_.rows().data();
    }

    int dim() const { return GetParam(); }

    void refuses(const Case& bad, Status status, const std::vector<std::string>& words) {
        for (const SearchMethod method : all_methods)
            EXPECT_TRUE(fails_with(status, words, [&] { rebuild(map_, bad, method); }));
        EXPECT_TRUE(equals(map_, expected_));
        EXPECT_EQ(map_.generation(), generation_);
        EXPECT_EQ(map_.rows().data(), data_);
        EXPECT_EQ(map_.dim(), dim());
        rebuild(map_, good_);
        EXPECT_TRUE(equals(map_, expected_));
        generation_ = map_.generation();
        data_ = map_.rows().data();
    }

    Case good_;
    Expected expected_;
    ConnectivityMap map_;
    Generation generation_ = 0;
    const Slot* data_ = nullptr;
};

TEST_P(BadInput, a_position_that_is_not_finite_is_named) {
    for (const double value : {nan, inf, -inf, signalling})
        for (std::size_t list = 0; list < 3; ++list)
            for (const int node : {0, 17, 59}) {
                Case bad = good_;
                const int axis = dim() - 1;
                bad.lists[list].x[static_cast<std::size_t>(node * dim() + axis)] = value;
                if (node == 17)  // a later one must not hide the first
                    bad.lists[2].x[static_cast<std::size_t>(59 * dim())] = nan;
                refuses(
                    bad, Status::nonfinite,
                    {"list " + std::to_string(list), bad.lists[list].name,
                     "node " + std::to_string(node), "[" + std::to_string(axis) + "]", "finite"});
            }
}

TEST_P(BadInput, a_smoothing_length_below_zero_or_not_finite_is_named) {
    for (const double value : {-1e-300, -1.0, nan, inf, -inf, signalling})
        for (const std::size_t list : {std::size_t{0}, std::size_t{2}})
            for (const int node : {0, 33, 59}) {
                Case bad = good_;
                bad.lists[list].h[static_cast<std::size_t>(node)] = value;
                refuses(bad, Status::support,
                        {"list " + std::to_string(list), bad.lists[list].name,
                         "node " + std::to_string(node), "h = "});
            }
}

TEST_P(BadInput, a_tensor_that_is_not_positive_definite_is_named) {
    const int size = n_symmetric(dim());
    const int last = size - 1, first = 0;
    struct Fault {
        int component;
        double value;
    };
    for (const auto& [component, value] :
         {Fault{last, 0.0}, Fault{last, -1.0}, Fault{first, 0.0}, Fault{first, -1.0},
          Fault{first, nan}, Fault{last, inf}, Fault{last, -inf}})
        for (const int node : {0, 5, 59}) {
            Case bad = good_;
            bad.lists[1].H[static_cast<std::size_t>(node * size + component)] = value;
            refuses(bad, Status::not_spd,
                    {"list 1", "dust", "node " + std::to_string(node), "H = "});
        }
}

TEST_P(BadInput, the_first_node_and_the_number_of_offenders_are_told) {
    Case bad = good_;
    for (const std::size_t node : {std::size_t{41}, std::size_t{12}, std::size_t{58}})
        bad.lists[2].h[node] = -2;
    refuses(bad, Status::support, {"node 12", "-2", "3 such nodes"});
}

TEST_P(BadInput, a_box_that_is_inverted_empty_or_not_finite_is_refused) {
    for (int axis = 0; axis < dim(); ++axis)
        for (const auto& [lo, hi] :
             {std::pair{1.0, 0.0}, {1.0, 1.0}, {0.0, inf}, {-inf, 0.0}, {nan, 1.0}, {0.0, nan}}) {
            Case bad = good_;
            bad.domain.periodic[static_cast<std::size_t>(axis)] = true;
            bad.domain.lo[static_cast<std::size_t>(axis)] = lo;
            bad.domain.hi[static_cast<std::size_t>(axis)] = hi;
            refuses(bad, Status::box, {"axis " + std::to_string(axis)});
        }
}

TEST_P(BadInput, an_open_axis_needs_no_box) {
    Case c = good_;
    c.domain.lo = {1, 1, 1};
    c.domain.hi = {0, nan, -inf};
    rebuild(map_, c);
    EXPECT_TRUE(equals(map_, expected_));
}

TEST_P(BadInput, a_support_over_half_a_periodic_axis_is_named) {
    for (int axis = 0; axis < dim(); ++axis) {
        Case bad = good_;
        bad.domain.periodic[static_cast<std::size_t>(axis)] = true;
        bad.domain.hi[static_cast<std::size_t>(axis)] = 1;
        bad.lists[0].h[23] = std::nextafter(0.25, 1.0);  // K = 2
        refuses(bad, Status::half_box, {"list 0", "gas", "node 23", "0.5"});
    }
}

TEST_P(BadInput, a_call_without_lists_or_with_mixed_dimensions_is_refused) {
    EXPECT_TRUE(fails_with(Status::argument, {"list"}, [&] { map_.rebuild({}, {}); }));
    Case other = three_lists(dim() % 3 + 1);
    std::vector<NodeList> lists = node_lists(good_), others = node_lists(other);
    lists.push_back(others[0]);
    EXPECT_TRUE(fails_with(Status::argument, {"list 3", "dim"}, [&] { map_.rebuild(lists, {}); }));
    EXPECT_TRUE(equals(map_, expected_));
}

TEST_P(BadInput, pairs_of_gather_or_scatter_do_not_exist) {
    for (const SearchMode mode : {SearchMode::gather, SearchMode::scatter}) {
        MapOptions options = map_options(good_);
        options.mode = mode;
        EXPECT_TRUE(fails_with(Status::argument, {"pairs"},
                               [&] { map_.rebuild(node_lists(good_), options); }));
    }
    EXPECT_TRUE(equals(map_, expected_));
}

INSTANTIATE_TEST_SUITE_P(Dim, BadInput, ::testing::Values(1, 2, 3));

TEST(BadTensor, those_with_a_positive_determinant_are_refused_too) {
    const std::vector<std::vector<double>> tensors = {
        {-1, 0, 0, -1, 0, 1}, {1, 0, 0, 1, 0, 0}, {1, 0, 0, 1, 0, -1}, {1, 0, 0, nan, 0, 1},
        {1, 2, 0, 1, 0, 1},   {1, 0, 0, 1, 1, 1}, {0, 0, 0, 0, 0, 0},  {-1, 0, 0, -1, 0, -1}};
    for (const auto& tensor : tensors) {
        Case c = tensor_case(3, {0, 0, 0, 1, 0, 0}, {1, 0, 0, 1, 0, 1});
        c.lists[0].H.insert(c.lists[0].H.end(), tensor.begin(), tensor.end());
        ConnectivityMap map;
        EXPECT_TRUE(fails_with(Status::not_spd, {"node 1"}, [&] { rebuild(map, c); }));
    }
}

TEST(HalfBox, a_support_of_exactly_half_the_box_is_legal) {
    for (const double h : {0.25, 0.2, 0.3, 1.0, 3.0})  // K h = L / 2
        for (int dim = 1; dim <= 3; ++dim) {
            Case c =
                uniform_case(dim, std::vector<double>(static_cast<std::size_t>(2 * dim), 0.0), h);
            c.domain.periodic = {true, true, true};
            c.domain.hi = {4 * h, 4 * h, 4 * h};
            c.lists[0].x[0] = 2 * h;
            ConnectivityMap map;
            rebuild(map, c);
            EXPECT_EQ(map.pairs().size(), 1);
        }
}

TEST(HalfBox, the_same_holds_for_a_diagonal_tensor) {
    for (const double H : {0.5, 1.0, 2.0, 4.0, 8.0}) {  // half axis K / H = L / 2
        Case c = tensor_case(3, {0, 0, 0, 1 / H, 0, 0}, {H, 0, 0, H, 0, H, H, 0, 0, H, 0, H});
        c.domain.periodic = {true, true, true};
        c.domain.hi = {2 / H, 2 / H, 2 / H};
        ConnectivityMap map;
        EXPECT_NO_THROW(rebuild(map, c)) << H;
        EXPECT_EQ(map.pairs().size(), 1);
        c.domain.hi[1] = 2 / H * (1 - 1e-9);
        EXPECT_TRUE(fails_with(Status::half_box, {"node 0"}, [&] { rebuild(map, c); }));
    }
}

TEST(HalfBox, a_tilted_needle_is_measured_along_the_axis) {
    const auto needle =
        [](double length) {  // half axes `length` along the diagonal and 1e-3 across
            const double mean = 0.5 * (1 / length + 1e3), half = 0.5 * (1 / length - 1e3);
            Case c = tensor_case(2, {0.1, 0.1, 0.55, 0.55, 0.8, 0.3}, {}, 1);
            for (int node = 0; node < 3; ++node)
                for (const double component : {mean, half, mean}) c.lists[0].H.push_back(component);
            c.domain.periodic = {true, true, false};
            c.domain.hi = {1, 1, 0};
            return c;
        };
    ConnectivityMap map;
    rebuild(map, needle(0.70));  // 0.70 / sqrt(2) = 0.495
    EXPECT_TRUE(equals(map, brute_force(needle(0.70))));
    EXPECT_EQ(map.pairs().size(), 1);
    EXPECT_TRUE(fails_with(Status::half_box, {"node 0"}, [&] { rebuild(map, needle(0.72)); }));
}

TEST(NodeListShape, disagreeing_sizes_are_refused) {
    const std::vector<double> x(12, 0.0), h(4, 1.0), H(24, 1.0);
    const auto view = [](const std::vector<double>& v, std::size_t n) {
        return ConstView<double>(v.data(), n);
    };
    const auto scalar = [&](int dim, Offset n_internal, std::size_t nx, std::size_t nh, double K) {
        return NodeList::with_h("gas", dim, n_internal, view(x, nx), view(h, nh), K);
    };
    EXPECT_NO_THROW(scalar(3, 4, 12, 4, 2));
    EXPECT_NO_THROW(NodeList::with_H("gas", 3, 4, view(x, 12), view(H, 24), 2));
    const std::vector<std::function<NodeList()>> bad = {
        [&] { return scalar(0, 4, 12, 4, 2); },
        [&] { return scalar(4, 3, 12, 3, 2); },
        [&] { return scalar(-1, 4, 12, 4, 2); },
        [&] { return scalar(3, 4, 11, 4, 2); },
        [&] { return scalar(3, 3, 12, 3, 2); },
        [&] { return scalar(3, 5, 12, 4, 2); },
        [&] { return scalar(3, -1, 12, 4, 2); },
        [&] { return scalar(3, 4, 12, 4, 0); },
        [&] { return scalar(3, 4, 12, 4, -1); },
        [&] { return scalar(3, 4, 12, 4, nan); },
        [&] { return scalar(3, 4, 12, 4, inf); },
        [&] { return NodeList::with_H("gas", 3, 4, view(x, 12), view(H, 12), 2); },
        [&] { return NodeList::with_H("gas", 2, 4, view(x, 12), view(H, 24), 2); },
    };
    for (const auto& make : bad) EXPECT_TRUE(fails_with(Status::argument, {"gas"}, make));
}

}  // namespace
}  // namespace connectivity::test
