// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/gravity/gravity.hpp>

#include <utility>

#include <connectivity/base/runtime.hpp>

#include "solver.hpp"

namespace connectivity {

using namespace detail;

struct Gravity::Impl {
    Solver solver;
    Solution now;
};

Gravity::Gravity() : impl_(std::make_unique<Impl>()) {}
Gravity::~Gravity() = default;
Gravity::Gravity(Gravity&&) noexcept = default;
Gravity& Gravity::operator=(Gravity&&) noexcept = default;

void Gravity::solve(const GravityParticles& particles, const GravityOptions& options) {
    check_options(particles, options);
    run_kernels("gravity", [&] { impl_->solver.solve(particles, options, impl_->now); });
}

Offset Gravity::n() const { return impl_->now.n; }

namespace {

ConstView<double> cut(const View<double>& view, Offset n) {
    return Kokkos::subview(view, std::pair<std::size_t, std::size_t>(0, n));
}

}  // namespace

ConstView<double> Gravity::acceleration() const {
    return cut(impl_->now.acceleration, 3 * impl_->now.n);
}
ConstView<double> Gravity::potential() const { return cut(impl_->now.potential, impl_->now.n); }
ConstView<double> Gravity::error_bound() const {
    return cut(impl_->now.bound, impl_->now.has_bound ? impl_->now.n : 0);
}
const GravityInfo& Gravity::info() const { return impl_->now.info; }
const Report& Gravity::report() const { return impl_->now.report; }
Offset Gravity::scratch_bytes() const { return impl_->solver.bytes(); }
void Gravity::release_scratch() { impl_->solver = Solver(); }

}  // namespace connectivity
