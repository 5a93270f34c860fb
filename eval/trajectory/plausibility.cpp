#include <placegraph/eval/trajectory/plausibility.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace placegraph {
namespace {

constexpr int kMaxShift = 5;
constexpr double kClearlyBetter = 0.5;
// Misfits below this (1 % of the motion) leave nothing to explain.
constexpr double kGoodMisfit = 1e-4;

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd angle_axis(R);
  return angle_axis.angle() * angle_axis.axis();
}

struct Motion {
  Eigen::Vector3d translation;
  Eigen::Vector3d rotation;
};

Motion motion_between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, bool inverted) {
  Eigen::Matrix4d T_a_b =
      inverted ? Eigen::Matrix4d(a.matrix() * b.matrix().inverse()) : relative_pose(a, b);
  return {T_a_b.topRightCorner<3, 1>(), rotation_vector(T_a_b.topLeftCorner<3, 3>())};
}

}  // namespace

double motion_misfit(const std::vector<FramePair>& pairs, int stride, int shift, bool inverted) {
  std::vector<Motion> truth, estimate;
  const int n = static_cast<int>(pairs.size());
  double truth_length = 0, estimate_length = 0;
  // The same window of ground truth for every shift, so that misfits can be compared.
  for (int i = kMaxShift; i + stride + kMaxShift < n; ++i) {
    const auto& a = pairs[static_cast<std::size_t>(i + shift)].T_world_estimate;
    const auto& b = pairs[static_cast<std::size_t>(i + shift + stride)].T_world_estimate;
    if (!a || !b) continue;
    truth.push_back(motion_between(pairs[static_cast<std::size_t>(i)].T_world_truth,
                                   pairs[static_cast<std::size_t>(i + stride)].T_world_truth,
                                   false));
    estimate.push_back(motion_between(*a, *b, inverted));
    truth_length += truth.back().translation.norm();
    estimate_length += estimate.back().translation.norm();
  }
  if (truth.empty() || !(truth_length > 0) || !(estimate_length > 0))
    return std::numeric_limits<double>::quiet_NaN();
  const double scale = truth_length / estimate_length;
  double translation = 0, rotation = 0, translation_all = 0, rotation_all = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    translation += (truth[k].translation - scale * estimate[k].translation).squaredNorm();
    rotation += (truth[k].rotation - estimate[k].rotation).squaredNorm();
    translation_all += truth[k].translation.squaredNorm();
    rotation_all += truth[k].rotation.squaredNorm();
  }
  // A truth that hardly turns (below 1 mrad a stride) has no rotation to compare relatively.
  const double rotation_floor = 1e-6 * static_cast<double>(truth.size());
  return translation / translation_all + rotation / std::max(rotation_all, rotation_floor);
}

std::vector<std::string> convention_warnings(const std::vector<FramePair>& pairs) {
  std::vector<std::string> warnings;
  const int n = static_cast<int>(pairs.size());
  if (n < 4 * kMaxShift) return warnings;

  const int long_stride = std::max(1, n / 50);
  const double as_given = motion_misfit(pairs, long_stride, 0, false);
  const double inverse = motion_misfit(pairs, long_stride, 0, true);
  if (as_given > kGoodMisfit && inverse < kClearlyBetter * as_given) {
    warnings.push_back(
        "the estimate looks inverted: its inverse poses fit clearly better (T_cam_world given, "
        "T_world_cam expected?)");
    return warnings;
  }

  const int short_stride = n > 100 ? 5 : 1;
  const double unshifted = motion_misfit(pairs, short_stride, 0, false);
  int best_shift = 0;
  double best = unshifted;
  for (int shift = -kMaxShift; shift <= kMaxShift; ++shift) {
    const double misfit = motion_misfit(pairs, short_stride, shift, false);
    if (!(misfit < best)) continue;
    best = misfit;
    best_shift = shift;
  }
  if (unshifted > kGoodMisfit && best < kClearlyBetter * unshifted)
    warnings.push_back("the estimate looks shifted in time: it fits clearly better " +
                       std::to_string(std::abs(best_shift)) +
                       (std::abs(best_shift) == 1 ? " frame " : " frames ") +
                       (best_shift > 0 ? "earlier" : "later"));
  return warnings;
}

}  // namespace placegraph
