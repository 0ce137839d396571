// SPDX-License-Identifier: BSD-3-Clause
#include "program/gravity_particles.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include <connectivity/base/error.hpp>

namespace connectivity::program {

namespace {

/// Also that the lists have masses, before anything large is read.
GravityLists table_of(const SnapshotInfo& info, const std::vector<std::string>& names) {
    GravityLists lists;
    for (const auto& name : names) {
        const auto list = std::find_if(info.lists.begin(), info.lists.end(),
                                       [&](const auto& entry) { return entry.name == name; });
        if (!list->has_mass && list->n > 0)
            throw Error(Status::format,
                        fmt::format("'{}': list '{}' has no masses, which gravity needs; --list "
                                    "chooses others",
                                    info.path, name));
        lists.names.push_back(name);
        lists.n.push_back(list->n);
        lists.n_internal.push_back(list->n_internal);
    }
    return lists;
}

}  // namespace

GravityParticles GravityInput::particles() const {
    auto particles = GravityParticles::interleaved(positions.data(), mass.data(), n(), dim);
    if (softening.size() > 0) particles.softening = softening.data();
    return particles;
}

std::pair<Offset, Offset> GravityInput::rows(std::size_t k) const {
    const auto at = lists.n_internal.begin() + static_cast<std::ptrdiff_t>(k);
    const Offset first = std::accumulate(lists.n_internal.begin(), at, Offset{0});
    return {first, first + *at};
}

GravityInput read_gravity_input(SnapshotReader& reader, const std::vector<std::string>& names) {
    GravityInput input;
    input.lists = table_of(reader.info(), names);
    input.dim = reader.info().dim;
    const Offset n =
        std::accumulate(input.lists.n_internal.begin(), input.lists.n_internal.end(), Offset{0});
    if (n > max_slots)
        throw Error(Status::too_many,
                    fmt::format("the lists have {} internal nodes, at most {} fit", n, max_slots));
    input.positions = allocate<double>("program/positions", n * input.dim);
    input.mass = allocate<double>("program/mass", n);
    Offset at = 0;
    for (const auto& name : names) {
        const ListData list = reader.read(name, {.mass = true, .softening = true});
        const Offset count = list.nodes.n_internal();
        std::copy_n(list.nodes.positions().data(), count * input.dim,
                    input.positions.data() + at * input.dim);
        if (count > 0) std::copy_n(list.mass.data(), count, input.mass.data() + at);
        if (list.softening.size() > 0) {
            if (input.softening.size() == 0)
                input.softening = allocate_zeroed<double>("program/softening", n);
            std::copy_n(list.softening.data(), count, input.softening.data() + at);
        }
        at += count;
    }
    return input;
}

}  // namespace connectivity::program
