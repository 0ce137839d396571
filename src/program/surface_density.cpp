// SPDX-License-Identifier: BSD-3-Clause
#include "program/surface_density.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <connectivity/base/parallel.hpp>

namespace connectivity::program {

namespace {

/// Support radius of a node; of a tensor the mean of its axes, roughly.
double radius_of(const NodeList& nodes, Offset i) {
    const double extent = nodes.kernel_extent();
    if (!nodes.has_tensor()) return extent * nodes.h()(i);
    const int dim = nodes.dim();
    double trace = 0;
    for (int d = 0, k = 0; d < dim; k += dim - d, ++d) trace += nodes.H()(i * n_symmetric(dim) + k);
    return extent * dim / trace;
}

/// Where the nodes are along one axis, a few outliers left out, with a margin.
std::pair<double, double> range_of(std::span<const ListData> lists, int axis) {
    std::vector<double> x;
    for (const auto& list : lists)
        for (Offset i = 0; i < list.nodes.n(); ++i)
            x.push_back(list.nodes.positions()(i * list.nodes.dim() + axis));
    if (x.empty()) return {0, 1};
    std::sort(x.begin(), x.end());
    const auto at = [&](double fraction) {
        return x[static_cast<std::size_t>(fraction * static_cast<double>(x.size() - 1))];
    };
    const double margin = 0.1 * (at(0.995) - at(0.005));
    const double lo = std::max(x.front() - 0.5 * margin, at(0.005) - margin);
    const double hi = std::min(x.back() + 0.5 * margin, at(0.995) + margin);
    return hi > lo ? std::pair{lo, hi} : std::pair{lo - 0.5, lo + 0.5};
}

/// Pixels along one axis: where the image wraps and where it ends.
struct Axis {
    int n;
    bool is_periodic;
    double lo, length;

    double pixel() const { return length / n; }
    /// Place of x in pixels; within the box on a periodic axis.
    double place(double x) const {
        const double offset = (x - lo) / length;
        return n * (is_periodic ? offset - std::floor(offset) : offset);
    }
    /// Pixels whose centres lie within `reach` of a place; outside the image only if it wraps.
    std::pair<int, int> under(double at, double reach) const {
        const double most = 2.0 * n;  // a support may be far larger than an open window
        int first = static_cast<int>(std::ceil(std::clamp(at - reach - 0.5, -most, most)));
        int last = static_cast<int>(std::floor(std::clamp(at + reach - 0.5, -most, most)));
        if (is_periodic) return {first, last};
        return {std::max(first, 0), std::min(last, n - 1)};
    }
    /// A support is at most half the box, so one period brings every pixel back.
    int wrapped(int k) const { return k < 0 ? k + n : k >= n ? k - n : k; }
};

/// Adds nodes to one image; every worker has its own. A node's weight falls as (1 - q^2)^3 from its
/// middle to the edge of its support.
class Painter {
public:
    Painter(const Axis& x, const Axis& y, int dim)
        : x_(x),
          y_(y),
          dim_(dim),
          image_(static_cast<std::size_t>(x.n) * static_cast<std::size_t>(y.n)) {}

    const std::vector<double>& image() const { return image_; }

    void paint(const ListData& list, Offset first, Offset last, bool by_mass) {
        const double* const x = list.nodes.positions().data();
        for (Offset i = first; i < last; ++i)
            paint(x_.place(x[i * dim_]), dim_ > 1 ? y_.place(x[i * dim_ + 1]) : 0.5,
                  radius_of(list.nodes, i), by_mass ? list.mass(i) : 1.0);
    }

private:
    /// Spreads over at least `least` pixels, so that points show and small supports do not flicker.
    void paint(double x, double y, double radius, double mass) {
        constexpr double least = 1.5, resolved = 4;
        const double reach_x = std::max(least, radius / x_.pixel());
        const double reach_y = dim_ > 1 ? std::max(least, radius / y_.pixel()) : 1;
        double sum = dim_ == 1 ? 32.0 / 35.0 * reach_x : std::numbers::pi / 4 * reach_x * reach_y;
        if (std::min(reach_x, dim_ > 1 ? reach_y : reach_x) < resolved) {
            sum = 0;
            under(x, y, reach_x, reach_y, [&](double&, double weight) { sum += weight; });
        }
        under(x, y, reach_x, reach_y,
              [&](double& at, double weight) { at += mass * weight / sum; });
    }

    /// Visits the pixels of the image whose centres lie under a support, with its weight there.
    template <class Visit>
    void under(double x, double y, double reach_x, double reach_y, const Visit& visit) {
        const auto [first_y, last_y] = y_.under(y, dim_ > 1 ? reach_y : 0.25);
        for (int ky = first_y; ky <= last_y; ++ky) {
            const double dy = (ky + 0.5 - y) / reach_y, rest_y = 1 - dy * dy;
            if (rest_y <= 0) continue;
            double* const line = image_.data() + static_cast<std::ptrdiff_t>(y_.wrapped(ky)) * x_.n;
            const auto [first_x, last_x] = x_.under(x, reach_x * std::sqrt(rest_y));
            for (int kx = first_x; kx <= last_x; ++kx) {
                const double dx = (kx + 0.5 - x) / reach_x, rest = std::max(0.0, rest_y - dx * dx);
                visit(line[x_.wrapped(kx)], rest * rest * rest);
            }
        }
    }

    Axis x_, y_;
    int dim_;
    std::vector<double> image_;
};

void choose_window(SurfaceDensity& map, std::span<const ListData> lists, const Domain& domain,
                   int pixels) {
    const int axes = std::min(lists[0].nodes.dim(), 2);
    double length[2] = {1, 0};
    for (int d = 0; d < axes; ++d) {
        const auto k = static_cast<std::size_t>(d);
        const auto [lo, hi] =
            domain.periodic[k] ? std::pair{domain.lo[k], domain.hi[k]} : range_of(lists, d);
        map.lo[d] = lo;
        map.hi[d] = hi;
        length[d] = hi - lo;
    }
    const double longest = std::max(length[0], length[1]);
    const auto count = [&](double l) {
        return std::max(pixels / 8, static_cast<int>(std::lround(pixels * l / longest)));
    };
    map.nx = count(length[0]);
    map.ny = axes == 1 ? 1 : count(length[1]);
}

}  // namespace

float SurfaceDensity::quantile(double fraction) const {
    std::vector<float> filled;
    std::copy_if(values.begin(), values.end(), std::back_inserter(filled),
                 [](float v) { return v > 0; });
    if (filled.empty()) return 0;
    const auto at = filled.begin() +
                    static_cast<std::ptrdiff_t>(fraction * static_cast<double>(filled.size() - 1));
    std::nth_element(filled.begin(), at, filled.end());
    return *at;
}

SurfaceDensity surface_density(std::span<const ListData> lists, const Domain& domain, int pixels) {
    SurfaceDensity map;
    choose_window(map, lists, domain, pixels);
    map.by_mass = std::all_of(lists.begin(), lists.end(), [](const ListData& list) {
        return static_cast<Offset>(list.mass.size()) == list.nodes.n();
    });
    const int dim = lists[0].nodes.dim();
    const Axis x{map.nx, domain.periodic[0], map.lo[0], map.hi[0] - map.lo[0]};
    const Axis y{map.ny, dim > 1 && domain.periodic[1], map.lo[1], map.hi[1] - map.lo[1]};
    std::vector<Painter> painters(static_cast<std::size_t>(n_workers()), Painter(x, y, dim));
    for (const auto& list : lists) {
        constexpr Offset piece = 256;
        auto* const painter = painters.data();
        const ListData* const source = &list;
        const Offset n = list.nodes.n();
        const bool by_mass = map.by_mass;
        for_each_dynamic("program/surface_density", (n + piece - 1) / piece,
                         [=](const int worker, const Offset k) {
                             painter[worker].paint(*source, k * piece, std::min(n, (k + 1) * piece),
                                                   by_mass);
                         });
    }
    const double area = x.pixel() * (dim == 1 ? 1 : y.pixel());
    map.values.resize(painters[0].image().size());
    for (std::size_t k = 0; k < map.values.size(); ++k) {
        double sum = 0;
        for (const auto& painter : painters) sum += painter.image()[k];
        map.values[k] = static_cast<float>(sum / area);
    }
    return map;
}

}  // namespace connectivity::program
