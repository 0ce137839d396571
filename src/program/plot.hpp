// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// One picture of a snapshot and its neighbours: projected density beside the distribution of
/// neighbour counts. Drawn by gnuplot, which runs as a process of its own.

#include <string>
#include <vector>

#include "program/statistics.hpp"
#include "program/surface_density.hpp"

namespace connectivity::program {

struct PlotCounts {
    std::string list;
    CountStatistics counts;
};

struct PlotContent {
    std::string title;                   ///< over the picture
    std::string caption;                 ///< under it
    std::string map_title;               ///< over the projected density
    std::string length_unit, mass_unit;  ///< empty if unknown
    int dim = 3;
    SurfaceDensity map;
    std::vector<PlotCounts> counts;
};

/// Path of gnuplot. Throws Error{unsupported} if there is none, or if `path` does not end in .png.
std::string require_plotting(const std::string& path);

/// Draws a PNG. Atomic. Throws Error: unsupported (no gnuplot), file (it failed; with its own
/// words).
void plot(const std::string& path, const PlotContent& content);

}  // namespace connectivity::program
