// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "arguments.hpp"
#include "guard.hpp"
#include "objects.hpp"
#include "tree_objects.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

conn_tree& handle_of(conn_tree* tree) { return Registry::instance().get<conn_tree>(tree, "tree"); }
const conn_tree& handle_of(const conn_tree* tree) {
    return Registry::instance().get<const conn_tree>(tree, "tree");
}

std::optional<std::int32_t> read_limit(std::int32_t limit) {
    if (limit == -1) return {};
    return limit;
}

TreeOptions read_options(const conn_tree_options* given, std::int64_t context_budget) {
    const conn_tree_options o =
        read_struct(given, conn_tree_options CONN_TREE_OPTIONS_INIT, "options");
    check_reserved(o.reserved, "options");
    TreeOptions options;
    options.kind = read_choice<TreeKind>(o.kind, 0, CONN_TREE_NON_ADAPTIVE, "kind");
    options.max_particles_in_box = read_limit(o.max_particles_in_box);
    options.max_leaf_refine_weight = read_limit(o.max_leaf_refine_weight);
    options.extent_norm =
        read_choice<ExtentNorm>(o.extent_norm, CONN_EXTENT_LINF, CONN_EXTENT_L2, "extent_norm");
    if (o.stick_out_factor != -1) options.stick_out_factor = o.stick_out_factor;
    options.coincident =
        read_choice<Coincident>(o.coincident, 0, CONN_COINCIDENT_LEAF, "coincident");
    options.hulls = read_choice<Hulls>(o.hulls, 0, CONN_HULLS_NEVER, "hulls");
    options.skip_prune = read_flag(o.skip_prune, "options->skip_prune");
    if (read_flag(o.bounding_box, "options->bounding_box")) {
        TreeOptions::Box& box = options.bounding_box.emplace();
        std::copy_n(o.box_lo, 3, box.lo.begin());
        std::copy_n(o.box_hi, 3, box.hi.begin());
    }
    for (std::size_t d = 0; d < 3; ++d)
        options.periodic[d] =
            read_flag(o.periodic[d], "options->periodic[" + std::to_string(d) + "]");
    options.budget.bytes = read_budget(o.budget_bytes, context_budget);
    return options;
}

/// `keeper` holds what the host's arrays must be copied for.
TreeInput read_input(const conn_tree_input* given, HostParticles& keeper) {
    const conn_tree_input in = read_struct(given, conn_tree_input CONN_TREE_INPUT_INIT, "input");
    check_reserved(in.reserved, "input");
    if (in.dim < 1 || in.dim > 3)
        throw Error(Status::argument,
                    "input->dim = " + std::to_string(in.dim) + ", must be 1, 2 or 3");
    if (in.targets == nullptr && in.target_radii != nullptr)
        throw Error(Status::null, "input->targets is NULL, but input->target_radii is not");
    TreeInput input;
    input.dim = in.dim;
    input.sources =
        keeper.read(in.sources, in.n_sources, in.dim, in.source_radii, "sources", "source_radii");
    if (in.targets != nullptr)
        input.targets = keeper.read(in.targets, in.n_targets, in.dim, in.target_radii, "targets",
                                    "target_radii");
    input.coordinates = keeper.coordinates();
    if (in.refine_weights != nullptr)
        input.refine_weights = keeper.read_weights(
            *in.refine_weights, input.sources.n + (input.targets ? input.targets->n : 0));
    return input;
}

}  // namespace

namespace connectivity::capi {

const conn_tree& built_tree(const conn_tree* tree) {
    const conn_tree& ours = handle_of(tree);
    if (ours.generation == 0)
        throw Error(Status::not_built,
                    "tree has no boxes; call conn_tree_build or conn_tree_set_boxes first");
    return ours;
}

std::uint64_t next_tree_generation() {
    static std::uint64_t last = 0;
    return ++last;
}

void check_reserved(std::int32_t reserved, const char* name) {
    if (reserved != 0)
        throw Error(Status::unsupported, std::string(name) + "->reserved is set, must be 0");
}

std::int64_t read_budget(std::int64_t bytes, std::int64_t context_budget) {
    if (bytes < 0)
        throw Error(Status::argument,
                    "options->budget_bytes = " + std::to_string(bytes) + ", must be >= 0");
    return bytes > 0 ? bytes : context_budget;
}

void copy_text_out(const std::string& lines, char* text, std::int64_t capacity,
                   std::int64_t* length) {
    const auto n = static_cast<std::int64_t>(lines.size());
    required(length, "length") = n;
    if (text == nullptr) return;
    check_capacity(capacity, n + 1);
    std::copy_n(lines.c_str(), n + 1, text);
}

}  // namespace connectivity::capi

conn_status conn_tree_options_init(conn_tree_options* options, size_t size) {
    return guarded(__func__, [&] {
        init_struct(options, size, conn_tree_options CONN_TREE_OPTIONS_INIT, "options");
    });
}

conn_status conn_tree_create(conn_context* context, conn_tree** tree) {
    return guarded_with_runtime(__func__, [&] {
        const auto& ours = Registry::instance().get<conn_context>(context, "context");
        required(tree, "tree") =
            Registry::instance().add(std::make_unique<conn_tree>(ours.budget_bytes));
    });
}

conn_status conn_tree_destroy(conn_tree** tree) {
    return guarded(__func__, [&] { Registry::instance().destroy(tree, "tree"); });
}

conn_status conn_tree_build(conn_tree* tree, const conn_tree_input* input,
                            const conn_tree_options* options) {
    return guarded_with_runtime(__func__, [&] {
        conn_tree& ours = handle_of(tree);
        const TreeOptions choices = read_options(options, ours.context_budget);
        HostParticles particles;
        const TreeInput particles_in = read_input(input, particles);
        ours.builder->build(particles_in, choices);
        ours.given.reset();
        ours.generation = next_tree_generation();
    });
}

conn_status conn_tree_memory(const conn_tree* tree, int64_t* bytes, int64_t* scratch_bytes) {
    return guarded_with_runtime(__func__, [&] {
        const conn_tree& ours = handle_of(tree);
        if (bytes != nullptr) *bytes = ours.given ? ours.given_bytes : ours.builder->bytes();
        if (scratch_bytes != nullptr) *scratch_bytes = ours.builder->scratch_bytes();
    });
}

conn_status conn_tree_release_scratch(conn_tree* tree) {
    return guarded_with_runtime(__func__, [&] { handle_of(tree).builder->release_scratch(); });
}

conn_status conn_tree_report_text(const conn_tree* tree, char* text, int64_t capacity,
                                  int64_t* length) {
    return guarded_with_runtime(__func__, [&] {
        copy_text_out(handle_of(tree).builder->report().text(), text, capacity, length);
    });
}
