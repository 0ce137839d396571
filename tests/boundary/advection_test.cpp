// SPDX-License-Identifier: BSD-3-Clause
// A fluid without pressure that drifts through a periodic box: density must not notice.

#include <gtest/gtest.h>

#include <boundary/clouds.hpp>

namespace connectivity::test {
namespace {

/// Cubic spline without its factor, q = r / support.
double spline(double q) {
    return q < 0.5 ? 1 - 6 * q * q + 6 * q * q * q : q < 1 ? 2 * std::pow(1 - q, 3) : 0;
}

class Drift {
public:
    Drift(int dim, int side) : dim_(dim), n_(1), boundaries_(dim) {
        Box box;
        box.dim = dim;
        for (int d = 0; d < dim; ++d) add_periodic(boundaries_, box, d), n_ *= side;
        node_lists(scalar_case(dim, {}, {}));  // starts the runtime
        x_ = allocate<double>("x", n_ * dim);
        h_ = allocate<double>("h", n_);
        for (Offset i = 0; i < n_; ++i) {
            Offset rest = i;
            for (int d = 0; d < dim; ++d, rest /= side)
                x_(i * dim + d) = (static_cast<double>(rest % side) + 0.5) / side;
            h_(i) = 1.3 / side;
        }
    }

    std::vector<NodeList> lists() const { return {NodeList::with_h("fluid", dim_, n_, x_, h_, 2)}; }

    void move(double time) {
        const double velocity[3] = {0.6180339887, -0.4142135624, 0.7320508076};
        for (Offset k = 0; k < n_ * dim_; ++k) x_(k) += time * velocity[k % dim_];
    }

    void update() {
        boundaries_.move_inside(x_);
        boundaries_.update(map_, lists(), Requirements().add("sph", {Need::rows}));
    }

    void refresh() { boundaries_.refresh(lists()); }

    /// Smallest and largest density.
    std::pair<double, double> density() const {
        const NodeList& nodes = boundaries_.lists()[0];
        HostField mass{FieldKind::scalar, allocate_zeroed<double>("mass", nodes.n())};
        std::fill_n(mass.values.data(), n_, 1.0);
        boundaries_.fill_ghosts(0, mass);
        std::pair<double, double> range(HUGE_VAL, 0);
        for (Offset i = 0; i < n_; ++i) {
            double rho = spline(0);
            for (const Slot j : map_.rows()[i]) {
                double r2 = 0;
                for (int d = 0; d < dim_; ++d) {
                    const double r =
                        nodes.positions()(i * dim_ + d) - nodes.positions()(j * dim_ + d);
                    r2 += r * r;
                }
                rho += mass.values(j) * spline(std::sqrt(r2) / (2 * h_(i)));
            }
            range = {std::min(range.first, rho), std::max(range.second, rho)};
        }
        return range;
    }

    const Boundaries& boundaries() const { return boundaries_; }

private:
    int dim_;
    Offset n_;
    Boundaries boundaries_;
    ConnectivityMap map_;
    View<double> x_, h_;
};

void drift_through_the_box(int dim, int side) {
    Drift fluid(dim, side);
    fluid.update();
    const double start = fluid.density().first;
    double worst = 0;
    const auto watch = [&] {
        const auto [least, most] = fluid.density();
        worst = std::max({worst, std::abs(least / start - 1), std::abs(most / start - 1)});
    };
    for (int step = 0; step < 500; ++step) {
        fluid.move(0.005);
        fluid.refresh();  // nodes may be outside now; the lists stay
        if (step % 5 == 0) watch();
        fluid.move(0.005);
        fluid.update();
        if (step % 5 == 0) watch();
    }
    watch();
    EXPECT_LT(worst, 1e-10);
    EXPECT_GT(fluid.boundaries().ghosts().n_ghosts(), 0);
    ::testing::Test::RecordProperty("worst", std::to_string(worst * 1e14) + "e-14");
}

TEST(Advection, density_stays_constant_in_1d) { drift_through_the_box(1, 32); }
TEST(Advection, density_stays_constant_in_2d) { drift_through_the_box(2, 12); }
TEST(Advection, density_stays_constant_in_3d) { drift_through_the_box(3, 6); }

}  // namespace
}  // namespace connectivity::test
