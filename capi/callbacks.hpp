// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Functions of the host as the C++ side calls them. While one runs, its thread must not call the
/// library; what it says by conn_set_error is dropped. What it throws, which the header forbids,
/// goes on as an error of ours.

#include <exception>
#include <string>

#include "connectivity.h"
#include "guard.hpp"
#include "index_base.hpp"

namespace connectivity::capi {

/// function(arguments...) of the host. Throws Error{callback} instead of what it throws.
template <class F, class... Arguments>
auto call_host(F function, Arguments... arguments) {
    try {
        return function(arguments...);
    } catch (const std::exception& e) {
        throw Error(Status::callback, std::string("the callback threw: ") + e.what());
    } catch (...) {
        throw Error(Status::callback, "the callback threw something that is no std::exception");
    }
}

template <class F, class... Arguments>
auto ask_host(F function, Arguments... arguments) {
    CallbackScope scope;
    const auto answer = call_host(function, arguments...);
    scope.clear_error();
    return answer;
}

struct HostPredicate {
    conn_pair_predicate predicate;
    void* user_data;
    IndexBase base;

    bool operator()(std::int32_t i, std::int32_t j) const {
        return ask_host(predicate, user_data, base.out(i), base.out(j)) != 0;
    }
};

struct HostFunction {
    conn_pair_function function;
    void* user_data;
    IndexBase base;

    double operator()(std::int32_t i, std::int32_t j) const {
        return ask_host(function, user_data, base.out(i), base.out(j));
    }
};

}  // namespace connectivity::capi
