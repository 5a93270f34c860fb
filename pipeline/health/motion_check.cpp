#include <fmt/format.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/core/quantile.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/map_index.h>
#include <placegraph/io/datasets/recorded_sequence.h>
#include <placegraph/pipeline/health/motion_check.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace placegraph {

Rotations rotations_of(const Trajectory& trajectory) {
  constexpr std::size_t kSteps = 50;  // longer than the vibration of a rough road
  Rotations rotations;
  const std::size_t step = std::max<std::size_t>(1, trajectory.size() / kSteps);
  const StampedPose* before = nullptr;
  for (std::size_t i = 0; i < trajectory.size(); i += step) {
    const StampedPose& pose = trajectory.poses[i];
    if (!pose.T_world_body) continue;
    if (before) {
      const Eigen::Vector3d rotation_vector =
          (SE3(*before->T_world_body).inverse() * SE3(*pose.T_world_body)).rotation().log();
      rotations.about_x_deg += rad_to_deg(std::abs(rotation_vector.x()));
      rotations.about_y_deg += rad_to_deg(std::abs(rotation_vector.y()));
    }
    before = &pose;
  }
  return rotations;
}

std::optional<DataNote> odd_posture(const Camera& camera, const Rotations& rotations) {
  // Rotation that is clearly about another axis: three times as large, and no trembling. Chosen by
  // the faults of group "fixed" (tests/faults/README.md).
  constexpr double kClear = 3, kLeast_deg = 15;
  const auto clearly = [](double more, double less) {
    return more > kLeast_deg && more > kClear * less;
  };
  const std::string advice =
      ": the ground is searched for below, and the scale is in doubt; rotate the images upright "
      "(EXIF "
      "orientation is not applied)";
  if (clearly(rotations.about_x_deg, rotations.about_y_deg))
    return DataNote{
        fmt::format(
            "the camera rotates about the horizontal axis of its images ({:.0f} deg in all, {:.0f} "
            "about the vertical one), as if it lay on its side",
            rotations.about_x_deg, rotations.about_y_deg) +
            advice,
        true, NoteCause::kUpsideDown, ""};
  if (camera.height > camera.width && !clearly(rotations.about_y_deg, rotations.about_x_deg))
    return DataNote{
        "the images are higher than wide, and the camera's rotations do not show whether it "
        "is upright" +
            advice,
        true, NoteCause::kUpsideDown, ""};
  return std::nullopt;
}

namespace {

/// Ids of keyframes that move along their optical axis.
std::set<KeyframeId> keyframes_that_go_ahead(const Map& map) {
  constexpr double kAhead = 0.9;  // cosine of the angle
  std::set<KeyframeId> ahead;
  for (std::size_t i = 1; i < map.keyframes.size(); ++i) {
    const Sim3 S_map_cam = map.S_map_keyframe(map.keyframes[i].id);
    const Eigen::Vector3d translation =
        S_map_cam.translation() - map.S_map_keyframe(map.keyframes[i - 1].id).translation();
    const Eigen::Vector3d axis = S_map_cam.rotation() * Eigen::Vector3d(0, 0, 1);
    if (translation.norm() > 0 && translation.dot(axis) > kAhead * translation.norm())
      ahead.insert(map.keyframes[i].id);
  }
  return ahead;
}
/// The lowest fifth; -1 of fewer than thirty.
double lowest_fifth(std::vector<double> values) {
  // Landmarks with a quantile. Chosen.
  constexpr std::size_t kFewest = 30;
  if (values.size() < kFewest) return -1;
  const auto fifth = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 5);
  std::nth_element(values.begin(), fifth, values.end());
  return *fifth;
}

}  // namespace

NearestSides nearest_sides(const Map& map, double camera_height_m) {
  // Observations of a landmark with a known position. Chosen.
  constexpr int kViews = 4;
  enum { kBelow, kAbove, kLeft, kRight };
  std::array<std::vector<double>, 4> distances;
  const std::set<KeyframeId> ahead = keyframes_that_go_ahead(map);
  const MapIndex index(map);
  for (const PointLandmark& landmark : map.landmarks) {
    const Eigen::Vector3d& p = landmark.point_cam;
    if (landmark.observations < kViews || p.z() <= 0 || !ahead.contains(landmark.keyframe))
      continue;
    const double metres = index.find(landmark.keyframe)->S_map_keyframe().scale() / camera_height_m;
    const bool upright = std::abs(p.y()) > std::abs(p.x());
    const int side = upright ? (p.y() > 0 ? kBelow : kAbove) : (p.x() > 0 ? kRight : kLeft);
    distances[static_cast<std::size_t>(side)].push_back(metres *
                                                        std::max(std::abs(p.x()), std::abs(p.y())));
  }
  NearestSides sides;
  sides.below = lowest_fifth(distances[kBelow]);
  const auto on_ground = std::ranges::count_if(
      distances[kBelow], [](double distance) { return std::abs(distance - 1) < 0.1; });
  sides.on_ground =
      static_cast<double>(on_ground) / std::max(1.0, static_cast<double>(distances[kBelow].size()));
  for (const int side : {kAbove, kLeft, kRight}) {
    const double nearest = lowest_fifth(distances[static_cast<std::size_t>(side)]);
    if (nearest >= 0 && (sides.nearest_other < 0 || nearest < sides.nearest_other))
      sides.nearest_other = nearest;
  }
  return sides;
}

std::optional<DataNote> odd_sides(const NearestSides& sides) {
  // Shares of the camera height and of the landmarks below (docs/datasets.md). Chosen by the faults
  // of group "fixed" (tests/faults/README.md).
  constexpr double kOtherTooNear = 0.6, kBelowTooNear = 0.8, kGround = 1.0 / 3;
  if (sides.below < 0 || sides.nearest_other < 0 || sides.below > kBelowTooNear ||
      sides.nearest_other > kOtherTooNear || sides.on_ground > kGround)
    return std::nullopt;
  return DataNote{fmt::format("landmarks below the camera are as near as {:.2f} of its height, and "
                              "those on another side as near as {:.2f}: the ground is not below, "
                              "as if the camera lay on its side or upside down; the scale is in "
                              "doubt",
                              sides.below, sides.nearest_other),
                  true, NoteCause::kUpsideDown, ""};
}

std::optional<DataNote> odd_height(const NearestSides& sides, Sensor sensor,
                                   double camera_height_m) {
  // Shares of the camera height (docs/datasets.md). Chosen by the faults of group "fixed"
  // (tests/faults/README.md).
  constexpr double kTooNear = 0.55, kTooFar = 1.4;
  if (sides.below < 0 || (sides.below > kTooNear && sides.below < kTooFar)) return std::nullopt;
  const bool stereo = sensor == Sensor::kStereo;
  return DataNote{
      fmt::format("the nearest landmarks below the camera are {:.2f} m below it by the {}, but its "
                  "height is {:g} m",
                  sides.below * camera_height_m, stereo ? "baseline" : "depth images",
                  camera_height_m),
      true, NoteCause::kScale,
      fmt::format("measure the height, or check the {}", stereo ? "baseline" : "depth unit")};
}

namespace {

/// Whether the stamps are those assigned to recordings without times: 10 Hz, to the nanosecond.
bool are_counted(const Trajectory& trajectory) {
  const auto step_ns = static_cast<std::int64_t>(1e9 / kDefaultRateHz);
  return std::ranges::all_of(trajectory.poses,
                             [&](const StampedPose& pose) { return pose.stamp_ns % step_ns == 0; });
}

}  // namespace

std::optional<DataNote> odd_speed(const Trajectory& trajectory) {
  constexpr double kFastest = 100;  // [m/s]
  if (are_counted(trajectory)) return std::nullopt;
  std::vector<double> speeds;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const StampedPose &a = trajectory.poses[i - 1], &b = trajectory.poses[i];
    if (!a.T_world_body || !b.T_world_body) continue;
    speeds.push_back((b.T_world_body->translation() - a.T_world_body->translation()).norm() /
                     seconds(a.stamp_ns, b.stamp_ns));
  }
  if (speeds.empty()) return std::nullopt;
  const double speed = median_of(std::move(speeds));
  if (!(speed > kFastest)) return std::nullopt;
  return DataNote{
      fmt::format(
          "the camera moves at {:.3g} m/s: the baseline, the depth unit, the camera's height or "
          "the times are not in metres and seconds",
          speed),
      true, NoteCause::kScale, ""};
}

namespace {

/// A step between two consecutive poses.
struct Step {
  std::size_t frame = 0;  ///< index of the later pose
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< rotation vector [rad]
  double length() const { return offset.norm(); }
};

std::vector<Step> steps_of(const Trajectory& trajectory) {
  std::vector<Step> steps;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const StampedPose &a = trajectory.poses[i - 1], &b = trajectory.poses[i];
    if (!a.T_world_body || !b.T_world_body) continue;
    const SE3 T_a_b = SE3(*a.T_world_body).inverse() * SE3(*b.T_world_body);
    steps.push_back(
        {i, b.T_world_body->translation() - a.T_world_body->translation(), T_a_b.rotation().log()});
  }
  return steps;
}

/// Distance covered in ten steps, as a share of their length: 1 on a straight path, about 0.1 for a
/// camera that trembles at one place.
double progress_of(const std::vector<Step>& steps) {
  // The ten steps above. Chosen.
  constexpr std::size_t kSteps = 10;
  double length = 0, covered = 0;
  for (std::size_t begin = 0; begin + kSteps <= steps.size(); begin += kSteps) {
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    for (std::size_t k = begin; k < begin + kSteps; ++k) {
      offset += steps[k].offset;
      length += steps[k].length();
    }
    covered += offset.norm();
  }
  return length > 0 ? covered / length : 0;
}

double length_quantile(const std::vector<Step>& steps, double share) {
  std::vector<double> lengths;
  for (const Step& step : steps) lengths.push_back(step.length());
  return quantile_of(std::move(lengths), share);
}

// Steps of a motion that is judged. Chosen.
constexpr std::size_t kFewestSteps = 20;

}  // namespace

double landmark_depth(const Map& map, int component) {
  const MapIndex index(map);
  std::vector<double> depths;
  for (const PointLandmark& landmark : map.landmarks)
    if (const auto seen_by = index.find(landmark.keyframe);
        seen_by && seen_by->component == component)
      depths.push_back(seen_by->S_map_keyframe().scale() * landmark.point_cam.z());
  return depths.empty() ? 0 : median_of(std::move(depths));
}

std::optional<DataNote> odd_steps(const Trajectory& trajectory, double landmark_depth) {
  // A jump exceeds five times the two steps on either side, three times the 90 % quantile of all,
  // and 1 % of the depth. Chosen by the faults of group "fixed" (tests/faults/README.md).
  constexpr std::size_t kBeside = 2;
  constexpr double kOfNeighbours = 5, kOfUsual = 3, kUsual = 0.9, kOfDepth = 0.01;
  const std::vector<Step> steps = steps_of(trajectory);
  if (steps.size() < kFewestSteps) return std::nullopt;
  const double least =
      std::max(kOfUsual * length_quantile(steps, kUsual), kOfDepth * landmark_depth);
  std::vector<std::size_t> jumps;
  for (std::size_t k = kBeside; k + kBeside < steps.size(); ++k) {
    double neighbour = 0;
    for (std::size_t d = 1; d <= kBeside; ++d)
      neighbour = std::max({neighbour, steps[k - d].length(), steps[k + d].length()});
    if (steps[k].length() > std::max(least, kOfNeighbours * neighbour))
      jumps.push_back(steps[k].frame);
  }
  if (jumps.empty()) return std::nullopt;
  return DataNote{fmt::format("the position jumps in {} frames, the first is pose {} of the "
                              "trajectory: the steps beside it are a fifth of it or less",
                              jumps.size(), jumps.front()),
                  true, NoteCause::kJump,
                  "look at these images: some are missing, out of order, or of another place"};
}

namespace {

/// Whether the camera rotates on in the same direction from one step to the next.
bool rotates_on(const Step& before, const Step& after) {
  constexpr double kLeast_deg = 0.2;  // more than the noise of a step
  const double a = before.rotation.norm(), b = after.rotation.norm();
  return std::min(a, b) > deg_to_rad(kLeast_deg) &&
         before.rotation.dot(after.rotation) > 0.5 * a * b;
}

}  // namespace

std::optional<DataNote> odd_order(const Trajectory& trajectory) {
  // Steps of half the median length or more; one in ten against the one before (120 degrees or
  // more), on a path that progresses. Chosen by the faults of group "fixed"
  // (tests/faults/README.md).
  constexpr double kOfMedian = 0.5, kOpposite = -0.5, kShare = 0.1, kProgress = 0.3;
  const std::vector<Step> steps = steps_of(trajectory);
  if (steps.size() < kFewestSteps || progress_of(steps) < kProgress) return std::nullopt;
  const double least = kOfMedian * length_quantile(steps, 0.5);
  std::size_t compared = 0, opposite = 0;
  for (std::size_t k = 1; k < steps.size(); ++k) {
    const double a = steps[k - 1].length(), b = steps[k].length();
    if (!(a > 0 && b > 0) || a < least || b < least) continue;
    ++compared;
    const bool reverses = steps[k - 1].offset.dot(steps[k].offset) < kOpposite * a * b;
    if (reverses && !rotates_on(steps[k - 1], steps[k])) ++opposite;
  }
  if (compared < kFewestSteps ||
      static_cast<double>(opposite) < kShare * static_cast<double>(compared))
    return std::nullopt;
  return DataNote{
      fmt::format("the camera moves to and fro from frame to frame, in {} of {} steps: images "
                  "have changed places",
                  opposite, compared),
      true, NoteCause::kTimes, "check the order of the images and their times"};
}

}  // namespace placegraph
