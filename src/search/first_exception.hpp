// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The first exception of a parallel loop, thrown again after it; memory that ran out as our error.

#include <atomic>
#include <exception>
#include <mutex>
#include <new>

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
    void rethrow() const {
        if (!exception_) return;
        try {
            std::rethrow_exception(exception_);
        } catch (const std::bad_alloc&) {
            throw Error(Status::memory, "the search ran out of memory for its candidate lists");
        }
    }

private:
    std::mutex mutex_;
    std::exception_ptr exception_;
    std::atomic<bool> any_{false};
};

}  // namespace connectivity::detail
