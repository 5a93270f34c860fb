#pragma once
#include <placegraph/eval/drawing/figure.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph {

/// The interval of this size around the same middle.
Interval resized(const Interval& interval, double size);

/// An interval that holds the data with a margin on each side, in their size; never without size.
/// Data that differ by rounding errors alone, compared with `least`, get an interval of size
/// `least`.
Interval with_margin(const Interval& data, double margin, double least = 1e-6);

struct AxisTick {
  double at = 0;
  std::string text;  ///< empty: a line of the grid without a number
};

struct AxisTicks {
  std::vector<AxisTick> ticks;
  /// Subtracted from the numbers, where they would have many equal digits: eastings, say.
  double offset = 0;
  /// The name of the axis, which names an offset.
  std::string label(const std::string& name) const;
};

/// 1, 2 or 5 times a power of ten, so that about `count` of them fill the size.
double nice_step(double size, int count);

/// About `count` ticks at multiples of a nice step, all with the same number of decimals.
AxisTicks linear_ticks(const Interval& interval, int count);

/// Ticks at 1, 2 and 5 times powers of ten of an interval of decimal logarithms; those at 2 and 5
/// have numbers if there is room, which `px_per_decade` and `room_px` say.
AxisTicks log_ticks(const Interval& decades, double px_per_decade, double room_px);

/// Lengths or errors with the same number of decimals, so that the smallest has three digits but
/// none more than four decimals; what is too small for those is "< 0.0001".
std::vector<std::string> comparable(const std::vector<double>& values);

}  // namespace placegraph
