// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_tree.hpp"

#include <cmath>
#include <string>

namespace connectivity::tree_detail {

namespace {

[[noreturn]] void refuse(const std::string& text) { throw Error(Status::argument, text); }

void check_arguments(const MeshBoxes& mesh) {
    if (mesh.dim < 1 || mesh.dim > 3)
        refuse("dim is " + std::to_string(mesh.dim) + ", must be 1, 2 or 3");
    if (mesh.n_boxes < 1 || mesh.n_boxes > max_slots)
        throw Error(mesh.n_boxes < 1 ? Status::argument : Status::too_many,
                    "n_boxes is " + std::to_string(mesh.n_boxes) + ", must be in [1, " +
                        std::to_string(max_slots) + "]");
    const bool by_parents = mesh.parent_ids != nullptr && mesh.child_numbers != nullptr;
    if (mesh.child_ids == nullptr && !by_parents)
        throw Error(Status::null,
                    "boxes need child_ids, or parent_ids and child_numbers: neither is given");
    if (mesh.child_ids != nullptr && mesh.child_stride < mesh.n_boxes)
        refuse("child_stride is " + std::to_string(mesh.child_stride) + ", must be at least " +
               std::to_string(mesh.n_boxes));
    for (int d = 0; d < mesh.dim; ++d)
        if (!std::isfinite(mesh.lo[d]))
            throw Error(Status::box, "lo[" + std::to_string(d) + "] is " + number(mesh.lo[d]) +
                                         ", must be finite");
    if (!(mesh.root_extent > 0) || !std::isfinite(mesh.root_extent))
        throw Error(Status::box,
                    "root_extent is " + number(mesh.root_extent) + ", must be finite and > 0");
}

/// Boxes as the growing tree has them, by parent.
class MeshReader {
public:
    explicit MeshReader(const MeshBoxes& mesh) : mesh_(mesh), parent_(mesh.n_boxes, -1) {
        number_.resize(mesh.n_boxes);
        mesh.child_ids != nullptr ? read_children() : read_parents();
        for (Offset b = 1; b < mesh.n_boxes; ++b)
            if (parent_[b] < 0) refuse("box " + std::to_string(b) + " is nobody's child");
    }

    /// Levels from the parents, and children side by side in order of their numbers.
    std::vector<std::uint8_t> levels() const {
        std::vector<std::uint8_t> levels(mesh_.n_boxes, 0);
        for (Offset b = 1; b < mesh_.n_boxes; ++b) {
            const int level = levels[parent_[b]] + 1;
            if (level > 254)
                throw Error(Status::too_many, "box " + std::to_string(b) +
                                                  " is at level 255, the deepest allowed is 254");
            levels[b] = static_cast<std::uint8_t>(level);
            if (level < levels[b - 1])
                refuse("box " + std::to_string(b) + " is at level " + std::to_string(level) +
                       " behind one at level " + std::to_string(levels[b - 1]) +
                       ": boxes must be numbered level by level");
        }
        return levels;
    }
    BoxId parent(BoxId b) const { return parent_[b]; }
    int number(BoxId b) const { return number_[b]; }

private:
    void join(Offset parent, Offset child, int number) {
        const std::string name = "box " + std::to_string(child);
        if (child <= parent || child >= mesh_.n_boxes)
            refuse(name + " is a child of box " + std::to_string(parent) + ", must be in (" +
                   std::to_string(parent) + ", " + std::to_string(mesh_.n_boxes) + ")");
        if (parent_[child] >= 0)
            refuse(name + " has two parents, " + std::to_string(parent_[child]) + " and " +
                   std::to_string(parent));
        parent_[child] = static_cast<BoxId>(parent);
        number_[child] = static_cast<std::uint8_t>(number);
    }
    void read_children() {
        for (Offset b = 0; b < mesh_.n_boxes; ++b)
            for (int k = 0; k < 1 << mesh_.dim; ++k)
                if (const BoxId child = mesh_.child_ids[k * mesh_.child_stride + b]; child != 0)
                    join(b, child, k);
    }
    void read_parents() {
        std::vector<std::uint8_t> there(mesh_.n_boxes, 0);
        for (Offset b = 1; b < mesh_.n_boxes; ++b) {
            const BoxId parent = mesh_.parent_ids[b];
            const int number = mesh_.child_numbers[b];
            if (parent < 0 || parent >= b)
                refuse("the parent of box " + std::to_string(b) + " is " + std::to_string(parent) +
                       ", must be in [0, " + std::to_string(b) + ")");
            if (number >= 1 << mesh_.dim || (there[parent] >> number & 1) != 0)
                refuse("box " + std::to_string(b) + " is child " + std::to_string(number) +
                       " of box " + std::to_string(parent) + ", must be in [0, " +
                       std::to_string(1 << mesh_.dim) + ") and the only one of that number");
            there[parent] = static_cast<std::uint8_t>(there[parent] | 1 << number);
            join(parent, b, number);
        }
    }

    const MeshBoxes& mesh_;
    std::vector<BoxId> parent_;
    std::vector<std::uint8_t> number_;
};

TreeView header_of(const MeshBoxes& mesh, int n_levels) {
    TreeView tree;
    tree.dim = mesh.dim;
    tree.sources_are_targets = true;
    tree.periodic = mesh.periodic;
    tree.root_extent = mesh.root_extent;
    for (int d = 0; d < mesh.dim; ++d) {
        tree.bounding_box_min[d] = mesh.lo[d];
        tree.bounding_box_max[d] = mesh.lo[d] + mesh.root_extent;
    }
    tree.n_levels = n_levels;
    tree.n_boxes = mesh.n_boxes;
    tree.aligned_n_boxes = (mesh.n_boxes + 31) / 32 * 32;
    return tree;
}

void fill_box(BoxId b, const MeshReader& boxes, const TreeArrays& out) {
    const Offset aligned = out.header.aligned_n_boxes;
    const int dim = out.header.dim;
    const BoxId parent = b == 0 ? 0 : boxes.parent(b);
    out.parents(b) = parent;
    out.flags(b) = box_flag::has_own_sources | box_flag::has_own_targets;
    out.sources.box_starts(b) = out.sources.box_counts_nonchild(b) =
        out.sources.box_counts_cumul(b) = 0;
    for (int d = 0; d < dim; ++d) {
        double& center = out.centers(d * aligned + b);
        if (b == 0) {
            center = out.header.bounding_box_min[d] + out.header.root_extent / 2;
            continue;
        }
        const double step = std::ldexp(out.header.root_extent, -(out.levels(b) + 1));
        const bool upper = (boxes.number(b) >> (dim - 1 - d) & 1) != 0;
        center = out.centers(d * aligned + parent) + (upper ? step : -step);
    }
    if (b == 0) return;
    out.children(boxes.number(b) * aligned + parent) = b;
    out.flags(parent) = box_flag::has_child_sources | box_flag::has_child_targets;
}

}  // namespace

TreeArrays mesh_tree(const MeshBoxes& mesh) {
    check_arguments(mesh);
    const MeshReader boxes(mesh);
    const auto levels = boxes.levels();
    TreeArrays out;
    out.header = header_of(mesh, levels.back() + 1);
    out.take({});
    std::copy(levels.begin(), levels.end(), out.levels.data());
    for (Offset b = mesh.n_boxes - 1; b >= 0; --b)
        out.level_starts(levels[b]) = static_cast<BoxId>(b);
    out.level_starts(out.header.n_levels) = static_cast<BoxId>(mesh.n_boxes);
    Kokkos::deep_copy(out.children, 0);
    Kokkos::deep_copy(out.centers, 0.0);
    for (BoxId b = 0; b < mesh.n_boxes; ++b) fill_box(b, boxes, out);
    return out;
}

}  // namespace connectivity::tree_detail
