#pragma once
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/time.h>

#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

namespace placegraph {

/// Measurements that become available a fixed time after they were taken, such as poses computed on
/// another computer. `Measurement` has a member `stamp_ns`, the time when it was taken.
template <class Measurement>
class DelayLine {
 public:
  /// Throws ArgumentError if the delay is negative or not a number.
  explicit DelayLine(double delay_s) : delay_s_(delay_s) {
    require(delay_s >= 0, "DelayLine: the delay is negative");
  }

  /// Adds a measurement. Throws ArgumentError if it is older than the newest pending one.
  void push(Measurement measurement) {
    require(pending_.empty() || measurement.stamp_ns >= pending_.back().stamp_ns,
            "DelayLine: the measurement is older than the last one");
    pending_.push_back(std::move(measurement));
  }

  /// Removes the measurements whose delay has passed at `now_ns` and returns them, oldest first.
  std::vector<Measurement> take(std::int64_t now_ns) {
    std::vector<Measurement> due;
    while (!pending_.empty() && seconds(pending_.front().stamp_ns, now_ns) >= delay_s_) {
      due.push_back(std::move(pending_.front()));
      pending_.pop_front();
    }
    return due;
  }

  void clear() { pending_.clear(); }

 private:
  double delay_s_;
  std::deque<Measurement> pending_;  // in the order of their stamps
};

}  // namespace placegraph
