// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The host's particles as the builder reads them, sources and targets in one numbering: first the
/// sources, then the targets.

#include <connectivity/tree/tree_input.hpp>

namespace connectivity::tree_detail {

template <class Real, int Dim>
class Particles {
public:
    explicit Particles(const TreeInput& input)
        : n_sources_(input.sources.n), sources_(input.sources) {
        if (input.targets) targets_ = *input.targets;
    }

    Offset n_sources() const { return n_sources_; }
    Offset n() const { return n_sources_ + targets_.n; }
    bool have_extent() const { return sources_.radii != nullptr || targets_.radii != nullptr; }

    Real position(Offset i, int d) const {
        const ParticleArray& a = i < n_sources_ ? sources_ : targets_;
        const Offset k = i < n_sources_ ? i : i - n_sources_;
        return static_cast<const Real*>(a.positions)[k * a.particle_stride + d * a.axis_stride];
    }
    /// 0 for points.
    Real radius(Offset i) const {
        const ParticleArray& a = i < n_sources_ ? sources_ : targets_;
        const Offset k = i < n_sources_ ? i : i - n_sources_;
        return a.radii == nullptr ? Real(0)
                                  : static_cast<const Real*>(a.radii)[k * a.radius_stride];
    }

private:
    Offset n_sources_;
    ParticleArray sources_, targets_;
};

}  // namespace connectivity::tree_detail

/// What the builder is instantiated for: coordinate types and dimensions.
#define CONNECTIVITY_EACH_REAL_AND_DIM(instantiate)                                          \
    instantiate(float, 1) instantiate(float, 2) instantiate(float, 3) instantiate(double, 1) \
        instantiate(double, 2) instantiate(double, 3)
