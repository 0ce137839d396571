// SPDX-License-Identifier: BSD-3-Clause
// GADGET and SWIFT: one group PartType<k> per list, names of datasets as each code has them.
//
// GADGET's SmoothingLength is the support radius (kernel extent 1). SWIFT's SmoothingLengths are h
// with the support at gamma·h, where gamma depends on its kernel and dimension (Dehnen & Aly 2012,
// table 1).
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "io/readers.hpp"

namespace connectivity::io {

namespace {

struct Names {
    const char *h, *mass, *density;
};
constexpr Names gadget_names{"SmoothingLength", "Masses", "Density"};
constexpr Names swift_names{"SmoothingLengths", "Masses", "Densities"};

bool is_type_name(const std::string& name) {
    return name.size() == 9 && name.starts_with("PartType") &&
           std::isdigit(static_cast<unsigned char>(name[8]));
}

std::vector<std::string> type_names(const hdf5::Group& root) {
    std::vector<std::string> names;
    for (const auto& name : root.members())
        if (is_type_name(name) && root.has_group(name)) names.push_back(name);
    return names;
}

bool is_swift(const hdf5::Group& root) {
    if (root.has_group("Code") && root.group("Code").text("Code").value_or("") == "SWIFT")
        return true;
    for (const auto& name : type_names(root))
        if (root.group(name).has_dataset(swift_names.h)) return true;
    return false;
}

/// gamma of SWIFT's kernels by name, for 1, 2 and 3 dimensions; 0 where the kernel does not exist.
double swift_gamma(const std::string& kernel, int dim) {
    struct Entry {
        const char* name;
        double gamma[3];
    };
    constexpr Entry table[] = {{"Cubic spline (M4)", {1.732051, 1.778002, 1.825742}},
                               {"Quartic spline (M5)", {1.936492, 1.977173, 2.018932}},
                               {"Quintic spline (M6)", {2.121321, 2.158131, 2.195775}},
                               {"Wendland C2", {1.620185, 1.897367, 1.936492}},
                               {"Wendland C4", {0, 2.171239, 2.207940}},
                               {"Wendland C6", {0, 2.415230, 2.449490}}};
    for (const auto& entry : table)
        if (kernel == entry.name) return entry.gamma[dim - 1];
    return 0;
}

class ParticleTypes : public SnapshotReader {
public:
    ParticleTypes(hdf5::Group root, SnapshotInfo info, const ReadOptions& options)
        : root_(std::move(root)),
          info_(std::move(info)),
          swift_(is_swift(root_)),
          names_(swift_ ? swift_names : gadget_names) {
        info_.format = swift_ ? "SWIFT" : "GADGET";
        if (root_.has_group("Header")) read_header();
        read_dim();
        if (!options.open) read_domain();
        read_units();
        read_contents();
        extent_ = options.kernel_extent ? *options.kernel_extent : (swift_ ? swift_extent() : 1.0);
    }

    const SnapshotInfo& info() const override { return info_; }
    ListData read(const std::string& list, const FieldRequest& fields) override;

private:
    void read_header();
    void read_dim();
    void read_domain();
    bool is_periodic() const;
    void read_units();
    void read_contents();
    double swift_extent();
    bool is_empty_by_header(const std::string& type) const;
    bool has_mass(const hdf5::Group& group, const std::string& type) const;
    ConstView<double> read_mass(const hdf5::Group& group, const std::string& type, Offset n) const;
    static std::size_t index_of(const std::string& type) {
        return static_cast<std::size_t>(type[8] - '0');
    }

    hdf5::Group root_;
    SnapshotInfo info_;
    bool swift_;
    Names names_;
    double extent_ = 1;
    std::vector<double> box_size_, mass_table_, n_here_, n_total_;
};

void ParticleTypes::read_header() {
    const auto header = root_.group("Header");
    const auto optional = [&](const char* name) {
        return header.has_attribute(name) ? header.numbers(name) : std::vector<double>{};
    };
    box_size_ = optional("BoxSize");
    mass_table_ = optional("MassTable");
    n_here_ = optional("NumPart_ThisFile");
    n_total_ = optional("NumPart_Total");
    const double n_files = header.number_or("NumFilesPerSnapshot", 1);
    if (n_files > 1 && n_here_ != n_total_)
        throw Error(
            Status::unsupported,
            fmt::format(
                "'{}' is one of {} files of a snapshot; only a snapshot in one file can be read",
                info_.path, n_files));
}

void ParticleTypes::read_dim() {
    double dim = 3;
    if (root_.has_group("Config")) {
        const auto config = root_.group("Config");
        if (config.has_attribute("TWODIMS")) dim = 2;
        if (config.has_attribute("ONEDIMS")) dim = 1;
    }
    if (swift_ && root_.has_group("Header"))
        dim = root_.group("Header").number_or("Dimension", dim);
    if (dim != 1 && dim != 2 && dim != 3)
        throw Error(Status::format,
                    fmt::format("'{}': dimension {}, must be 1, 2 or 3", info_.path, dim));
    info_.dim = static_cast<int>(dim);
}

bool ParticleTypes::is_periodic() const {
    if (swift_ && root_.has_group("Parameters")) {
        const auto periodic = root_.group("Parameters").text("InitialConditions:periodic");
        if (periodic) return *periodic != "0";
    }
    if (!swift_ && root_.has_group("Config"))
        return root_.group("Config").has_attribute("PERIODIC");
    return !box_size_.empty() && box_size_[0] != 0;
}

/// A periodic box begins at 0. GADGET may stretch the axes of its cube at compile time.
void ParticleTypes::read_domain() {
    if (!is_periodic()) return;
    const auto n = box_size_.size();
    if (n != 1 && n < static_cast<std::size_t>(info_.dim))
        throw Error(
            Status::format,
            fmt::format("'{}' is periodic but Header has {} values of BoxSize, must be 1 or {}",
                        info_.path, n, info_.dim));
    for (int d = 0; d < info_.dim; ++d) {
        double length = box_size_[n == 1 ? 0 : static_cast<std::size_t>(d)];
        if (!swift_ && root_.has_group("Config")) {
            const std::string axis = fmt::format("LONG_{}", "XYZ"[d]);
            const auto config = root_.group("Config");
            length *= config.number_or(axis, 1);
            length /= std::exp2(config.number_or(axis + "_BITS", 0));
        }
        info_.domain.periodic[static_cast<std::size_t>(d)] = true;
        info_.domain.hi[static_cast<std::size_t>(d)] = length;
    }
}

void ParticleTypes::read_units() {
    auto& units = info_.units;
    if (swift_ && root_.has_group("Units")) {
        const auto group = root_.group("Units");
        units.length_cm = group.number_or("Unit length in cgs (U_L)", 0);
        units.mass_g = group.number_or("Unit mass in cgs (U_M)", 0);
        if (root_.has_group("Cosmology"))
            units.comoving = root_.group("Cosmology").number_or("Cosmological run", 0) == 1;
    } else if (!swift_ && root_.has_group("Parameters")) {
        const auto group = root_.group("Parameters");
        units.length_cm = group.number_or("UnitLength_in_cm", 0);
        units.mass_g = group.number_or("UnitMass_in_g", 0);
        units.comoving = group.number_or("ComovingIntegrationOn", 0) == 1;
        units.per_h = units.comoving;
    }
}

bool ParticleTypes::is_empty_by_header(const std::string& type) const {
    return index_of(type) < n_here_.size() && n_here_[index_of(type)] == 0;
}

bool ParticleTypes::has_mass(const hdf5::Group& group, const std::string& type) const {
    return group.has_dataset(names_.mass) || (swift_ && group.has_dataset("DynamicalMasses")) ||
           (index_of(type) < mass_table_.size() && mass_table_[index_of(type)] > 0);
}

void ParticleTypes::read_contents() {
    for (const auto& name : type_names(root_)) {
        const auto group = root_.group(name);
        ListInfo list;
        list.name = name;
        if (group.has_dataset("Coordinates")) {
            const auto shape = group.shape("Coordinates");
            if (shape.size() != 2 || (shape[1] != 3 && shape[1] != info_.dim))
                throw Error(Status::format,
                            fmt::format("{} has shape {}, must be [n, 3]",
                                        group.where("Coordinates"), hdf5::text_of(shape)));
            check_positions(group, "Coordinates", shape);
            list.n = list.n_internal = shape[0];
        } else if (!is_empty_by_header(name)) {
            throw Error(Status::format, group.where() + " has no Coordinates");
        }
        list.has_support = group.has_dataset(names_.h);
        list.has_mass = has_mass(group, name);
        info_.lists.push_back(list);
    }
}

double ParticleTypes::swift_extent() {
    std::string kernel;
    if (root_.has_group("HydroScheme"))
        kernel = root_.group("HydroScheme").text("Kernel function").value_or("");
    info_.detail = kernel;
    const double gamma = swift_gamma(kernel, info_.dim);
    if (gamma > 0) return gamma;
    throw Error(
        Status::format,
        fmt::format(
            "'{}' does not tell SWIFT's kernel, so the ratio of support to smoothing length is "
            "unknown: give the kernel extent (1.825742 for the cubic spline in 3D)",
            info_.path));
}

ConstView<double> ParticleTypes::read_mass(const hdf5::Group& group, const std::string& type,
                                           Offset n) const {
    if (group.has_dataset(names_.mass)) return read_field(group, names_.mass, n);
    if (swift_ && group.has_dataset("DynamicalMasses"))
        return read_field(group, "DynamicalMasses", n);
    auto mass = allocate<double>("io/mass", n);
    Kokkos::deep_copy(mass, mass_table_[index_of(type)]);
    return mass;
}

ListData ParticleTypes::read(const std::string& list, const FieldRequest& fields) {
    const auto& entry = info_.lists[find_list(info_, list)];
    const auto group = root_.group(list);
    const Offset n = entry.n;
    auto positions = allocate<double>("io/positions", n * info_.dim);
    if (n > 0) group.read("Coordinates", positions.data(), n, info_.dim);
    const ConstView<double> h =
        entry.has_support ? read_field(group, names_.h, n) : allocate_zeroed<double>("io/h", n);
    ListData data{NodeList::with_h(list, info_.dim, n, positions, h, extent_)};
    if (fields.mass && entry.has_mass) data.mass = read_mass(group, list, n);
    if (fields.density && group.has_dataset(names_.density))
        data.density = read_field(group, names_.density, n);
    if (fields.global_id && group.has_dataset("ParticleIDs"))
        data.global_id = read_ids(group, "ParticleIDs", n);
    return data;
}

}  // namespace

bool is_particle_type_file(const hdf5::Group& root) { return !type_names(root).empty(); }

std::unique_ptr<SnapshotReader> open_particle_types(hdf5::Group root, SnapshotInfo info,
                                                    const ReadOptions& options) {
    return std::make_unique<ParticleTypes>(std::move(root), std::move(info), options);
}

}  // namespace connectivity::io
