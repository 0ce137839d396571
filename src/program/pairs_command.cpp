// SPDX-License-Identifier: BSD-3-Clause
// `connectivity pairs`: read, search, report; on request density, result file and picture.
#include <algorithm>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/io/result_file.hpp>

#include "program/commands.hpp"
#include "program/console.hpp"
#include "program/cull.hpp"
#include "program/density.hpp"
#include "program/describe.hpp"
#include "program/outputs.hpp"
#include "program/plot.hpp"
#include "program/units.hpp"

namespace connectivity::program {

namespace {

class PairsRun {
public:
    explicit PairsRun(const PairsOptions& options)
        : options_(options),
          reader_(open_snapshot(options.file, {options.extent, options.step, options.open})),
          names_(select_lists(reader_->info(), options.lists)),
          console_(static_cast<int>(names_.size() * (options.density ? 2 : 1)) + 1 +
                   !options.out.empty() + !options.plot.empty() + options.cull) {}

    void run() {
        Console::line(describe_input(reader_->info()));
        read();
        search();
        if (options_.cull) cull();
        describe_result();
        if (options_.density) compute_densities();
        if (!options_.out.empty()) console_.phase("writing " + options_.out, [&] { write(); });
        if (!options_.plot.empty()) console_.phase("drawing " + options_.plot, [&] { draw(); });
        Console::line(fmt::format("\npeak memory {}", human_bytes(peak_memory())));
    }

private:
    void read();
    void search();
    void cull();
    void describe_result();
    void compute_densities();
    void compare(std::size_t k);
    void write();
    void draw();
    std::vector<ListData> lists_to_draw() const;

    const PairsOptions& options_;
    std::unique_ptr<SnapshotReader> reader_;
    std::vector<std::string> names_;
    Console console_;
    std::vector<ListData> lists_;
    std::vector<NodeList> nodes_;
    ConnectivityMap map_;
    NewSlots new_slots_;  // of culling
    std::vector<PlotCounts> counts_;
    std::vector<std::optional<ConstView<double>>> densities_;  // [n_lists] if asked for
};

void PairsRun::read() {
    FieldRequest fields;
    fields.mass = options_.density || !options_.plot.empty();
    fields.density = options_.density;
    fields.global_id = options_.order == ListOrder::key;
    for (const auto& name : names_)
        console_.phase("reading " + name, [&] { lists_.push_back(reader_->read(name, fields)); });
    for (auto& list : lists_) {
        if (list.global_id.size() > 0) list.nodes.set_global_ids(list.global_id);
        nodes_.push_back(list.nodes);
    }
    Console::line("\n" + describe_lists(lists_) + "\n");
}

void PairsRun::search() {
    MapOptions options;
    options.ghost_rows = options_.ghost_rows;
    options.overlap = options_.overlap;
    options.intersection = options_.intersection;
    options.order = options_.order;
    options.method = options_.method;
    options.domain = reader_->info().domain;
    options.budget.bytes = static_cast<Offset>(options_.budget);
    console_.phase(fmt::format("searching with {} thread{}", runtime_threads(),
                               runtime_threads() == 1 ? "" : "s"),
                   [&] { map_.rebuild(nodes_, options); });
}

void PairsRun::cull() {
    const Offset before = map_.layout().n_slots();
    console_.phase("culling ghosts", [&] { new_slots_ = cull_ghosts(map_, lists_); });
    nodes_.clear();
    for (const auto& list : lists_) nodes_.push_back(list.nodes);
    Console::line(fmt::format(
        "{} of {} ghosts culled", before - map_.layout().n_slots(),
        before - std::accumulate(map_.n_internal().begin(), map_.n_internal().end(), Offset{0})));
}

void PairsRun::describe_result() {
    for (std::size_t k = 0; k < nodes_.size(); ++k)
        counts_.push_back(
            {names_[k], neighbour_statistics(map_, static_cast<int>(k), nodes_[k].n_internal())});
    Console::line("\n" + map_.report().text());
    const Offset n_pairs = map_.pairs().size();
    Console::line(fmt::format("{} rows, {} row entries, {} unique pairs", map_.layout().n_rows(),
                              map_.rows().size(), n_pairs));
    if (n_pairs > 0)
        Console::line(
            fmt::format("{:.2f} bytes a pair in the pair list",
                        static_cast<double>(map_.pairs().bytes()) / static_cast<double>(n_pairs)));
    if (options_.overlap) Console::line(fmt::format("{} overlap entries", map_.overlap().size()));
    if (options_.intersection != IntersectionKind::none)
        Console::line(fmt::format("{} intersection entries", map_.intersection().size()));
    Console::line("\n" + describe_counts(counts_) + "\n");
}

void PairsRun::compute_densities() {
    densities_.resize(lists_.size());
    for (std::size_t k = 0; k < lists_.size(); ++k) {
        const auto& list = lists_[k];
        const auto& info = reader_->info().lists;
        const auto entry =
            std::find_if(info.begin(), info.end(), [&](auto& e) { return e.name == names_[k]; });
        if (!entry->has_support || !entry->has_mass || list.nodes.has_tensor()) {
            Console::line(fmt::format(
                "no density of {}: {}", names_[k],
                entry->has_mass ? "it has no smoothing lengths h" : "it has no masses"));
            continue;
        }
        console_.phase("density of " + names_[k], [&] {
            densities_[k] = density(map_, static_cast<int>(k), list.nodes, list.mass);
        });
        compare(k);
    }
}

void PairsRun::compare(std::size_t k) {
    const auto& theirs = lists_[k].density;
    if (theirs.size() == 0) return;
    const auto difference = relative_difference(*densities_[k], theirs);
    Console::line(fmt::format(
        "density of {} against the file's own: rms {:.2e}, max {:.2e} relative ({} nodes)",
        names_[k], difference.rms, difference.max, difference.n));
}

void PairsRun::write() {
    ResultFile out(options_.out);
    out.write(map_, options_.command);
    if (options_.cull) out.write_cull(new_slots_);
    const auto& info = reader_->info();
    for (std::size_t k = 0; k < densities_.size(); ++k)
        if (densities_[k])
            out.write_density(names_[k], *densities_[k], density_unit(info.units, info.dim));
    out.commit();
}

/// Lists whose nodes have an extent to paint; if none has, all of them as points.
std::vector<ListData> PairsRun::lists_to_draw() const {
    const auto& info = reader_->info();
    std::vector<ListData> smooth;
    for (const auto& list : lists_)
        for (const auto& entry : info.lists)
            if (entry.name == list.nodes.name() && entry.has_support) smooth.push_back(list);
    return smooth.empty() ? lists_ : smooth;
}

void PairsRun::draw() {
    constexpr int pixels = 640;
    const auto& info = reader_->info();
    const auto drawn = lists_to_draw();
    std::vector<std::string> names;
    names.reserve(drawn.size());
    for (const auto& list : drawn) names.push_back(list.nodes.name());
    PlotContent content;
    content.dim = info.dim;
    content.length_unit = length_unit(info.units);
    content.mass_unit = mass_unit(info.units);
    content.map = surface_density(drawn, info.domain, pixels);
    content.counts = counts_;
    content.title = std::filesystem::path(options_.file).filename().string();
    content.map_title =
        fmt::format("{}{}", fmt::join(names, ", "), info.dim == 3 ? ", projected along z" : "");
    content.caption =
        fmt::format("{} nodes, {} unique pairs; {}", map_.layout().n_slots(), map_.pairs().size(),
                    describe_domain(info.domain, info.dim, content.length_unit));
    plot(options_.plot, content);
}

}  // namespace

void run_pairs(const PairsOptions& options) {
    check_outputs(options.file, {options.out, options.plot});
    if (!options.plot.empty()) require_plotting(options.plot);
    start_runtime({.n_threads = options.n_threads});
    PairsRun(options).run();
}

}  // namespace connectivity::program
