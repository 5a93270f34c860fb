#include <placegraph/eval/offsets/speed_correlation.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// Speeds at regular times; NaN where there is none.
struct SpeedSeries {
  std::vector<double> speed, angular_speed;

  SpeedSeries(const PosedPath& path, double first, double step, int count, double half)
      : speed(static_cast<std::size_t>(count), kMissing),
        angular_speed(static_cast<std::size_t>(count), kMissing) {
    for (int i = 0; i < count; ++i) {
      const std::optional<Vector6d> twist = path.twist(first + i * step, half);
      if (!twist) continue;
      speed[static_cast<std::size_t>(i)] = twist->head<3>().norm();
      angular_speed[static_cast<std::size_t>(i)] = twist->tail<3>().norm();
    }
  }
};

/// Correlation of a[i + shift] and b[i] where both are known; 0 if fewer than `least` are.
double correlation(const std::vector<double>& a, const std::vector<double>& b, int shift,
                   int least) {
  const int n = static_cast<int>(a.size());
  double count = 0, sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
  for (int i = std::max(0, -shift); i < std::min(n, n - shift); ++i) {
    const double x = a[static_cast<std::size_t>(i + shift)], y = b[static_cast<std::size_t>(i)];
    if (std::isnan(x + y)) continue;
    ++count;
    sum_a += x;
    sum_b += y;
    aa += x * x;
    bb += y * y;
    ab += x * y;
  }
  if (count < least) return 0;
  const double spread_a = aa - sum_a * sum_a / count, spread_b = bb - sum_b * sum_b / count;
  // What rounding leaves of a constant speed.
  if (!(spread_a > 1e-12 * aa && spread_b > 1e-12 * bb)) return 0;
  return (ab - sum_a * sum_b / count) / std::sqrt(spread_a * spread_b);
}

}  // namespace

SpeedShift speed_shift(const PosedPath& truth, const PosedPath& estimate, bool with_rotation,
                       double most_s) {
  // Samples at most, half the time over which a speed is taken, the correlation that is no chance,
  // and the gain of correlation over no shift. Chosen.
  constexpr int kMostSamples = 10000;
  constexpr double kHalf_s = 0.25, kClear = 0.3, kGain = 0.02;
  const double first = std::min(truth.times().front(), estimate.times().front());
  const double last = std::max(truth.times().back(), estimate.times().back());
  const double spacing = std::max(truth.spacing(), estimate.spacing());
  const double step = std::max(spacing, (last - first) / kMostSamples);
  const double half = std::max(kHalf_s, spacing);
  const int count = 1 + static_cast<int>((last - first) / step);
  const SpeedSeries of_truth(truth, first, step, count, half);
  const SpeedSeries of_estimate(estimate, first, step, count, half);
  const auto known = [](const std::vector<double>& series) {
    return std::count_if(series.begin(), series.end(), [](double x) { return !std::isnan(x); });
  };
  const int least = std::max(
      10, static_cast<int>(std::min(known(of_truth.speed), known(of_estimate.speed)) / 2));
  const auto at = [&](int shift) {
    const double speeds = correlation(of_truth.speed, of_estimate.speed, shift, least);
    if (!with_rotation) return speeds;
    return 0.5 * (speeds + correlation(of_truth.angular_speed, of_estimate.angular_speed, shift,
                                       least));
  };
  const double unshifted = at(0);
  int best = 0;
  double most = unshifted;
  const int reach = std::min(count - 1, static_cast<int>(most_s / step));
  for (int shift = -reach; shift <= reach; ++shift) {
    const double found = at(shift);
    if (!(found > most)) continue;
    most = found;
    best = shift;
  }
  if (!(most > kClear && most > unshifted + kGain)) return {0, unshifted};
  return {best * step, most};
}

}  // namespace placegraph
