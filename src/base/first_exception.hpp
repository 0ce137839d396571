// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The first exception of a parallel loop, thrown again after it; memory that ran out as our error.

#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <string>

#include <connectivity/base/error.hpp>

namespace connectivity::detail {

class FirstException {
public:
    void keep() noexcept {
        const std::lock_guard lock(mutex_);
        if (!exception_) exception_ = std::current_exception();
        any_ = true;
    }
    bool any() const { return any_.load(std::memory_order_relaxed); }
    /// `what` begins the sentence where memory ran out.
    void rethrow(const char* what = "the search, for its candidate lists,") const {
        if (!exception_) return;
        try {
            std::rethrow_exception(exception_);
        } catch (const std::bad_alloc&) {
            throw Error(Status::memory, std::string(what) + " ran out of memory");
        }
    }

private:
    std::mutex mutex_;
    std::exception_ptr exception_;
    std::atomic<bool> any_{false};
};

}  // namespace connectivity::detail
