#include <placegraph/eval/trajectory/rpe.h>
#include <placegraph/graph/core/angle.h>

#include <cmath>
#include <numbers>

namespace placegraph {

double rotation_angle(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d twice_sin_axis(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(twice_sin_axis.norm(), R.trace() - 1.0);
}

RpeResult rpe(const std::vector<FramePair>& pairs) {
  RpeResult result;
  std::vector<double> translations_m, rotations_deg;
  for (std::size_t i = 0; i + 1 < pairs.size(); ++i) {
    const FramePair &a = pairs[i], &b = pairs[i + 1];
    if (!a.T_world_estimate || !b.T_world_estimate) continue;
    const Eigen::Matrix4d T_a_b_truth = relative_pose(a.T_world_truth, b.T_world_truth);
    const Eigen::Matrix4d T_a_b_estimate = relative_pose(*a.T_world_estimate, *b.T_world_estimate);
    const Eigen::Matrix4d error = T_a_b_truth.inverse() * T_a_b_estimate;
    translations_m.push_back(error.topRightCorner<3, 1>().norm());
    rotations_deg.push_back(rad_to_deg(rotation_angle(error.topLeftCorner<3, 3>())));
  }
  if (translations_m.empty()) {
    result.outcome =
        Outcome::failure(Outcome::Code::kTooFewData, "no two consecutive frames have an estimate");
    return result;
  }
  result.translation_m = statistics_of(translations_m);
  result.rotation_deg = statistics_of(rotations_deg);
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
