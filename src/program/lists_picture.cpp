// SPDX-License-Identifier: BSD-3-Clause
#include "program/lists_picture.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <connectivity/io/pending_file.hpp>

#include "program/gnuplot.hpp"
#include "program/plot.hpp"

namespace connectivity::program {

namespace {

struct Style {
    std::string_view colour, name;
};
/// By ListRole. Ancestors have the colours of the list, paler.
constexpr std::array<Style, n_list_roles> styles{{
    {"#cfdcf0", "2 of an ancestor: handed down"},
    {"#e0d3ea", "4 of an ancestor: handed down"},
    {"#3b6fb6", "2: multipole to local"},
    {"#4a9a5b", "3: multipole at the targets"},
    {"#8a5fb0", "4: sources to local"},
    {"#e08a3c", "1: direct, touching"},
    {"#f2c14e", "3 close: direct, too near for 3"},
    {"#c8553d", "4 close: direct, too near for 4"},
}};
constexpr std::string_view chosen_colour = "#1a1a1a";

/// Own sources alone take part, and those of its children do not.
bool is_own_only(ListRole role) {
    return role != ListRole::siblings && role != ListRole::siblings_of_ancestor &&
           role != ListRole::smaller;
}

std::string_view colour_of(ListRole role) { return styles[static_cast<std::size_t>(role)].colour; }

/// A square part of the plane.
struct Window {
    double x = 0, y = 0, half = 1;  ///< centre and half width
    double unit = 1;                ///< what 1 on the axes is
    bool is_relative = false;       ///< coordinates count from the centre

    double shown_x(double value) const { return is_relative ? (value - x) / unit : value; }
    double shown_y(double value) const { return is_relative ? (value - y) / unit : value; }
};

/// x, y, left, right, bottom, top: clipped to the window; empty if it is outside or under
/// `smallest`.
std::string rectangle(const Window& window, double x, double y, double half, double smallest = 0) {
    const double left = std::max(x - half, window.x - window.half),
                 right = std::min(x + half, window.x + window.half),
                 bottom = std::max(y - half, window.y - window.half),
                 top = std::min(y + half, window.y + window.half);
    if (left >= right || bottom >= top || half < smallest) return {};
    return fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}",
                       window.shown_x(0.5 * (left + right)), window.shown_y(0.5 * (bottom + top)),
                       window.shown_x(left), window.shown_x(right), window.shown_y(bottom),
                       window.shown_y(top));
}

class Picture {
public:
    Picture(const ListsScene& scene, const ListsPictureText& text, const ScratchFolder& folder)
        : scene_(scene), tree_(scene.tree), text_(text), folder_(folder) {
        for (int d = 0; d < tree_.dim; ++d)
            center_[static_cast<std::size_t>(d)] = tree_.center(d, scene.box);
        for (const auto& listed : scene_.listed)
            if (is_cut(listed.center, listed.half_width)) drawn_.push_back(listed);
        std::stable_sort(drawn_.begin(), drawn_.end(),
                         [](const auto& a, const auto& b) { return a.half_width > b.half_width; });
    }

    std::string script(const std::string& output);

private:
    static constexpr int height_ = 900;
    static constexpr double bottom_ = 0.15, top_ = 0.88;
    static constexpr Offset most_points_ = 20000;

    Window whole() const;
    Window near() const;
    std::string preamble(const std::string& output) const;
    std::string caption() const;
    std::string legend(double left) const;
    std::string panel(const Window& window, const std::string& title, double left);
    std::string fills(const Window& window, const std::string& prefix) const;
    std::string outlines(const Window& window) const;
    std::string points(const Window& window) const;
    bool is_periodic() const { return tree_.periodic[0] || tree_.periodic[1]; }
    double panel_width() const { return (top_ - bottom_) * height_ / width_; }

    /// Is the box in the slice that is drawn? The lower of two that share a face there is not.
    bool is_cut(const std::array<double, 3>& center, double half_width) const {
        return tree_.dim < 3 ||
               (center[2] - half_width <= center_[2] && center_[2] < center[2] + half_width);
    }

    const ListsScene& scene_;
    const TreeView& tree_;
    const ListsPictureText& text_;
    const ScratchFolder& folder_;
    std::array<double, 3> center_{};  ///< of the chosen box
    std::vector<ListedBox> drawn_;    ///< large ones first
    int width_ = 0;
    int n_panels_ = 0;
};

/// The root box, and its images where it is periodic.
Window Picture::whole() const {
    Window window;
    window.x = 0.5 * (tree_.bounding_box_min[0] + tree_.bounding_box_max[0]);
    window.y = 0.5 * (tree_.bounding_box_min[1] + tree_.bounding_box_max[1]);
    window.half = (is_periodic() ? 1.53 : 0.51) * tree_.root_extent;
    return window;
}

/// What is one box beyond the parent's neighbours, so that list 2 is whole.
Window Picture::near() const {
    Window window;
    const double half_width = tree_.half_width(scene_.box);
    window.x = center_[0];
    window.y = center_[1];
    window.half = half_width * (4 * scene_.well_sep_is_n_away + 5);
    window.unit = 2 * half_width;
    window.is_relative = true;
    return window;
}

std::string Picture::fills(const Window& window, const std::string& prefix) const {
    std::string solid, hollow;
    for (const auto& listed : drawn_) {
        const auto text = rectangle(window, listed.center[0], listed.center[1], listed.half_width);
        if (text.empty()) continue;
        const bool is_hollow = listed.is_split && is_own_only(listed.role);
        (is_hollow ? hollow : solid) +=
            fmt::format("{} 0x{}\n", text, colour_of(listed.role).substr(1));
    }
    std::string plots;
    if (!solid.empty()) {
        folder_.write(prefix + "solid.txt", solid);
        plots += fmt::format(
            "{} using 1:2:3:4:5:6:7 with boxxyerror lw 0.6 lc rgb variable fs solid 1.0 border "
            "lc rgb '#ffffff' notitle, ",
            quoted(folder_.file(prefix + "solid.txt")));
    }
    if (!hollow.empty()) {
        folder_.write(prefix + "hollow.txt", hollow);
        plots += fmt::format(
            "{} using 1:2:3:4:5:6:7 with boxxyerror lw 4 lc rgb variable fs empty notitle, ",
            quoted(folder_.file(prefix + "hollow.txt")));
    }
    return plots;
}

std::string Picture::outlines(const Window& window) const {
    const double smallest = 1.5 * window.half / ((top_ - bottom_) * height_);
    std::string text;
    for (BoxId b = 0; b < tree_.n_boxes; ++b) {
        std::array<double, 3> center{};
        for (int d = 0; d < tree_.dim; ++d)
            center[static_cast<std::size_t>(d)] = tree_.center(d, b);
        if (!is_cut(center, tree_.half_width(b))) continue;
        const auto line = rectangle(window, center[0], center[1], tree_.half_width(b), smallest);
        if (!line.empty()) text += line + "\n";
    }
    return text;
}

/// Sources, if they are few enough to be seen as points.
std::string Picture::points(const Window& window) const {
    const auto& sources = tree_.sources;
    std::string text;
    if (tree_.dim != 2) return text;
    Offset n = 0;
    for (Offset i = 0; i < sources.n; ++i) {
        const double x = sources.positions(i), y = sources.positions(sources.n + i);
        if (std::abs(x - window.x) > window.half || std::abs(y - window.y) > window.half) continue;
        if (++n > most_points_) return {};
        text += fmt::format("{:.9g} {:.9g}\n", window.shown_x(x), window.shown_y(y));
    }
    return text;
}

std::string Picture::panel(const Window& window, const std::string& title, double left) {
    const std::string prefix = fmt::format("panel{}_", n_panels_++);
    std::string script = fmt::format(
        "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
        "set bmargin at screen {:.4f}\nset tmargin at screen {:.4f}\n",
        left, left + panel_width(), bottom_, top_);
    const auto range = [&](double center, double half) {
        return window.is_relative
                   ? fmt::format("[{:.9g}:{:.9g}]", -half / window.unit, half / window.unit)
                   : fmt::format("[{:.12g}:{:.12g}]", center - half, center + half);
    };
    script += fmt::format("set title {} noenhanced\nset xrange {}\nset yrange {}\n", quoted(title),
                          range(window.x, window.half), range(window.y, window.half));
    const std::string unit = text_.length_unit.empty() ? "" : " [" + text_.length_unit + "]";
    script += window.is_relative
                  ? "set xlabel 'x from the centre of the box, in widths of it'\n"
                    "set ylabel 'y' offset 1,0\n"
                  : fmt::format("set xlabel {} noenhanced\nset ylabel {} noenhanced offset 1,0\n",
                                quoted("x" + unit), quoted("y" + unit));
    script += "plot " + fills(window, prefix);
    for (const auto& [name, text, style] :
         {std::array<std::string, 3>{"boxes.txt", outlines(window),
                                     "using 1:2:3:4:5:6 with boxxyerror lw 0.8 lc rgb '#8a8a8a' fs "
                                     "empty notitle"},
          std::array<std::string, 3>{"points.txt", points(window),
                                     "with points pt 7 ps 0.25 lc rgb '#303030' notitle"},
          std::array<std::string, 3>{
              "chosen.txt", rectangle(window, center_[0], center_[1], tree_.half_width(scene_.box)),
              fmt::format("using 1:2:3:4:5:6 with boxxyerror lw 5 lc rgb '{}' fs empty notitle",
                          chosen_colour)}}) {
        if (text.empty()) continue;
        folder_.write(prefix + name, text);
        script += fmt::format("{} {}, ", quoted(folder_.file(prefix + name)), style);
    }
    return script + "NaN notitle\n";
}

std::string Picture::legend(double left) const {
    std::string script = fmt::format(
        "unset border\nunset tics\nunset xlabel\nunset ylabel\nunset title\n"
        "set key at screen {:.4f}, screen {:.4f} left top Left reverse samplen 1.6 spacing 1.6 "
        "noenhanced\n",
        left, top_);
    script += "set xrange [0:1]\nset yrange [0:1]\nplot -1 notitle";
    script += fmt::format(", keyentry with boxes lw 4 lc rgb '{}' fs empty title 'box {}'",
                          chosen_colour, scene_.box);
    constexpr std::array order{ListRole::neighbor,
                               ListRole::siblings,
                               ListRole::smaller,
                               ListRole::bigger,
                               ListRole::close_smaller,
                               ListRole::close_bigger,
                               ListRole::siblings_of_ancestor,
                               ListRole::bigger_of_ancestor};
    for (const ListRole role : order) {
        const auto k = static_cast<std::size_t>(role);
        const bool of_ancestor =
            role == ListRole::siblings_of_ancestor || role == ListRole::bigger_of_ancestor;
        if (!scene_.exists[k] || (of_ancestor && scene_.counts[k] == 0)) continue;
        script += fmt::format(", keyentry with boxes lc rgb '{}' fs solid 1.0 noborder title {}",
                              styles[k].colour,
                              quoted(fmt::format("{}  ({})", styles[k].name, scene_.counts[k])));
    }
    return script + ", keyentry with boxes lw 1 lc rgb '#8a8a8a' fs empty title 'in no list'\n";
}

std::string Picture::caption() const {
    const Offset n_own = tree_.targets.box_counts_nonchild(scene_.box);
    const int level = tree_.box_levels(scene_.box);
    if (n_own == 0)
        return fmt::format(
            "Box {} (level {}) has no targets of its own: what it gets by lists 2 and 4, and what "
            "its ancestors get, is handed down to its children.",
            scene_.box, level);
    const bool hollow = std::any_of(drawn_.begin(), drawn_.end(), [](const auto& listed) {
        return listed.is_split && is_own_only(listed.role);
    });
    return fmt::format(
        "Every source{} reaches the {} target{} of box {} (level {}) once, by the list that "
        "colours "
        "its box{}.",
        is_periodic() ? ", and each of its images next to the root box," : "", n_own,
        n_own == 1 ? "" : "s", scene_.box, level,
        hollow ? " (of outlined boxes only sources that are not in a child)" : "");
}

std::string Picture::preamble(const std::string& output) const {
    std::string script = "set encoding utf8\n";
    script += fmt::format(
        "set terminal pngcairo size {},{} enhanced font 'Sans,15' background '#ffffff'\n", width_,
        height_);
    script += "set output " + quoted(output) + "\n";
    script +=
        "set border lw 1.2 lc rgb '#444444'\n"
        "set tics textcolor rgb '#222222' nomirror out\n";
    script += fmt::format(
        "set label 1 {} at screen 0.5,0.03 center noenhanced font ',13' textcolor rgb '#555555'\n",
        quoted(caption()));
    script += fmt::format("set multiplot title {} noenhanced font ',19'\n", quoted(text_.title));
    return script;
}

std::string Picture::script(const std::string& output) {
    const Window all = whole(), detail = near();
    const bool two = detail.half < 0.7 * all.half;
    width_ = two ? 2060 : 1320;
    const double first = 150.0 / width_, gap = 110.0 / width_;
    const std::string slice =
        tree_.dim == 3 ? fmt::format(", slice at z = {:.6g}", center_[2]) : "";
    std::string text = preamble(output);
    text += panel(all, fmt::format("{} boxes{}", tree_.n_boxes, slice), first);
    text += "unset label 1\n";
    double right = first + panel_width();
    if (two) {
        text += panel(detail, "around the box", right + gap);
        right += gap + panel_width();
    }
    return text + legend(right + 25.0 / width_) + "unset multiplot\nset output\n";
}

}  // namespace

void draw_lists(const std::string& path, const ListsScene& scene, const ListsPictureText& text) {
    require_plotting(path);
    if (scene.tree.dim == 1)
        throw Error(Status::unsupported, "pictures show trees of 2 or 3 dimensions, this has 1");
    PendingFile file(path);
    const ScratchFolder folder;
    folder.write("picture.gp", Picture(scene, text, folder).script(file.temporary()));
    run_gnuplot(folder, "picture.gp");
    file.commit();
}

}  // namespace connectivity::program
