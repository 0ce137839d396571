// SPDX-License-Identifier: BSD-3-Clause
#include "program/gravity_picture.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <connectivity/io/pending_file.hpp>

#include "program/gnuplot.hpp"
#include "program/plot.hpp"

namespace connectivity::program {

namespace {

constexpr const char* colours[] = {"#3b6fb6", "#d9772b", "#4a9a5b", "#9a4a8f", "#8a6d3b"};
constexpr Offset most_points = 20000;
constexpr std::size_t most_bands = 48, least_in_band = 10;

/// The value that `share` of the particles stay below.
template <class Value>
double quantile(std::vector<FieldPoint>& points, double share, const Value& value) {
    const auto at = points.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(points.size() - 1));
    std::nth_element(points.begin(), at, points.end(),
                     [&](const auto& p, const auto& q) { return value(p) < value(q); });
    return value(*at);
}

FieldBand band_of(std::vector<FieldPoint> points) {
    constexpr double shares[] = {0.1, 0.5, 0.9};
    FieldBand band;
    band.r = quantile(points, 0.5, [](const FieldPoint& p) { return p.r; });
    for (int k = 0; k < 3; ++k) {
        band.a[k] = quantile(points, shares[k], [](const FieldPoint& p) { return p.a; });
        band.phi[k] = quantile(points, shares[k], [](const FieldPoint& p) { return p.phi; });
    }
    return band;
}

std::string text_of(const std::vector<FieldBand>& bands) {
    std::string text;
    for (const auto& b : bands)
        text += fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", b.r, b.a[0],
                            b.a[1], b.a[2], b.phi[0], b.phi[1], b.phi[2]);
    return text;
}

/// Every so manieth particle of a list, so that all lists have at most most_points.
std::string text_of(const std::vector<FieldPoint>& points, Offset first, Offset last) {
    const Offset step = 1 + static_cast<Offset>(points.size()) / most_points;
    std::string text;
    for (Offset i = first; i < last; i += step) {
        const auto& p = points[static_cast<std::size_t>(i)];
        if (p.r > 0 && p.a > 0) text += fmt::format("{:.6g} {:.6g} {:.6g}\n", p.r, p.a, p.phi);
    }
    return text;
}

std::string preamble(const std::string& output, const GravityPictureText& text) {
    std::string script =
        "set encoding utf8\n"
        "set terminal pngcairo size 1680,860 enhanced font 'Sans,15' background '#ffffff'\n";
    script += "set output " + quoted(output) + "\n";
    script +=
        "set border lw 1.2 lc rgb '#444444'\nset tics textcolor rgb '#222222' nomirror\n"
        "set grid lc rgb '#e4e4e4'\nset logscale x\nset format x '10^{%T}'\n"
        "set style fill transparent solid 0.25 noborder\n";
    script += fmt::format(
        "set label 1 {} at screen 0.5,0.03 center noenhanced font ',13' textcolor rgb '#555555'\n",
        quoted(text.caption));
    const std::string unit = text.length_unit.empty() ? "" : " [" + text.length_unit + "]";
    script += fmt::format("set xlabel {} noenhanced\n",
                          quoted("distance from the deepest particle" + unit));
    return script +
           fmt::format("set multiplot title {} noenhanced font ',19'\n", quoted(text.title));
}

struct Panel {
    double left, right;
    const char *label, *axis;
    int point_column, band_column;
};

class Picture {
public:
    Picture(const GravityInput& input, const std::vector<FieldPoint>& points,
            const ScratchFolder& folder)
        : folder_(folder), lists_(input.lists.names) {
        for (std::size_t k = 0; k < lists_.size(); ++k) {
            const auto [first, last] = input.rows(k);
            const std::string text = text_of(points, first, last);
            is_drawn_.push_back(!text.empty());
            folder_.write(fmt::format("list{}.txt", k), text);
        }
        const auto bands = field_bands(points);
        has_bands_ = bands.size() > 1;
        folder_.write("bands.txt", text_of(bands));
    }

    std::string panel(const Panel& p) const {
        std::string script = fmt::format(
            "set lmargin at screen {}\nset rmargin at screen {}\nset bmargin at screen 0.145\n"
            "set tmargin at screen 0.885\nset ylabel {}\n{}plot ",
            p.left, p.right, quoted(p.label), p.axis);
        for (std::size_t k = 0; k < lists_.size(); ++k)
            if (is_drawn_[k])
                script += fmt::format(
                    "{} using 1:{} with dots lc rgb '{}' notitle, NaN with "
                    "points pt 7 lc rgb '{}' title {} noenhanced, ",
                    quoted(folder_.file(fmt::format("list{}.txt", k))), p.point_column,
                    colours[k % std::size(colours)], colours[k % std::size(colours)],
                    quoted(lists_[k]));
        if (has_bands_)
            script += fmt::format(
                "{0} using 1:{1}:{3} with filledcurves lc rgb '#222222' title '80 % of all', '' "
                "using 1:{2} with lines lw 2 lc rgb '#222222' title 'median', ",
                quoted(folder_.file("bands.txt")), p.band_column, p.band_column + 1,
                p.band_column + 2);
        return script + "NaN notitle\nunset label 1\n";
    }

    bool is_empty() const {
        return std::none_of(is_drawn_.begin(), is_drawn_.end(), [](bool drawn) { return drawn; });
    }

private:
    const ScratchFolder& folder_;
    std::vector<std::string> lists_;
    std::vector<bool> is_drawn_;
    bool has_bands_ = false;
};

}  // namespace

std::vector<FieldPoint> field_points(const GravityInput& input, const Gravity& gravity,
                                     const Domain& domain) {
    const Offset n = gravity.n();
    const auto a = gravity.acceleration();
    const auto phi = gravity.potential();
    std::vector<FieldPoint> points(static_cast<std::size_t>(n));
    const Offset deepest = n == 0 ? 0 : std::min_element(phi.data(), phi.data() + n) - phi.data();
    for (Offset i = 0; i < n; ++i) {
        double square = 0;
        for (int d = 0; d < input.dim; ++d) {
            double x =
                input.positions(i * input.dim + d) - input.positions(deepest * input.dim + d);
            if (const double l = domain.length(d); l > 0) x -= l * std::rint(x / l);
            square += x * x;
        }
        points[static_cast<std::size_t>(i)] = {
            std::sqrt(square), std::hypot(a(3 * i), a(3 * i + 1), a(3 * i + 2)), phi(i)};
    }
    return points;
}

std::vector<FieldBand> field_bands(std::vector<FieldPoint> points) {
    std::erase_if(points, [](const FieldPoint& p) { return !(p.r > 0); });
    std::vector<FieldBand> bands;
    if (points.size() < least_in_band) return bands;
    const auto [nearest, farthest] = std::minmax_element(
        points.begin(), points.end(), [](const auto& p, const auto& q) { return p.r < q.r; });
    const double first = std::log(nearest->r), width = std::log(farthest->r) - first;
    std::vector<std::vector<FieldPoint>> members(most_bands);
    for (const auto& p : points) {
        const double place = width > 0 ? (std::log(p.r) - first) / width : 0;
        members[std::min(most_bands - 1, static_cast<std::size_t>(place * most_bands))].push_back(
            p);
    }
    for (auto& band : members)
        if (band.size() >= least_in_band) bands.push_back(band_of(std::move(band)));
    return bands;
}

void draw_gravity(const std::string& path, const GravityInput& input,
                  const std::vector<FieldPoint>& points, const GravityPictureText& text) {
    require_plotting(path);
    PendingFile file(path);
    const ScratchFolder folder;
    const Picture picture(input, points, folder);
    if (picture.is_empty())
        throw Error(Status::argument,
                    "a picture shows forces against distance, but no particle has any");
    std::string script = preamble(file.temporary(), text);
    script +=
        picture.panel({0.075, 0.485, "|acceleration|",
                       "set logscale y\nset format y '10^{%T}'\nset key bottom left\n", 2, 2});
    script += picture.panel({0.575, 0.985, "potential",
                             "unset logscale y\nset format y '%g'\nset key bottom right\n", 3, 5});
    folder.write("picture.gp", script + "unset multiplot\nset output\n");
    run_gnuplot(folder, "picture.gp");
    file.commit();
}

}  // namespace connectivity::program
