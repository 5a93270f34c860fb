#include <fmt/format.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/pipeline/motion_check.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

Turns turns_of(const Trajectory& trajectory) {
  constexpr std::size_t kSteps = 50;  // longer than what a road shakes
  Turns turns;
  const std::size_t step = std::max<std::size_t>(1, trajectory.size() / kSteps);
  const StampedPose* before = nullptr;
  for (std::size_t i = 0; i < trajectory.size(); i += step) {
    const StampedPose& pose = trajectory.poses[i];
    if (!pose.T_world_body) continue;
    if (before) {
      const Eigen::Vector3d turn =
          (SE3(*before->T_world_body).inverse() * SE3(*pose.T_world_body)).rotation().log();
      turns.about_x_deg += rad_to_deg(std::abs(turn.x()));
      turns.about_y_deg += rad_to_deg(std::abs(turn.y()));
    }
    before = &pose;
  }
  return turns;
}

std::optional<DataNote> odd_posture(const Camera& camera, const Turns& turns) {
  constexpr double kClear = 3, kLeast_deg = 15;
  const auto clearly = [](double more, double less) {
    return more > kLeast_deg && more > kClear * less;
  };
  const std::string advice =
      ": the ground is looked for below, and lengths are in doubt; turn the images upright (EXIF "
      "orientation is not applied)";
  if (clearly(turns.about_x_deg, turns.about_y_deg))
    return DataNote{
        fmt::format(
            "the camera turns about the horizontal axis of its images ({:.0f} deg in all, {:.0f} "
            "about the vertical one), as if it lay on its side",
            turns.about_x_deg, turns.about_y_deg) +
            advice,
        true};
  if (camera.height > camera.width && !clearly(turns.about_y_deg, turns.about_x_deg))
    return DataNote{
        "the images are higher than wide, and the camera's turns do not show whether it "
        "stands upright" +
            advice,
        true};
  return std::nullopt;
}

std::optional<DataNote> odd_speed(const Trajectory& trajectory) {
  constexpr double kFastest = 100;  // [m/s]
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
          "the times are of another unit than metres and seconds",
          speed),
      true};
}

}  // namespace placegraph
