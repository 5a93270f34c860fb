#include <fmt/format.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/graph/measurements/stamp_plausibility.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

// 0.2 ms and 10 s (docs/datasets.md). Chosen.
constexpr double kLeastSpacing_s = 2e-4, kGreatestSpacing_s = 10;
/// Frames of cameras, poses of motion capture: from 500 Hz to one in 2 s.
constexpr double kLikelyLeast_s = 2e-3, kLikelyGreatest_s = 2;

double median_spacing_s(const std::vector<std::int64_t>& stamps_ns) {
  std::vector<double> spacings_s;
  for (std::size_t i = 1; i < stamps_ns.size(); ++i)
    spacings_s.push_back(seconds(stamps_ns[i - 1], stamps_ns[i]));
  return spacings_s.empty() ? 0 : median_of(std::move(spacings_s));
}

bool likely(double spacing_s) {
  return spacing_s >= kLikelyLeast_s && spacing_s <= kLikelyGreatest_s;
}

/// Names the unit in which numbers that were read as seconds would be plausible.
std::string likely_unit(double spacing_s) {
  if (likely(spacing_s * 1e-3)) return "are these milliseconds?";
  if (likely(spacing_s * 1e-6)) return "are these microseconds?";
  if (likely(spacing_s * 1e-9)) return "are these nanoseconds?";
  for (const double factor : {1e3, 1e6, 1e9})
    if (likely(spacing_s * factor))
      return fmt::format("are the times {:g} times too small?", factor);
  return "is their unit right?";
}

}  // namespace

std::string odd_spacing(const std::vector<std::int64_t>& stamps_ns, const std::string& what) {
  const double spacing_s = median_spacing_s(stamps_ns);
  if (stamps_ns.size() < 2 || (spacing_s >= kLeastSpacing_s && spacing_s <= kGreatestSpacing_s))
    return {};
  return fmt::format("a {} every {:.3g} s ({:.3g} Hz): {}", what, spacing_s, 1 / spacing_s,
                     likely_unit(spacing_s));
}

std::string irregular_spacing(const std::vector<std::int64_t>& stamps_ns) {
  // Gaps of five median distances; a fifth of the distances off by a fifth. Chosen.
  constexpr double kGap = 5, kDeviation = 0.2, kShare = 0.2;
  const double median_s = median_spacing_s(stamps_ns);
  if (!(median_s > 0)) return {};
  std::size_t gaps = 0, first_gap = 0, irregular = 0;
  double longest = 0;
  for (std::size_t i = 1; i < stamps_ns.size(); ++i) {
    const double spacing = seconds(stamps_ns[i - 1], stamps_ns[i]) / median_s;
    if (spacing > kGap && gaps++ == 0) first_gap = i - 1;
    longest = std::max(longest, spacing);
    if (std::abs(spacing - std::max(1.0, std::round(spacing))) > kDeviation) ++irregular;
  }
  if (gaps > 0)
    return fmt::format(
        "{} intervals between images are over five times the median of {:.3g} s, up to {:.3g} s, "
        "the first after frame {}: images are missing, or times jump",
        gaps, median_s, longest * median_s, first_gap);
  const auto spacings = static_cast<double>(stamps_ns.size() - 1);
  if (static_cast<double>(irregular) > kShare * spacings)
    return fmt::format(
        "the times of the images are irregular: {} of {} intervals differ by over 20 % from "
        "multiples of the median of {:.3g} s",
        irregular, stamps_ns.size() - 1, median_s);
  return {};
}

std::string other_clock(const std::vector<std::int64_t>& stamps_ns,
                        const std::vector<std::int64_t>& other_ns, const std::string& other) {
  const double first = 1e-9 * static_cast<double>(stamps_ns.front());
  const double last = 1e-9 * static_cast<double>(stamps_ns.back());
  const double other_first = 1e-9 * static_cast<double>(other_ns.front());
  const double other_last = 1e-9 * static_cast<double>(other_ns.back());
  const double length = last - first, other_length = other_last - other_first;
  const auto similar = [](double a, double b) { return a > 0.5 * b && b > 0.5 * a; };
  for (int power = -9; power <= 9; power += 3) {
    const double factor = std::pow(10.0, power);
    if (power == 0 || !similar(length, factor * other_length)) continue;
    const bool overlap = factor * other_first < last && factor * other_last > first;
    const char* unit = power == -3   ? "in milliseconds"
                       : power == -6 ? "in microseconds"
                       : power == -9 ? "in nanoseconds"
                                     : "in another unit";
    return fmt::format("{} seems to have its times {}: times {:g} it {}", other, unit, factor,
                       overlap ? "fits" : "is as long, though at another time");
  }
  if (similar(length, other_length))
    return fmt::format(
        "both are {:.4g} s and {:.4g} s long: {} seems to be of another clock, {:.3f} s "
        "later",
        length, other_length, other, other_first - first);
  return {};
}

}  // namespace placegraph
