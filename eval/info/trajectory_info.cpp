#include <placegraph/eval/info/likely_conventions.h>
#include <placegraph/eval/info/motion_axes.h>
#include <placegraph/eval/info/motion_steps.h>
#include <placegraph/eval/info/trajectory_info.h>
#include <placegraph/graph/core/error.h>

#include <string>

namespace placegraph {
namespace {

constexpr double kSpeedOver_s = 0.1;  // shorter steps are the noise of poses at high rates. Chosen.

void take_speeds(const PosedFrames& frames, TrajectoryInfo& info) {
  std::vector<double> speeds, turns;
  for (const MotionOver& motion : motions_over(frames, frames.has_times ? kSpeedOver_s : 1)) {
    speeds.push_back(frames.distance_m(motion.from, motion.to) / motion.time);
    if (frames.has_orientation)
      turns.push_back(frames.angle_deg(motion.from, motion.to) / motion.time);
  }
  info.speed = spread_of(std::move(speeds));
  info.turning_deg = spread_of(std::move(turns));
}

void take_box(const PosedFrames& frames, TrajectoryInfo& info) {
  if (frames.size() == 0) return;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : frames.p_world) box.extend(p);
  info.extent_m = box.sizes();
}

std::size_t repeated_poses(const Trajectory& trajectory) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const auto& before = trajectory.poses[i - 1].T_world_body;
    const auto& T = trajectory.poses[i].T_world_body;
    count += before && T && before->matrix() == T->matrix();
  }
  return count;
}

void check_stamps(const Trajectory& trajectory) {
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    require(trajectory.poses[i].stamp_ns > trajectory.poses[i - 1].stamp_ns,
            "stamp of frame " + std::to_string(i) + " does not increase");
}

}  // namespace

TrajectoryInfo trajectory_info(const Trajectory& trajectory) {
  check_stamps(trajectory);
  const PosedFrames frames(trajectory);
  TrajectoryInfo info;
  info.frames = trajectory.size();
  info.posed = frames.size();
  info.has_times = trajectory.has_times;
  info.has_orientation = trajectory.has_orientation;
  info.warnings = trajectory.warnings;
  if (!trajectory.poses.empty()) {
    info.first_ns = trajectory.poses.front().stamp_ns;
    info.last_ns = trajectory.poses.back().stamp_ns;
  }
  info.length_m = trajectory.path_length();
  take_box(frames, info);
  std::vector<double> spacings;
  for (std::size_t i = 1; i < frames.size(); ++i)
    spacings.push_back(frames.times[i] - frames.times[i - 1]);
  info.spacing_s = spread_of(std::move(spacings));
  take_speeds(frames, info);
  info.repeated = repeated_poses(trajectory);
  info.gaps = gaps_in(frames);
  info.stops = stops_in(frames);
  info.jumps = jumps_in(frames, info.extent_m.norm());
  info.plane = motion_plane(frames);
  info.forward = forward_axis(frames);
  info.quaternions = likely_quaternions(frames);
  info.length_unit = likely_length_unit(frames, info.speed);
  info.time_unit = likely_time_unit(frames);
  return info;
}

}  // namespace placegraph
