// SPDX-License-Identifier: BSD-3-Clause
// Planes and boundaries that cannot be, and what they leave behind.

#include <gtest/gtest.h>

#include <boundary/clouds.hpp>
#include <support/expect_error.hpp>

namespace connectivity::test {
namespace {

const std::vector<double> origin{0, 0, 0}, x_axis{1, 0, 0};

TEST(Plane, its_normal_has_length_one_whatever_was_given) {
    const Plane plane(3, std::vector<double>{1, 2, 3}, std::vector<double>{0, 3e200, 4e200});
    EXPECT_DOUBLE_EQ(plane.normal()[1], 0.6);
    EXPECT_DOUBLE_EQ(plane.normal()[2], 0.8);
    const double x[3] = {7, 2 + 0.6 * 5, 3 + 0.8 * 5};
    EXPECT_NEAR(plane.distance<3>(x), 5, 1e-14);
}

TEST(Plane, bad_values_are_refused) {
    const auto refused = [](const std::vector<double>& point, const std::vector<double>& normal,
                            const std::vector<std::string>& words) {
        return fails_with(Status::argument, words, [&] { Plane(3, point, normal); });
    };
    EXPECT_TRUE(refused(origin, {0, 0, 0}, {"plane", "normal", "length 0"}));
    EXPECT_TRUE(refused(origin, {0, NAN, 1}, {"normal[1]", "nan"}));
    EXPECT_TRUE(refused({0, 0, HUGE_VAL}, x_axis, {"point[2]", "inf"}));
    EXPECT_TRUE(refused({0, 0}, x_axis, {"point", "2 components", "3"}));
    EXPECT_TRUE(fails_with(Status::argument, {"dim = 4"}, [] { Plane(4, origin, x_axis); }));
}

TEST(Boundary, periodic_planes_must_be_parallel_and_face_each_other) {
    const Plane lower(3, origin, x_axis);
    const Plane slanted(3, std::vector<double>{1, 0, 0}, std::vector<double>{-1, 1e-9, 0});
    const Plane same(3, std::vector<double>{1, 0, 0}, x_axis);
    const Plane behind(3, std::vector<double>{-1, 0, 0}, std::vector<double>{-1, 0, 0});
    const auto refused = [&](const Plane& other, const std::vector<std::string>& words) {
        return fails_with(Status::argument, words, [&] { Boundary::periodic("b", lower, other); });
    };
    EXPECT_TRUE(refused(slanted, {"\"b\"", "not parallel"}));
    EXPECT_TRUE(refused(same, {"\"b\"", "face each other", "same way"}));
    EXPECT_TRUE(refused(behind, {"\"b\"", "face each other", "-1"}));
    EXPECT_TRUE(
        refused(Plane(2, std::vector<double>{1, 0}, std::vector<double>{-1, 0}), {"dim 3 and 2"}));
}

TEST(Boundary, the_same_side_cannot_be_bounded_twice) {
    Box box;
    Boundaries boundaries(3);
    add_periodic(boundaries, box, 0);
    EXPECT_TRUE(fails_with(Status::argument, {"\"wall\"", "\"axis 0\"", "same way"}, [&] {
        boundaries.add(Boundary::reflecting("wall", box.face(0, false)));
    }));
    box.lo[1] = 2;  // beyond the other face
    boundaries.add(Boundary::reflecting("upper", box.face(1, true)));
    EXPECT_TRUE(fails_with(Status::argument, {"\"lower\"", "\"upper\"", "from the inside"}, [&] {
        boundaries.add(Boundary::reflecting("lower", box.face(1, false)));
    }));
    EXPECT_TRUE(fails_with(Status::argument, {"dim = 2"}, [&] {
        boundaries.add(Boundary::reflecting(
            "flat", Plane(2, std::vector<double>{0, 0}, std::vector<double>{1, 0})));
    }));
    EXPECT_EQ(boundaries.size(), 2);
}

/// A good state, then a step that must fail and change nothing.
class FailedUpdate : public ::testing::Test {
protected:
    FailedUpdate() : boundaries_(2), good_(uniform_case(2, {0.1, 0.5, 0.9, 0.5}, 0.15, 2)) {
        Box box;
        box.dim = 2;
        add_periodic(boundaries_, box, 0);
        add_walls(boundaries_, box, 1);
        boundaries_.update(map_, node_lists(good_), MapOptions{});
        before_ = copy_of(boundaries_.lists());
    }

    ::testing::AssertionResult refuses(const Case& bad, Status status,
                                       const std::vector<std::string>& words) {
        const auto generation = map_.generation();
        if (auto r = fails_with(status, words,
                                [&] { boundaries_.update(map_, node_lists(bad), MapOptions{}); });
            !r)
            return r;
        const Case after = copy_of(boundaries_.lists());
        if (after.lists[0].x != before_.lists[0].x || after.lists[0].h != before_.lists[0].h)
            return ::testing::AssertionFailure() << "the nodes changed";
        if (map_.generation() != generation || map_.rows().size() != 2 ||
            map_.layout().n_slots() != after.n(0))
            return ::testing::AssertionFailure() << "the map changed";
        return ::testing::AssertionSuccess();
    }

    Boundaries boundaries_;
    Case good_, before_;
    ConnectivityMap map_;
};

TEST_F(FailedUpdate, nodes_outside_are_named) {
    Case bad = good_;
    bad.lists[0].x[3] = -0.25;
    EXPECT_TRUE(refuses(bad, Status::argument,
                        {"lower 1", "list 0", "\"nodes\"", "node 1", "-0.25", "move_inside"}));
}

TEST_F(FailedUpdate, positions_that_are_no_numbers_are_named) {
    Case bad = good_;
    bad.lists[0].x[2] = NAN;
    EXPECT_TRUE(refuses(bad, Status::nonfinite, {"axis 0", "node 1", "position[0]", "nan"}));
}

TEST_F(FailedUpdate, supports_from_plane_to_plane_are_named) {
    Case bad = good_;
    bad.lists[0].h[1] = 0.5;
    EXPECT_TRUE(refuses(bad, Status::half_box, {"axis 0", "node 1", "support", "1"}));
}

TEST_F(FailedUpdate, what_the_rebuild_refuses_changes_no_ghosts) {
    Case bad = good_;
    bad.lists[0].h[1] = NAN;
    EXPECT_TRUE(refuses(bad, Status::support, {"node 1"}));
    bad.lists[0].h[1] = -1;
    EXPECT_TRUE(refuses(bad, Status::support, {"node 1"}));
    bad.dim = 1;
    EXPECT_TRUE(fails_with(Status::argument, {"dim = 1"}, [&] {
        boundaries_.update(map_, node_lists(scalar_case(1, {0.5}, {0.1})), MapOptions{});
    }));
    EXPECT_TRUE(fails_with(Status::argument, {"0 node lists"},
                           [&] { boundaries_.update(map_, {}, MapOptions{}); }));
}

}  // namespace
}  // namespace connectivity::test
