#pragma once
#include <chrono>
#include <ctime>

namespace placegraph::apps {

/// Time since construction: wall time, and CPU time over all threads of the process.
class Stopwatch {
 public:
  Stopwatch() : wall_(Clock::now()), cpu_(std::clock()) {}
  double wall_ms() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - wall_).count();
  }
  double cpu_ms() const { return 1e3 * static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC; }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point wall_;
  std::clock_t cpu_;
};

/// Largest resident memory of the process so far [MiB].
double peak_mb();

}  // namespace placegraph::apps
