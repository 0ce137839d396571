// SPDX-License-Identifier: BSD-3-Clause
// Gravity without memory, at every allocation: the solution before stays; and what a solution
// allocates when it has all it needs.

#include <support/gravity_solve.hpp>
#include <support/hash.hpp>

#include "fail_each_allocation.hpp"

namespace connectivity::test {
namespace {

class GravityFaults : public ::testing::Test {
protected:
    void SetUp() override {
        if (!can_fail) GTEST_SKIP() << "the sanitizer has a malloc of its own";
        // The OpenMP runtime ends the process where it lacks memory; one thread takes none.
        start_runtime({.n_threads = 1});
    }
    static GravityOptions options(GravityMethod method, bool periodic = false) {
        GravityOptions o = to_tolerance(1e-3, method);
        o.error_bound = true;
        o.budget.bytes = 1 << 30;  // without it the system is asked, which may fail unnoticed
        if (periodic) o.domain = periodic_box();
        return o;
    }
    static std::uint64_t bits(const Gravity& gravity) {
        Fnv1a hash;
        hash.add_view(gravity.acceleration());
        hash.add_view(gravity.potential());
        hash.add_view(gravity.error_bound());
        return hash.value();
    }
};

TEST_F(GravityFaults, a_solution_that_lacks_memory_leaves_the_one_before) {
    const SceneArrays<> few(uniform_scene(60)), many(corner_clumps_scene(200));
    for (const GravityMethod method :
         {GravityMethod::automatic, GravityMethod::direct, GravityMethod::walk, GravityMethod::fmm})
        for (const bool grow : {true, false}) {
            SCOPED_TRACE(name_of(method));
            Gravity gravity;
            gravity.solve((grow ? few : many).particles(), options(GravityMethod::direct));
            const std::uint64_t before = bits(gravity);
            const long n = fail_each_allocation(
                [&] { gravity.solve((grow ? many : few).particles(), options(method)); },
                [&] { ASSERT_EQ(bits(gravity), before); });
            EXPECT_GT(n, 5);
            EXPECT_NE(bits(gravity), before);
        }
}

TEST_F(GravityFaults, so_does_one_in_the_same_storage) {
    const SceneArrays<> old(uniform_scene(100)), now(corner_clumps_scene(100));
    for (const GravityMethod method : {GravityMethod::direct, GravityMethod::fmm}) {
        Gravity gravity;
        gravity.solve(old.particles(), options(method));
        const std::uint64_t before = bits(gravity);
        fail_each_allocation([&] { gravity.solve(now.particles(), options(method)); },
                             [&] { ASSERT_EQ(bits(gravity), before) << name_of(method); });
    }
}

TEST_F(GravityFaults, direct_solutions_of_the_same_size_allocate_nothing_but_names) {
    const SceneArrays<> scene(corner_clumps_scene(6000));
    for (const bool periodic : {false, true}) {
        Gravity gravity;
        Offset bytes[3];
        for (Offset& taken : bytes) {
            allocated_bytes = 0;
            gravity.solve(scene.particles(), options(GravityMethod::direct, periodic));
            taken = allocated_bytes;
        }
        EXPECT_GT(bytes[0], 6000 * 7 * 8);
        EXPECT_LT(bytes[2], 16 << 10) << "periodic " << periodic;
    }
}

}  // namespace
}  // namespace connectivity::test
