// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Structs of views: filled once, and emptied when their owner is let go.

#include <memory>

#include "registry.hpp"
#include "structs.hpp"

namespace connectivity::capi {

/// Throws Error{argument}, Error{unsupported} for a space that no list of this build is in.
void check_space(std::int32_t space);

/// The host's struct, ready to be filled. Throws Error{argument} if it pins something already.
template <class T>
T read_view(const T* view, const T& empty) {
    const T given = read_struct(view, empty, "view");
    if (given.owner != nullptr)
        throw Error(
            Status::argument,
            "view->owner is set: the view was not initialised, or still holds another view");
    T ours = empty;
    ours.struct_size = given.struct_size;
    return ours;
}

/// Fills the host's struct; the registry keeps what it points into.
template <class T, class Pin>
void write_view(T* view, T out, std::unique_ptr<Pin> pin) {
    out.owner = Registry::instance().add(std::move(pin));
    write_struct(view, out, out.struct_size);
}

template <class Pin, class T>
void release_view(T* view, const T& empty) {
    if (view == nullptr) return;
    T given = read_struct(view, empty, "view");
    auto* pin = static_cast<Pin*>(given.owner);
    Registry::instance().destroy(&pin, "view->owner");
    write_struct(view, empty, given.struct_size);
}

}  // namespace connectivity::capi
