#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/local_map/stamp_jitter.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

// Four frames for a cubic, and the one in their middle that it predicts.
constexpr std::size_t kFrames = 5;

/// Weights of the cubic through four samples, at 0.
std::array<double, kFrames - 1> cubic_at_zero(const std::array<double, kFrames - 1>& x) {
  std::array<double, kFrames - 1> weights{};
  for (std::size_t j = 0; j < x.size(); ++j) {
    weights[j] = 1;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (k != j) weights[j] *= -x[k] / (x[j] - x[k]);
  }
  return weights;
}

}  // namespace

void StampJitter::add(std::int64_t stamp_ns, const SE3& T_odom_cam) {
  constexpr double kLongest_s = 1;  // motion over longer times is not smooth
  // Largest jitter that is assumed, and samples for a median. Chosen.
  constexpr double kMost_s = 0.005;
  constexpr std::size_t kFewest = 10;
  const double stamp_s = 1e-9 * static_cast<double>(stamp_ns);
  const Eigen::Vector3d position = T_odom_cam.translation();
  const double path_m =
      last_.empty() ? 0 : last_.back().path_m + (position - last_.back().position).norm();
  last_.push_back({stamp_s, path_m, position});
  if (last_.size() > kFrames) last_.pop_front();
  if (last_.size() < kFrames || !(last_[4].stamp_s - last_[0].stamp_s < kLongest_s)) return;
  const double speed = (last_[3].path_m - last_[1].path_m) / (last_[3].stamp_s - last_[1].stamp_s);
  if (!(speed > 0)) return;
  const double now = last_[2].stamp_s;
  const auto weights = cubic_at_zero({last_[0].stamp_s - now, last_[1].stamp_s - now,
                                      last_[3].stamp_s - now, last_[4].stamp_s - now});
  double difference_m = last_[2].path_m, squares = 1;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    difference_m -= weights[j] * last_[j < 2 ? j : j + 1].path_m;
    squares += weights[j] * weights[j];
  }
  differences_s_.push_back(std::abs(difference_m) / (speed * std::sqrt(squares)));
  constexpr double kSigmaOfMedian = 1.4826;  // for a normal distribution
  if (differences_s_.size() >= kFewest)
    sigma_s_ = std::min(kMost_s, kSigmaOfMedian * median_of(differences_s_));
}

}  // namespace placegraph
