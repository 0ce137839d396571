// SPDX-License-Identifier: BSD-3-Clause
// H5Part: a group Step#<k> per step, one-dimensional datasets x, y, z, h, m, rho, id as SPH-EXA
// writes them. The support is at 2 h. A box with its boundaries may stand in attributes of the
// step; else all axes are open.
#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "io/readers.hpp"

namespace connectivity::io {

namespace {

constexpr const char* prefix = "Step#";
constexpr const char* list_name = "particles";

/// Number of a step from its group's name; -1 if the name is none of a step.
Offset step_number(const std::string& name) {
    if (!name.starts_with(prefix)) return -1;
    Offset number = -1;
    const char* const end = name.data() + name.size();
    const auto [stop, code] =
        std::from_chars(name.data() + std::string(prefix).size(), end, number);
    return code == std::errc{} && stop == end ? number : -1;
}

struct Step {
    Offset number;
    std::string group;
};

std::vector<Step> steps_of(const hdf5::Group& root) {
    std::vector<Step> steps;
    for (const auto& name : root.members())
        if (step_number(name) >= 0) steps.push_back({step_number(name), name});
    std::sort(steps.begin(), steps.end(),
              [](const Step& a, const Step& b) { return a.number < b.number; });
    return steps;
}

Step choose_step(const hdf5::Group& root, std::optional<Offset> asked) {
    const auto steps = steps_of(root);
    if (!asked) return steps.back();
    for (const auto& step : steps)
        if (step.number == *asked) return step;
    throw Error(Status::argument,
                fmt::format("{} has no step {}: it has {} from {} to {}", root.where(), *asked,
                            steps.size(), steps.front().number, steps.back().number));
}

class H5Part : public SnapshotReader {
public:
    H5Part(const hdf5::Group& root, SnapshotInfo info, const ReadOptions& options)
        : info_(std::move(info)),
          step_(root.group(choose_step(root, options.step).group)),
          extent_(options.kernel_extent.value_or(2.0)) {
        info_.format = "H5Part";
        const auto steps = steps_of(root);
        info_.detail = fmt::format("step {} ({} in the file)",
                                   choose_step(root, options.step).number, steps.size());
        if (!step_.has_dataset("x"))
            throw Error(Status::format, step_.where() + " has no coordinates x, y, z");
        info_.dim = step_.has_dataset("y") ? (step_.has_dataset("z") ? 3 : 2) : 1;
        if (!options.open) read_domain();
        const auto shape = step_.shape("x");
        if (shape.size() != 1)
            throw Error(Status::format, fmt::format("{} has shape {}, must be [n]",
                                                    step_.where("x"), hdf5::text_of(shape)));
        check_positions(step_, "x", shape);
        info_.lists.push_back(
            {list_name, shape[0], shape[0], step_.has_dataset("h"), step_.has_dataset("m")});
    }

    const SnapshotInfo& info() const override { return info_; }

    ListData read(const std::string& list, const FieldRequest& fields) override {
        const auto& entry = info_.lists[find_list(info_, list)];
        const Offset n = entry.n;
        const auto positions = read_positions(n);
        const ConstView<double> h =
            entry.has_support ? read_field(step_, "h", n) : allocate_zeroed<double>("io/h", n);
        ListData data{NodeList::with_h(list, info_.dim, n, positions, h, extent_)};
        if (fields.mass && entry.has_mass) data.mass = read_field(step_, "m", n);
        if (fields.density && step_.has_dataset("rho")) data.density = read_field(step_, "rho", n);
        if (fields.global_id && step_.has_dataset("id")) data.global_id = read_ids(step_, "id", n);
        return data;
    }

private:
    View<double> read_positions(Offset n) const {
        auto positions = allocate<double>("io/positions", n * info_.dim);
        for (int d = 0; d < info_.dim; ++d) {
            const auto axis = read_field(step_, std::string(1, "xyz"[d]), n);
            for (Offset i = 0; i < n; ++i) positions(i * info_.dim + d) = axis(i);
        }
        return positions;
    }

    /// Attributes box [xmin, xmax, ymin, ...] and boundaryType [3] (1 = periodic) of SPH-EXA.
    void read_domain() {
        if (!step_.has_attribute("box") || !step_.has_attribute("boundaryType")) return;
        const auto box = step_.numbers("box"), boundary = step_.numbers("boundaryType");
        if (box.size() != 6 || boundary.size() != 3)
            throw Error(Status::format,
                        step_.where() + " must have 6 values of box and 3 of boundaryType");
        for (std::size_t d = 0; d < static_cast<std::size_t>(info_.dim); ++d) {
            info_.domain.periodic[d] = boundary[d] == 1;
            info_.domain.lo[d] = box[2 * d];
            info_.domain.hi[d] = box[2 * d + 1];
        }
    }

    SnapshotInfo info_;
    hdf5::Group step_;
    double extent_;
};

}  // namespace

bool is_h5part_file(const hdf5::Group& root) { return !steps_of(root).empty(); }

std::unique_ptr<SnapshotReader> open_h5part(hdf5::Group root, SnapshotInfo info,
                                            const ReadOptions& options) {
    return std::make_unique<H5Part>(root, std::move(info), options);
}

}  // namespace connectivity::io
