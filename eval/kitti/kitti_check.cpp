#include <fmt/format.h>
#include <placegraph/eval/kitti/kitti_check.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

/// How much numbers of the first pose may differ from the identity's: what nobody sees in a plot
/// (a millimetre, a milliradian), and far above what rounding makes. Chosen.
constexpr double kSameStart = 1e-3;
/// The least share of the path that a camera which looks forward moves along its z axis: that of a
/// direction 45 degrees off. The true poses of KITTI have .997 or more. Chosen.
constexpr double kLeastForward = 0.7;
/// A path that has a direction. Chosen.
constexpr double kLeastPath_m = 10;

/// The mean direction of the motion in the camera's axes, each step weighted by its length: of
/// length 1 if the camera always moves along the same of its axes.
std::optional<Eigen::Vector3d> mean_direction(const Trajectory& poses) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double path_m = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const auto &a = poses.poses[i - 1].T_world_body, &b = poses.poses[i].T_world_body;
    if (!a || !b) continue;
    const Eigen::Vector3d step = b->translation() - a->translation();
    sum += a->linear().transpose() * step;
    path_m += step.norm();
  }
  if (path_m < kLeastPath_m) return std::nullopt;
  return sum / path_m;
}

std::string axis_text(const Eigen::Vector3d& direction) {
  Eigen::Index axis = 0;
  if (direction.cwiseAbs().maxCoeff(&axis) < kLeastForward)
    return "the camera moves along no axis of its own";
  return fmt::format("the camera moves along its {}{} axis", direction[axis] < 0 ? "-" : "",
                     "xyz"[axis]);
}

}  // namespace

const std::vector<std::string>& kitti_test_sequences() {
  static const std::vector<std::string> names = {"11", "12", "13", "14", "15", "16",
                                                 "17", "18", "19", "20", "21"};
  return names;
}

std::optional<int> kitti_frames(const std::string& sequence) {
  constexpr std::array kFrames = {4541, 1101, 4661, 801, 271,  2761, 1101, 1101, 4071, 1591, 1201,
                                  921,  1061, 3281, 631, 1901, 1731, 491,  1801, 4981, 831,  2721};
  for (std::size_t i = 0; i < kFrames.size(); ++i)
    if (sequence == fmt::format("{:02d}", i)) return kFrames[i];
  return std::nullopt;
}

std::string kitti_count_fault(std::size_t poses, int frames, bool from_truth) {
  if (poses == static_cast<std::size_t>(frames)) return {};
  return fmt::format("has {} poses, but {} has {} frames: every frame needs a pose", poses,
                     from_truth ? "the ground truth" : "the sequence", frames);
}

std::vector<std::string> kitti_start_warnings(const Trajectory& poses) {
  if (poses.poses.empty() || !poses.poses.front().T_world_body) return {};
  const Eigen::Isometry3d& first = *poses.poses.front().T_world_body;
  const double off =
      (first.matrix() - Eigen::Isometry3d::Identity().matrix()).cwiseAbs().maxCoeff();
  if (off <= kSameStart) return {};
  return {
      fmt::format("the first pose is not the identity (off by {:.3g}): the figures do not "
                  "depend on it, but the plot of the path does",
                  off)};
}

std::vector<std::string> kitti_pose_warnings(const Trajectory& poses) {
  std::vector<std::string> warnings = kitti_start_warnings(poses);
  const std::optional<Eigen::Vector3d> direction = mean_direction(poses);
  if (direction && direction->z() < kLeastForward)
    warnings.push_back(axis_text(*direction) +
                       ", but z points forward: are these poses of another sensor, or inverse "
                       "ones?");
  return warnings;
}

}  // namespace placegraph
