// SPDX-License-Identifier: BSD-3-Clause
#include "program/describe.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <sys/resource.h>

#include "program/units.hpp"

namespace connectivity::program {

namespace {

std::string describe_support(const NodeList& nodes) {
    if (nodes.n() == 0) return "none";
    if (nodes.has_tensor()) return "tensor H";
    const auto* const h = nodes.h().data();
    const auto [least, most] = std::minmax_element(h, h + nodes.n());
    if (*most == 0) return "h = 0: sees nobody";
    return fmt::format("h = {:.6g} ... {:.6g}", *least, *most);
}

}  // namespace

std::string describe_domain(const Domain& domain, int dim, const std::string& unit) {
    if (!domain.any_periodic(dim)) return "open";
    std::string lengths;
    for (int d = 0; d < dim; ++d) {
        const auto k = static_cast<std::size_t>(d);
        lengths += (d > 0 ? " x " : "") +
                   (domain.periodic[k] ? fmt::format("{:.10g}", domain.length(d)) : "open");
    }
    return "periodic " + lengths + (unit.empty() ? "" : " " + unit);
}

std::string describe_input(const SnapshotInfo& info) {
    const std::string length = length_unit(info.units), mass = mass_unit(info.units);
    std::string text = fmt::format("{}: {}, {}D, {}", info.path, info.format, info.dim,
                                   describe_domain(info.domain, info.dim, length));
    if (!info.detail.empty()) text += fmt::format(", {}", info.detail);
    if (!mass.empty()) text += fmt::format("; masses in {}", mass);
    return text;
}

std::string describe_lists(std::span<const ListData> lists) {
    std::string text = fmt::format("{:<20}{:>12}{:>12}{:>10}{:>9}  {}", "list", "nodes", "internal",
                                   "ghosts", "extent", "supports");
    for (const auto& list : lists) {
        const auto& nodes = list.nodes;
        text += fmt::format("\n{:<20}{:>12}{:>12}{:>10}{:>9.6g}  {}", nodes.name(), nodes.n(),
                            nodes.n_internal(), nodes.n_ghosts(), nodes.kernel_extent(),
                            describe_support(nodes));
    }
    return text;
}

std::string describe_counts(const std::vector<PlotCounts>& counts) {
    std::string text =
        fmt::format("{:<20}{:>7}{:>7}{:>7}{:>7}{:>7}{:>7}{:>7}{:>10}{:>10}", "neighbours of", "min",
                    "1 %", "10 %", "median", "90 %", "99 %", "max", "mean", "isolated");
    for (const auto& [list, c] : counts)
        text += fmt::format("\n{:<20}{:>7}{:>7}{:>7}{:>7}{:>7}{:>7}{:>7}{:>10.3f}{:>10}", list,
                            c.min(), c.percentile(1), c.percentile(10), c.percentile(50),
                            c.percentile(90), c.percentile(99), c.max(), c.mean, c.isolated());
    return text;
}

Offset peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<Offset>(usage.ru_maxrss) * 1024;
}

}  // namespace connectivity::program
