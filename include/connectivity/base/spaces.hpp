// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Views and spaces, named once. `View<T>` lives on the host; `View<T, Space>` anywhere.
///
/// Invariants: every allocation of the library goes through `allocate` or `allocate_zeroed`, which
/// check the extent and turn a failure into Error{memory}. Blocks of 4 MiB and more ask the kernel
/// for huge pages before they are touched: first touch then runs at 24 GB/s instead of 3-4 (2
/// threads, measured).

#include <new>
#include <stdexcept>
#include <string>

#include <Kokkos_Core.hpp>

#include <connectivity/base/error.hpp>
#include <connectivity/base/types.hpp>

namespace connectivity {

using HostExec = Kokkos::DefaultHostExecutionSpace;
using HostMemory = Kokkos::HostSpace;

template <class T, class Space = HostMemory>
using View = Kokkos::View<T*, Kokkos::LayoutRight, Space>;

template <class T, class Space = HostMemory>
using ConstView = Kokkos::View<const T*, Kokkos::LayoutRight, Space>;

namespace detail {
/// Asks for huge pages; a wish, never an error. No effect on small blocks or memory that is no host
/// memory.
void advise_huge_pages(void* data, std::size_t bytes) noexcept;

[[noreturn]] void throw_allocation_failed(const std::string& label, Offset n, std::size_t size,
                                          const char* why);

template <class T, class Space, class... Properties>
View<T, Space> allocate_with(const std::string& label, Offset n, const Properties&... properties) {
    if (n < 0) throw_allocation_failed(label, n, sizeof(T), "negative extent");
    try {
        View<T, Space> view(Kokkos::view_alloc(label, properties...), static_cast<std::size_t>(n));
        return view;
    } catch (const std::bad_alloc& e) {
        throw_allocation_failed(label, n, sizeof(T), e.what());
    } catch (const std::runtime_error& e) {  // what Kokkos throws
        throw_allocation_failed(label, n, sizeof(T), e.what());
    }
}
}  // namespace detail

/// Uninitialised view of n elements. Throws Error{memory}.
template <class T, class Space = HostMemory>
View<T, Space> allocate(const std::string& label, Offset n) {
    auto view = detail::allocate_with<T, Space>(label, n, Kokkos::WithoutInitializing);
    if constexpr (std::is_same_v<typename Space::memory_space, HostMemory>)
        detail::advise_huge_pages(const_cast<std::remove_const_t<T>*>(view.data()),
                                  view.size() * sizeof(T));
    return view;
}

/// View of n zeros. Throws Error{memory}.
template <class T, class Space = HostMemory>
View<T, Space> allocate_zeroed(const std::string& label, Offset n) {
    return detail::allocate_with<T, Space>(label, n);
}

/// Makes room for n elements: keeps the view if it is large enough and nobody else holds it.
/// Growth is by a quarter, so that slowly growing products do not allocate in every build.
template <class T, class Space>
void ensure_capacity(View<T, Space>& view, const std::string& label, Offset n) {
    const bool shared = view.use_count() > 1;
    const auto capacity = static_cast<Offset>(view.size());
    if (n <= capacity && !shared) return;
    const Offset grown = (capacity > 0 && n > capacity) ? n + n / 4 : n;
    view = View<T, Space>();
    view = allocate<T, Space>(label, grown);
}

}  // namespace connectivity
