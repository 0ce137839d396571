// SPDX-License-Identifier: BSD-3-Clause
// Garbage in the arguments of gravity: any status may come back, but the library stays whole.

#include "fuzz_garbage.hpp"
#include "gravity_support.hpp"

namespace connectivity::test {
namespace {

class GravityFuzz : public Garbage {
public:
    explicit GravityFuzz(std::uint64_t seed) : Garbage(seed) {
        EXPECT_TRUE(ok(conn_gravity_create(context(), &dead_)));
        conn_gravity* copy = dead_;
        EXPECT_TRUE(ok(conn_gravity_destroy(&copy)));
    }

    int n_solved = 0, n_views = 0, n_copied = 0;

    void call() {
        switch (random_.below(6)) {
            case 0:
            case 1: return solve();
            case 2: return acquire();
            case 3: return copy();
            case 4: return numbers_out();
            default: return release_garbage();
        }
    }

private:
    conn_context* context() { return context_.handle; }
    conn_gravity* gravity() {
        const int k = random_.below(12);
        return k == 0   ? nullptr
               : k == 1 ? dead_
               : k == 2 ? reinterpret_cast<conn_gravity*>(map_.handle)
                        : gravity_.handle;
    }
    template <class T>
    T* mostly(T* pointer) {
        return random_.chance(0.95) ? pointer : nullptr;
    }
    std::int32_t small_number() {
        const int k = number();
        return k > 4 ? 4 : k;
    }

    void solve() {
        const int n = random_.below(room / 3);
        conn_array x[4] = {conn_array_matrix(memory_.data(), n, 3), array(), array(), array()},
                   m = conn_array_vector(memory_.data(), n),
                   e = conn_array_vector(memory_.data(), n);
        if (random_.chance(0.2)) x[0] = array();
        if (random_.chance(0.1)) m = array();
        if (random_.chance(0.1)) e = array();
        if (random_.chance(0.3)) m.stride[0] = random_.below(2);
        with_struct<conn_gravity_options>([&](auto* options) {
            choose(options);
            if (conn_gravity_solve(gravity(), mostly(x), random_.chance(0.9) ? 1 : small_number(),
                                   mostly(&m), random_.chance(0.5) ? &e : nullptr,
                                   options) == CONN_OK)
                ++n_solved;
        });
    }
    void choose(conn_gravity_options* options) {
        if (options == nullptr) return;
        if (random_.chance(0.8)) {
            const std::size_t size = options->struct_size;
            *options = CONN_GRAVITY_OPTIONS_INIT;
            options->struct_size = size;
            options->method = random_.below(4);
            options->tolerance = std::exp2(-random_.below(30));
            options->acceptance = random_.below(4);
            options->near_precision = random_.below(3);
            options->softening = random_.below(2);
            options->symmetric = random_.chance(0.2) ? 1 : 0;
            options->error_bound = random_.below(2);
            if (random_.chance(0.3)) options->order = 1 + random_.below(20);
            if (random_.chance(0.2)) options->epsilon = random_.uniform();
            if (random_.chance(0.2)) options->leaf = 1 + random_.below(9);
            if (random_.chance(0.2)) options->n_samples = random_.below(9);
            if (random_.chance(0.1)) periodic(*options);
            if (random_.chance(0.2)) spoil(&options->method, sizeof *options - sizeof size);
        }
        options->previous_acceleration = random_.chance(0.2) ? memory_.data() : nullptr;
        if (options->n_previous > room) options->n_previous = room;
    }
    static void periodic(conn_gravity_options& options) {
        for (int d = 0; d < 3; ++d) {
            options.periodic[d] = 1;
            options.box_hi[d] = 1;
        }
    }
    void acquire() {
        with_struct<conn_gravity_view>([&](auto* view) {
            if (conn_gravity_acquire(gravity(), random_.chance(0.8) ? 0 : number(), view) !=
                CONN_OK)
                return;
            EXPECT_TRUE(ok(conn_gravity_release(view)));
            ++n_views;
        });
        with_struct<conn_gravity_info>([&](auto* info) { conn_gravity_get_info(gravity(), info); });
    }
    /// Strides as the library may write, into memory that is large enough.
    conn_array output(int n_components) {
        conn_gravity_info info = CONN_GRAVITY_INFO_INIT;
        conn_gravity_get_info(gravity_.handle, &info);
        conn_array a = conn_array_matrix(out_.data(), info.n, n_components);
        if (random_.chance(0.3)) a.dtype = CONN_FLOAT32;
        if (random_.chance(0.3)) a = conn_array_planar(out_.data(), info.n, n_components);
        if (random_.chance(0.1)) a.extent[0] = random_.below(room);
        if (random_.chance(0.1)) a.stride[0] = random_.below(4);
        if (random_.chance(0.05)) a.data = nullptr;
        if (random_.chance(0.05)) a.dtype = number();
        if (random_.chance(0.05)) a.ndim = number();
        return a;
    }
    void copy() {
        const conn_array a[3] = {output(random_.chance(0.9) ? 3 : 1), output(1), output(1)},
                         p = output(1), b = output(1);
        if (conn_gravity_copy(gravity(), mostly(a), random_.chance(0.8) ? 1 : 3,
                              random_.chance(0.7) ? &p : nullptr,
                              random_.chance(0.3) ? &b : nullptr) == CONN_OK)
            ++n_copied;
    }
    void numbers_out() {
        std::int64_t length = 0;
        char text[room];
        conn_gravity_report_text(gravity(), mostly(text), random_.below(room), mostly(&length));
        if (random_.chance(0.2)) conn_gravity_release_scratch(gravity());
        with_struct<conn_gravity_options>([&](auto* options) {
            conn_gravity_options_init(
                options, random_.chance(0.5) ? sizeof *options : static_cast<size_t>(number()));
        });
    }
    void release_garbage() {
        with_struct<conn_gravity_view>([](auto* view) { conn_gravity_release(view); });
        conn_gravity* dead = dead_;
        if (random_.chance(0.1)) {
            EXPECT_TRUE(fails(conn_gravity_destroy(&dead), CONN_E_HANDLE));
        }
    }

    GravityHandle gravity_{context_};
    conn_gravity* dead_ = nullptr;
    std::array<double, 4 * room> out_{};
};

TEST(CapiGravityFuzz, garbage_never_breaks_the_library) {
    int n_solved = 0, n_views = 0, n_copied = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        GravityFuzz fuzz(seed);
        for (int k = 0; k < 1000; ++k) fuzz.call();
        n_solved += fuzz.n_solved;
        n_views += fuzz.n_views;
        n_copied += fuzz.n_copied;
    }
    EXPECT_GT(n_solved, 1000) << "too much of the garbage was refused at the door";
    EXPECT_GT(n_views, 500);
    EXPECT_GT(n_copied, 500);
}

}  // namespace
}  // namespace connectivity::test
