// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A host's function for rows that are found but not stored: a light reference, as two pointers.
///
/// Invariant: the callable outlives the reference. Cost: one indirect call a row.

#include <exception>
#include <memory>
#include <span>
#include <type_traits>

#include <connectivity/base/types.hpp>

namespace connectivity {

/// Refers to any f(int worker, Slot slot, std::span<const Slot> neighbours). The span is valid
/// during the call only.
class RowFunction {
public:
    template <class F,
              class = std::enable_if_t<!std::is_same_v<std::remove_cvref_t<F>, RowFunction> &&
                                       std::is_object_v<std::remove_reference_t<F>> &&
                                       std::is_invocable_v<F&, int, Slot, std::span<const Slot>>>>
    RowFunction(F&& f)
        : object_(const_cast<void*>(static_cast<const void*>(std::addressof(f)))),
          call_([](void* object, int worker, Slot slot, std::span<const Slot> neighbours) {
              (*static_cast<std::remove_reference_t<F>*>(object))(worker, slot, neighbours);
          }) {}

    void operator()(int worker, Slot slot, std::span<const Slot> neighbours) const {
        call_(object_, worker, slot, neighbours);
    }

private:
    void* object_;
    void (*call_)(void*, int, Slot, std::span<const Slot>);
};

/// What a RowFunction threw, on its way out of a search: told apart from the search's own errors.
struct HostException {
    std::exception_ptr cause;
};

}  // namespace connectivity
