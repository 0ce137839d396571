// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The picture of one box and its interaction lists: the whole tree, and beside it what is near the
/// box. Drawn by gnuplot.

#include <string>

#include "program/lists_scene.hpp"

namespace connectivity::program {

struct ListsPictureText {
    std::string title;
    std::string length_unit;  ///< empty if unknown
};

/// Draws a PNG of a 2D tree, or of the slice of a 3D tree through the centre of the box. Atomic.
/// Throws Error: unsupported (no gnuplot, 1D), file (it failed; with its own words).
void draw_lists(const std::string& path, const ListsScene& scene, const ListsPictureText& text);

}  // namespace connectivity::program
