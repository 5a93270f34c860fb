#include <fmt/format.h>
#include <placegraph/eval/drawing/plot_axis.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

constexpr int kMostDecimals = 9;

int decimals_of(double step) {
  return std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, kMostDecimals);
}

/// A round number near the interval, if its numbers are long compared with their differences.
double offset_of(const Interval& interval) {
  constexpr double kLong = 1e5;
  const double largest = std::max(std::abs(interval.min), std::abs(interval.max));
  if (largest < kLong || interval.size() > 0.1 * largest) return 0;
  const double unit = std::pow(10.0, std::ceil(std::log10(interval.size())));
  return std::floor(interval.min / unit) * unit;
}

}  // namespace

Interval resized(const Interval& interval, double size) {
  return {interval.middle() - 0.5 * size, interval.middle() + 0.5 * size};
}

Interval with_margin(const Interval& data, double margin, double least) {
  if (data.empty()) return {0, 1};
  // Doubles have 16 digits: differences below the last ones have no numbers to write.
  const double rounding = 1e-9 * std::max(std::abs(data.min), std::abs(data.max));
  return resized(data, std::max({data.size() * (1 + 2 * margin), least, rounding}));
}

std::string AxisTicks::label(const std::string& name) const {
  if (offset == 0) return name;
  return fmt::format("{}, {} {:.0f}", name, offset > 0 ? "less" : "plus", std::abs(offset));
}

double nice_step(double size, int count) {
  const double raw = size / std::max(count, 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power) return factor * power;
  return 10 * power;
}

AxisTicks linear_ticks(const Interval& interval, int count) {
  AxisTicks result;
  if (interval.empty() || !(interval.size() > 0)) return result;
  result.offset = offset_of(interval);
  const double step = nice_step(interval.size(), count);
  const int decimals = decimals_of(step);
  const double first = std::ceil((interval.min - result.offset) / step - 1e-9),
               last = std::floor((interval.max - result.offset) / step + 1e-9);
  constexpr double kMost = 1000;  // a guard: there are about `count`
  for (double i = first; i <= last && i - first < kMost; ++i)
    result.ticks.push_back(
        {result.offset + i * step, fmt::format("{:.{}f}", i * step + 0.0, decimals)});
  return result;
}

AxisTicks log_ticks(const Interval& decades, double px_per_decade, double room_px) {
  AxisTicks result;
  const bool dense = px_per_decade > 4 * room_px;
  for (double decade = std::floor(decades.min); decade <= decades.max; ++decade)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double at = decade + std::log10(factor);
      if (at < decades.min || at > decades.max) continue;
      const bool named = factor == 1 || dense;
      result.ticks.push_back(
          {at, named ? fmt::format("{:g}", factor * std::pow(10.0, decade)) : std::string()});
    }
  return result;
}

std::vector<std::string> comparable(const std::vector<double>& values) {
  constexpr int kMost = 4;
  constexpr double kLeast = 1e-4;
  double smallest = std::numeric_limits<double>::infinity();
  for (const double value : values)
    if (value >= kLeast) smallest = std::min(smallest, value);
  const int decimals =
      std::isfinite(smallest)
          ? std::clamp(2 - static_cast<int>(std::floor(std::log10(smallest))), 0, kMost)
          : kMost;
  std::vector<std::string> texts;
  for (const double value : values)
    texts.push_back(value > 0 && value < kLeast ? fmt::format("< {:.{}f}", kLeast, kMost)
                                                : fmt::format("{:.{}f}", value + 0.0, decimals));
  return texts;
}

}  // namespace placegraph
