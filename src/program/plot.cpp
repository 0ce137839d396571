// SPDX-License-Identifier: BSD-3-Clause
#include "program/plot.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <connectivity/io/pending_file.hpp>

#include "program/gnuplot.hpp"

namespace connectivity::program {

namespace {

constexpr const char* colours[] = {"#3b6fb6", "#d9772b", "#4a9a5b",
                                   "#9a4a8f", "#8a6d3b", "#5b5b5b"};

constexpr int picture_width = 1680, picture_height = 860;
constexpr double bottom_edge = 0.135, top_edge = 0.875;

/// Where the next panel stands, in shares of the picture.
std::string margins(double left, double right, double bottom, double top) {
    return fmt::format(
        "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
        "set bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n",
        left, right, bottom, top);
}

/// Unit names in gnuplot's enhanced text.
std::string pretty(std::string unit) {
    const auto replace = [&](const std::string& from, const std::string& to) {
        if (const auto at = unit.find(from); at != std::string::npos)
            unit.replace(at, from.size(), to);
    };
    if (unit.starts_with("1e")) {
        const auto end = unit.find(' ');
        unit = "10^{" + unit.substr(2, end - 2) + "}" +
               (end == std::string::npos ? "" : unit.substr(end));
    }
    replace("Msun", "M_{⊙}");
    replace("Rsun", "R_{⊙}");
    return unit;
}

std::string axis_label(const std::string& axis, const std::string& unit) {
    return quoted(unit.empty() ? axis : fmt::format("{} [{}]", axis, pretty(unit)));
}

std::string colour_label(const PlotContent& content) {
    const auto& map = content.map;
    const int power = std::min(content.dim, 2);
    const std::string what =
        map.by_mass ? (power == 2 ? "surface density" : "density") : "nodes per area";
    if (content.length_unit.empty()) return quoted(what);
    const std::string length = pretty(content.length_unit);
    const std::string per = length.find('/') == std::string::npos
                                ? fmt::format("{}^{{-{}}}", length, power)
                                : fmt::format("({})^{{-{}}}", length, power);
    return quoted(
        fmt::format("{}  [{} {}]", what, map.by_mass ? pretty(content.mass_unit) : "", per));
}

/// Margins that give both axes of the map the same scale (up to an aspect of 3), in the middle of
/// the left half.
std::string map_margins(const SurfaceDensity& map) {
    const double width = map.hi[0] - map.lo[0], height = map.hi[1] - map.lo[1];
    const double aspect = std::clamp(height / width, 1.0 / 3.0, 3.0);
    const double half_x = 0.19 * std::min(1.0, 1 / aspect);
    const double half_y = 0.19 * picture_width / picture_height * std::min(1.0, aspect);
    return margins(0.275 - half_x, 0.275 + half_x, 0.505 - half_y, 0.505 + half_y);
}

/// The projected density as an image, its colours logarithmic.
std::string map_panel(const PlotContent& content, const ScratchFolder& folder) {
    const auto& map = content.map;
    float lo = map.quantile(0.01F);
    const float hi = std::max(map.quantile(0.9995F), lo * 1.5F);
    lo = std::max(lo, hi * 1e-6F);
    std::vector<float> pixels = map.values;
    for (float& value : pixels) value = std::max(value, lo);
    folder.write("map.bin", pixels.data(), pixels.size() * sizeof(float));
    const double dx = (map.hi[0] - map.lo[0]) / map.nx, dy = (map.hi[1] - map.lo[1]) / map.ny;
    std::string script = map_margins(map);
    script += fmt::format("set title {} noenhanced\n", quoted(content.map_title));
    script += fmt::format("set xlabel {}\nset ylabel {}\n", axis_label("x", content.length_unit),
                          axis_label("y", content.length_unit));
    script += fmt::format("set cblabel {} offset 1.2,0\n", colour_label(content));
    script += fmt::format("set xrange [{:.9g}:{:.9g}]\nset yrange [{:.9g}:{:.9g}]\n", map.lo[0],
                          map.hi[0], map.lo[1], map.hi[1]);
    script += hi > 0 ? fmt::format("set logscale cb\nset cbrange [{:.6g}:{:.6g}]\n", lo, hi) : "";
    script += fmt::format(
        "plot {} binary array=({},{}) format='%float32' origin=({:.12g},{:.12g}) dx={:.12g} "
        "dy={:.12g} with image notitle\n",
        quoted(folder.file("map.bin")), map.nx, map.ny, map.lo[0] + 0.5 * dx, map.lo[1] + 0.5 * dy,
        dx, dy);
    return script;
}

/// In one dimension: density along the line.
std::string line_panel(const PlotContent& content, const ScratchFolder& folder) {
    const auto& map = content.map;
    std::string data;
    for (int k = 0; k < map.nx; ++k)
        data +=
            fmt::format("{:.9g} {:.9g}\n", map.lo[0] + (k + 0.5) * (map.hi[0] - map.lo[0]) / map.nx,
                        map.values[static_cast<std::size_t>(k)]);
    folder.write("line.txt", data);
    std::string script = margins(0.085, 0.465, bottom_edge, top_edge);
    script += fmt::format("set title {} noenhanced\n", quoted(content.map_title));
    script += fmt::format("set xlabel {}\nset ylabel {}\n", axis_label("x", content.length_unit),
                          colour_label(content));
    script += fmt::format("set xrange [{:.9g}:{:.9g}]\nset yrange [0:*]\n", map.lo[0], map.hi[0]);
    script += fmt::format(
        "plot {} with filledcurves above y1=0 lc rgb '#c9d8ee' notitle, '' with lines lw 2 lc rgb "
        "'{}' notitle\n",
        quoted(folder.file("line.txt")), colours[0]);
    return script;
}

/// Bins of equal width that hold 99.8 % of the nodes of every list.
struct Bins {
    Offset first = max_slots, last = 0, width = 1, largest = 0;
    bool is_cut = false;  ///< some counts are beyond `last`
};

Bins choose_bins(const std::vector<PlotCounts>& lists) {
    Bins bins;
    for (const auto& [list, counts] : lists) {
        bins.first = std::min(bins.first, counts.min());
        bins.last = std::max(bins.last, counts.percentile(99.8));
        bins.largest = std::max(bins.largest, counts.max());
    }
    bins.width = std::max<Offset>(1, (bins.last - bins.first + 1) / 70);
    bins.is_cut = bins.largest > bins.last;
    return bins;
}

std::vector<Offset> binned(const CountStatistics& counts, const Bins& bins) {
    std::vector<Offset> bars;
    for (Offset c = bins.first; c <= bins.last; c += bins.width) {
        bars.push_back(0);
        for (Offset k = c;
             k < std::min(c + bins.width, static_cast<Offset>(counts.histogram.size())); ++k)
            bars.back() += counts.histogram[static_cast<std::size_t>(k)];
    }
    return bars;
}

std::string text_of(const std::vector<Offset>& bars, const Bins& bins) {
    std::string text;
    double middle = static_cast<double>(bins.first) + 0.5 * static_cast<double>(bins.width - 1);
    for (const Offset n : bars) {
        text += fmt::format("{} {}\n", middle, n);
        middle += static_cast<double>(bins.width);
    }
    return text;
}

/// Highest bar of all lists.
Offset highest(const std::vector<std::vector<Offset>>& bars) {
    Offset top = 1;
    for (const auto& list : bars)
        for (const Offset n : list) top = std::max(top, n);
    return top;
}

/// How many nodes have how many neighbours; the sparse tail beyond 99.8 % is left out and said so.
std::string histogram_panel(const PlotContent& content, const ScratchFolder& folder) {
    const Bins bins = choose_bins(content.counts);
    std::vector<std::vector<Offset>> bars;
    for (const auto& entry : content.counts) bars.push_back(binned(entry.counts, bins));
    const double top = static_cast<double>(highest(bars));
    std::string script = margins(0.64, 0.975, bottom_edge, top_edge);
    script += "set title 'Neighbours of a node'\n";
    script += fmt::format(
        "set ylabel {}\n",
        quoted(bins.width == 1 ? "nodes" : fmt::format("nodes in bins of {}", bins.width)));
    script += fmt::format(
        "set xlabel {}\n",
        quoted(bins.is_cut
                   ? fmt::format("neighbours  (99.8 % of the nodes; largest: {})", bins.largest)
                   : "neighbours"));
    script += fmt::format("set xrange [{}:{}]\nset yrange [0:{:.6g}]\n", bins.first - bins.width,
                          bins.last + 2 * bins.width,
                          top * (1.15 + 0.07 * static_cast<double>(bars.size())));
    std::string plots, means;
    for (std::size_t k = 0; k < content.counts.size(); ++k) {
        const auto& [list, counts] = content.counts[k];
        const std::string colour = colours[k % std::size(colours)];
        const std::string file = fmt::format("counts{}.txt", k);
        folder.write(file, text_of(bars[k], bins));
        plots += fmt::format(
            "{} using 1:2:({}) with boxes fs transparent solid 0.7 noborder lc rgb '{}' title {}, ",
            quoted(folder.file(file)), bins.width, colour,
            quoted(fmt::format("{}: mean {:.1f}, median {}, min {}", list, counts.mean,
                               counts.percentile(50), counts.min())));
        means += fmt::format(
            "set arrow from {0:.6g}, 0 to {0:.6g}, {1:.6g} nohead lw 2 dt 2 lc rgb '#222222' "
            "front\n",
            counts.mean, top * 1.05);
    }
    return script + means + "plot " + plots +
           "NaN with lines lw 2 dt 2 lc rgb '#222222' title 'mean'\n";
}

/// Terminal, fonts and colours of the whole picture.
std::string preamble(const std::string& output, const PlotContent& content) {
    std::string script = "set encoding utf8\n";
    script += fmt::format(
        "set terminal pngcairo size {},{} enhanced font 'Sans,15' background '#ffffff'\n",
        picture_width, picture_height);
    script += "set output " + quoted(output) + "\n";
    script +=
        "set palette defined (0 '#000004', 1 '#160b39', 2 '#420a68', 3 '#6a176e', 4 '#932667', "
        "5 '#bc3754', 6 '#dd513a', 7 '#f37819', 8 '#fca50a', 9 '#f6d746', 10 '#fcffa4')\n"
        "set border lw 1.2 lc rgb '#444444'\n"
        "set tics textcolor rgb '#222222' nomirror\n"
        "set format cb '10^{%T}'\n"
        "set key noenhanced top right samplen 2\n";
    script += fmt::format(
        "set label 1 {} at screen 0.5,0.03 center noenhanced font ',13' textcolor rgb '#555555'\n",
        quoted(content.caption));
    script += fmt::format("set multiplot title {} noenhanced font ',19'\n", quoted(content.title));
    return script;
}

}  // namespace

std::string require_plotting(const std::string& path) {
    if (!path.ends_with(".png"))
        throw Error(
            Status::argument,
            fmt::format("cannot draw '{}': pictures are PNG, the name must end in .png", path));
    return find_gnuplot();
}

void plot(const std::string& path, const PlotContent& content) {
    require_plotting(path);
    PendingFile file(path);
    const ScratchFolder folder;
    std::string script = preamble(file.temporary(), content);
    script += content.dim == 1 ? line_panel(content, folder) : map_panel(content, folder);
    script += "unset label 1\nunset format\nset grid y lc rgb '#dddddd'\n";
    script += histogram_panel(content, folder);
    script += "unset multiplot\nset output\n";
    folder.write("picture.gp", script);
    run_gnuplot(folder, "picture.gp");
    file.commit();
}

}  // namespace connectivity::program
