// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/boundary/requirements.hpp>

#include <connectivity/base/error.hpp>

namespace connectivity {

namespace {

/// Whether a list "a, b" holds the name.
bool names(const std::string& list, std::string_view name) {
    return (", " + list + ", ").find(", " + std::string(name) + ", ") != std::string::npos;
}

}  // namespace

Requirements& Requirements::add(std::string_view package, std::initializer_list<Need> needs) {
    if (package.empty())
        throw Error(Status::argument, "requirements: a package without a name, must have one");
    for (const Need need : needs) {
        std::string& asked_by = asked_by_[static_cast<std::size_t>(need)];
        if (names(asked_by, package)) continue;
        if (!asked_by.empty()) asked_by += ", ";
        asked_by += package;
    }
    return *this;
}

MapOptions Requirements::options(MapOptions base) const {
    base.rows = has(Need::rows);
    base.pairs = has(Need::pairs);
    base.ghost_rows = has(Need::ghost_rows);
    base.overlap = has(Need::overlap);
    base.intersection = has(Need::unfiltered_intersection) ? IntersectionKind::all
                        : has(Need::intersection)          ? IntersectionKind::in_segment
                                                           : IntersectionKind::none;
    base.order = has(Need::key_order) ? ListOrder::key : ListOrder::slot;
    base.spatial_order = has(Need::spatial_order);
    return base;
}

}  // namespace connectivity
