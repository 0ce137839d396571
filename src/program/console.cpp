// SPDX-License-Identifier: BSD-3-Clause
#include "program/console.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include <connectivity/base/report.hpp>

namespace connectivity::program {

namespace {

constexpr int bar_width = 30;
constexpr const char* wipe = "\r\033[K";

/// Redraws a bar on the terminal until it goes out of scope: phases behind us, the phase we are in,
/// its time.
class Bar {
public:
    Bar(std::string name, int done, int total)
        : name_(std::move(name)), done_(done), total_(total) {
        painter_ = std::thread([this] { paint(); });
    }
    ~Bar() {
        {
            const std::lock_guard lock(mutex_);
            finished_ = true;
        }
        wake_.notify_one();
        painter_.join();
        fmt::print(stderr, "{}", wipe);
        std::fflush(stderr);
    }

private:
    void paint() {
        std::unique_lock lock(mutex_);
        while (!finished_) {
            const int filled = bar_width * done_ / total_;
            fmt::print(stderr, "{}[{:=<{}}>{:<{}}] {}/{}  {:.32}  {}", wipe, "", filled, "",
                       bar_width - filled, done_ + 1, total_, name_, human_duration(watch_.ms()));
            std::fflush(stderr);
            wake_.wait_for(lock, std::chrono::milliseconds(100));
        }
    }

    std::string name_;
    int done_, total_;
    Stopwatch watch_;
    bool finished_ = false;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::thread painter_;
};

}  // namespace

std::string human_duration(double ms) {
    if (ms < 9.995) return fmt::format("{:.2f} ms", ms);
    if (ms < 999.5) return fmt::format("{:.0f} ms", ms);
    return fmt::format("{:.2f} s", ms / 1000);
}

void Console::line(const std::string& text) {
    fmt::print("{}\n", text);
    std::fflush(stdout);
}

void Console::phase(const std::string& name, const std::function<void()>& work) {
    const Stopwatch watch;
    if (isatty(STDERR_FILENO)) {
        const Bar bar(name, static_cast<int>(durations_.size()), n_phases_);
        work();
    } else {
        work();
    }
    durations_.emplace_back(name, watch.ms());
    line(fmt::format("{:<34}{:>12}", name, human_duration(durations_.back().second)));
}

}  // namespace connectivity::program
