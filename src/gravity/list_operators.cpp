// SPDX-License-Identifier: BSD-3-Clause
#include "list_operators.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace connectivity::detail {

void ListOperators::clear_moments(BoxId b) {
    std::fill_n(moments_.data() + b * stride_, stride_, 0.0);
}

void ListOperators::clear_local(BoxId b) {
    std::fill_n(locals_.data() + b * stride_, stride_, 0.0);
}

Expansion ListOperators::expansion(BoxId b, const View<double>& all) const {
    const Offset n = tree_.n_boxes;
    return {
        {boxes_(b), boxes_(n + b), boxes_(2 * n + b)}, boxes_(3 * n + b), all.data() + b * stride_};
}

CellArrays ListOperators::boxes() const {
    const Offset n = tree_.n_boxes;
    const double* const x = boxes_.data();
    return {x, x + n, x + 2 * n, x + 3 * n, moments_.data(), stride_};
}

void ListOperators::p2m(BoxId b) {
    const Own s = own(tree_.sources, b);
    const Offset n = tree_.sources.n;
    const double* const x = sources_.data() + s.first;
    expansion_kernels().p2m(order_, {x, x + n, x + 2 * n, x + 3 * n, s.n}, moments(b));
}

void ListOperators::m2m(BoxId b, const BoxEntries& children) {
    expansion_kernels().m2m(order_, boxes(), list(children), moments(b));
}

void ListOperators::m2l(BoxId b, const BoxEntries& sources) {
    expansion_kernels().m2l(order_, boxes(), list(sources), local(b));
}

void ListOperators::l2l(BoxId b, const BoxEntries& children) {
    expansion_kernels().l2l(order_, local(b), boxes(), list(children), locals_.data());
}

/// Copies, where the image says, into rows of x, y, z, mass and, where there is any, softening.
const double* ListOperators::gather(int worker, const SourceRuns& sources, std::int64_t& stride) {
    stride = sources.n + gather_slack;
    std::vector<double>& rows = rows_[worker];
    if (rows.size() < static_cast<std::size_t>(5 * stride)) rows.resize(5 * stride);
    const Offset n = tree_.sources.n;
    const double* const x = sources_.data();
    direct_kernels().gather64({{x, x + n, x + 2 * n},
                               x + 3 * n,
                               law_ == PairLaw::newton ? nullptr : x + 4 * n,
                               shifts_.data()},
                              sources.runs.data(), static_cast<std::int64_t>(sources.runs.size()),
                              rows.data(), stride);
    return rows.data();
}

void ListOperators::p2l(int worker, BoxId b, const SourceRuns& sources) {
    std::int64_t stride;
    const double* const x = gather(worker, sources, stride);
    expansion_kernels().p2l(order_, {x, x + stride, x + 2 * stride, x + 3 * stride, sources.n},
                            local(b));
}

Points ListOperators::targets(Own own) const {
    const bool same = tree_.sources_are_targets;
    const Offset n = tree_.targets.n;
    const double* const x = (same ? sources_ : targets_).data() + own.first;
    return {x, x + n, x + 2 * n, own.n};
}

Sums ListOperators::sums() const {
    const Offset n = tree_.targets.n;
    double* const p = sums_.data();
    return {p, p + n, p + 2 * n, p + 3 * n};
}

Fields ListOperators::fields(Own own) const {
    const Sums at = sums().at(own.first);
    return {at.p, at.ax, at.ay, at.az};
}

void ListOperators::begin_targets(BoxId b) {
    const Own t = own(tree_.targets, b);
    const Sums at = sums().at(t.first);
    for (double* const to : {at.p, at.ax, at.ay, at.az}) std::fill_n(to, t.n, 0.0);
}

void ListOperators::l2p(BoxId b) {
    const Own t = own(tree_.targets, b);
    expansion_kernels().l2p(order_, local(b), targets(t), fields(t));
}

void ListOperators::m2p(BoxId b, const BoxEntries& sources) {
    const Own t = own(tree_.targets, b);
    expansion_kernels().m2p(order_, boxes(), list(sources), targets(t), fields(t));
}

const double* ListOperators::target_softening() const {
    if (law_ == PairLaw::newton) return nullptr;
    return tree_.sources_are_targets ? sources_.data() + 4 * tree_.sources.n
                                     : targets_.data() + 3 * tree_.targets.n;
}

void ListOperators::p2p(int worker, BoxId b, const SourceRuns& sources) {
    const Own t = own(tree_.targets, b);
    std::int64_t stride;
    const double* const x = gather(worker, sources, stride);
    const Points points = targets(t);
    const Fields to = fields(t);
    const double* const e = target_softening();
    direct_kernels().add64(
        law_, {x, x + stride, x + 2 * stride, x + 3 * stride, x + 4 * stride, sources.n},
        {points.x, points.y, points.z, e == nullptr ? nullptr : e + t.first, to.p, to.ax, to.ay,
         to.az, t.n});
    if (law_ == PairLaw::plummer) add_coincident(b, sources, x, stride);
}

/// The kernel leaves out pairs at one place, a particle and itself among them. With Plummer's law
/// the others have a potential. A bit for each of 64 values of a hash finds sources that may be at
/// the place of a target.
void ListOperators::add_coincident(BoxId b, const SourceRuns& sources, const double* rows,
                                   std::int64_t stride) const {
    const auto place = [](double x) {
        return std::uint64_t{1} << (std::bit_cast<std::uint64_t>(x + 0.0) * 0x9E3779B97F4A7C15u >>
                                    58);
    };
    const Own own_targets = own(tree_.targets, b);
    const Points t = targets(own_targets);
    const double* const e = target_softening() + own_targets.first;
    const Fields to = fields(own_targets);
    std::uint64_t places = 0;
    for (std::int64_t k = 0; k < t.n; ++k) places |= place(t.x[k]);
    const double *const x = rows, *const y = rows + stride, *const z = rows + 2 * stride;
    std::int64_t j = 0;
    for (const SourceRun& run : sources.runs)
        for (std::int32_t i = run.first; i < run.first + run.n; ++i, ++j) {
            if ((places & place(x[j])) == 0) continue;
            for (std::int64_t k = 0; k < t.n; ++k) {
                if (x[j] != t.x[k] || y[j] != t.y[k] || z[j] != t.z[k]) continue;
                const bool itself = tree_.sources_are_targets && run.image == no_image &&
                                    i == own_targets.first + k;
                const double length = std::max(rows[4 * stride + j], e[k]);
                if (!itself && length > 0) to.p[k] += rows[3 * stride + j] / length;
            }
        }
}

}  // namespace connectivity::detail
