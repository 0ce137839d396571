// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/io/lists_input.hpp>

#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <connectivity/base/runtime.hpp>

#include "io/readers.hpp"

namespace connectivity {

namespace {

using nlohmann::json;

/// The attribute `params`. Absent keys and null are the same.
class Params {
public:
    explicit Params(const hdf5::Group& root) : where_(root.where() + ": params") {
        if (!root.has_attribute("params")) return;
        const auto text = root.text("params");
        if (!text) throw Error(Status::format, where_ + " is no string");
        values_ = json::parse(*text, nullptr, false);
        if (!values_.is_object()) throw Error(Status::format, where_ + " is no JSON object");
    }

    bool has(const std::string& key) const {
        return values_.contains(key) && !values_[key].is_null();
    }
    std::int32_t integer(const std::string& key, std::int32_t lowest) const {
        constexpr std::int64_t highest = std::numeric_limits<std::int32_t>::max();
        const json& value = values_[key];
        if (!value.is_number_integer() || value < lowest || value > highest)
            refuse(key, fmt::format("a whole number from {} to {}", lowest, highest));
        return value.get<std::int32_t>();
    }
    double number(const std::string& key) const {
        if (!values_[key].is_number()) refuse(key, "a number");
        return values_[key].get<double>();
    }
    bool flag(const std::string& key) const {
        if (!has(key)) return false;
        if (!values_[key].is_boolean()) refuse(key, "true or false");
        return values_[key].get<bool>();
    }
    template <class Enum>
    Enum choice(const std::string& key, const std::map<std::string, Enum>& names) const {
        const json& value = values_[key];
        const auto found = value.is_string() ? names.find(value.get<std::string>()) : names.end();
        if (found == names.end()) {
            std::vector<std::string> allowed;
            for (const auto& [name, meaning] : names) allowed.push_back(name);
            refuse(key, fmt::format("one of {}", fmt::join(allowed, ", ")));
        }
        return found->second;
    }

    [[noreturn]] void refuse(const std::string& key, const std::string& allowed) const {
        throw Error(Status::format,
                    fmt::format("{}: {} = {:.60}, must be {}", where_, key,
                                has(key) ? values_[key].dump() : "absent", allowed));
    }

private:
    std::string where_;
    json values_ = json::object();
};

int read_dim(const hdf5::Group& root, const Params& params) {
    const auto shape = root.shape("in_sources");
    if (shape.size() != 2 || shape[1] < 1 || shape[1] > 3)
        throw Error(Status::format,
                    fmt::format("{} has shape {}, must be [n, d] with d = 1, 2 or 3",
                                root.where("in_sources"), hdf5::text_of(shape)));
    const int dim = static_cast<int>(shape[1]);
    if (params.has("d") && params.integer("d", 1) != dim)
        params.refuse("d",
                      fmt::format("{}, as in_sources has shape {}", dim, hdf5::text_of(shape)));
    return dim;
}

ListsInputArray read_array(const hdf5::Group& root, const std::string& name,
                           const hdf5::Shape& shape, CoordinateType type) {
    const Offset n = shape[0], columns = shape.size() > 1 ? shape[1] : 1;
    root.require(name, shape);
    ListsInputArray out;
    const auto read = [&]<class T>(ConstView<T>& target) {
        auto values = allocate<T>("io/" + name, n * columns);
        root.read(name, values.data(), n, columns);
        target = values;
    };
    type == CoordinateType::float32 ? read(out.float32) : read(out.float64);
    return out;
}

ListsInput::Particles read_particles(const hdf5::Group& root, const std::string& kind,
                                     const ListsInput& input) {
    const std::string name = "in_" + kind + "s", radii = "in_" + kind + "_radii";
    const auto shape = root.shape(name);
    if (shape.size() != 2 || shape[1] != input.dim)
        throw Error(Status::format, fmt::format("{} has shape {}, must be [n, {}]",
                                                root.where(name), hdf5::text_of(shape), input.dim));
    io::check_positions(root, name, shape);
    ListsInput::Particles out;
    out.n = shape[0];
    out.positions = read_array(root, name, shape, input.coordinates);
    if (root.has_dataset(radii)) out.radii = read_array(root, radii, {out.n}, input.coordinates);
    return out;
}

void read_limit(const hdf5::Group& root, const Params& params, ListsInput& input) {
    const std::string name = "in_refine_weights";
    if (!root.has_dataset(name)) {
        if (params.has("maxw")) params.refuse("maxw", "absent, as there is no dataset " + name);
        input.tree.max_particles_in_box = params.has("leaf") ? params.integer("leaf", 1) : 64;
        return;
    }
    const Offset n = input.sources.n + (input.targets ? input.targets->n : 0);
    root.require(name, {n}, true);
    auto weights = allocate<std::int32_t>("io/" + name, n);
    root.read(name, weights.data(), n);
    input.refine_weights = weights;
    if (!params.has("maxw") || params.has("leaf"))
        params.refuse(params.has("leaf") ? "leaf" : "maxw",
                      params.has("leaf") ? "absent, as there are refine weights"
                                         : "given, as there are refine weights");
    input.tree.max_leaf_refine_weight = params.integer("maxw", 1);
}

void read_options(const Params& params, ListsInput& input) {
    if (params.has("kind")) input.tree.kind = params.choice("kind", tree_kind_names());
    if (params.has("norm")) input.tree.extent_norm = params.choice("norm", extent_norm_names());
    const double stick_out = params.has("sof") ? params.number("sof") : 0;
    if (input.have_radii()) input.tree.stick_out_factor = stick_out;  // boxtree's rule
    if (params.has("n_away")) input.lists.well_sep_is_n_away = params.integer("n_away", 1);
    if (params.has("crit"))
        input.lists.from_sep_smaller_crit = params.choice("crit", from_sep_smaller_crit_names());
    if (params.has("minsrc"))
        input.lists.from_sep_smaller_min_nsources_cumul = params.integer("minsrc", 0);
    input.tree_only = params.flag("notrav");
}

}  // namespace

const std::map<std::string, TreeKind>& tree_kind_names() {
    static const std::map<std::string, TreeKind> names{
        {"adaptive", TreeKind::adaptive},
        {"adaptive-level-restricted", TreeKind::adaptive_level_restricted},
        {"non-adaptive", TreeKind::non_adaptive}};
    return names;
}

const std::map<std::string, ExtentNorm>& extent_norm_names() {
    static const std::map<std::string, ExtentNorm> names{{"linf", ExtentNorm::linf},
                                                         {"l2", ExtentNorm::l2}};
    return names;
}

const std::map<std::string, FromSepSmallerCrit>& from_sep_smaller_crit_names() {
    static const std::map<std::string, FromSepSmallerCrit> names{
        {"static_linf", FromSepSmallerCrit::static_linf},
        {"precise_linf", FromSepSmallerCrit::precise_linf},
        {"static_l2", FromSepSmallerCrit::static_l2}};
    return names;
}

TreeInput ListsInput::particles() const {
    const auto array_of = [&](const Particles& p) {
        auto out = ParticleArray::interleaved(p.positions.data(), p.n, dim);
        out.radii = p.radii.data();
        return out;
    };
    TreeInput input;
    input.dim = dim;
    input.coordinates = coordinates;
    input.sources = array_of(sources);
    if (targets) input.targets = array_of(*targets);
    if (tree.max_leaf_refine_weight && refine_weights.size() > 0)
        input.refine_weights = refine_weights.data();
    return input;
}

bool is_lists_input(const std::string& path) {
    const auto root = hdf5::Group::open_file(path);
    return root.has_dataset("in_sources") || root.has_dataset("in_targets") ||
           root.has_attribute("params");
}

ListsInput read_lists_input(const std::string& path) {
    start_runtime();
    const auto root = hdf5::Group::open_file(path);
    const Params params(root);
    ListsInput input;
    input.dim = read_dim(root, params);
    if (params.flag("f32")) input.coordinates = CoordinateType::float32;
    input.sources = read_particles(root, "source", input);
    if (root.has_dataset("in_targets")) input.targets = read_particles(root, "target", input);
    if (!input.targets && root.has_dataset("in_target_radii"))
        throw Error(Status::format, root.where() + " has in_target_radii and no in_targets");
    read_limit(root, params, input);
    read_options(params, input);
    return input;
}

}  // namespace connectivity
