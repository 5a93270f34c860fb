#include <fmt/format.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/graph/geometry/trajectory_edit.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

// As that of images that are missing (irregular_spacing).
constexpr int kGapSpacings = 5;
constexpr double kMostParts = 1e6;  // more are a mistake of units

/// A trajectory of the same kind without frames.
Trajectory emptied(const Trajectory& trajectory) {
  Trajectory empty;
  empty.has_times = trajectory.has_times;
  empty.numbered = trajectory.numbered || !trajectory.has_times;
  empty.has_orientation = trajectory.has_orientation;
  empty.warnings = trajectory.warnings;
  return empty;
}

bool is_far(const StampedPose& kept, const StampedPose& pose, const FrameSpacing& spacing) {
  const Eigen::Isometry3d &a = *kept.T_world_body, &b = *pose.T_world_body;
  if (spacing.m && (a.translation() - b.translation()).norm() >= *spacing.m) return true;
  if (spacing.s && seconds(kept.stamp_ns, pose.stamp_ns) >= *spacing.s) return true;
  const Eigen::Quaterniond q_a(a.linear()), q_b(b.linear());
  return spacing.deg && rad_to_deg(q_a.angularDistance(q_b)) >= *spacing.deg;
}

/// By how much the difference of two stamps may be rounded [s].
double rounding_of_stamps_s(const Trajectory& trajectory) {
  // Doubles since 1970 are 2^-22 s apart, and those in nanoseconds 256 ns.
  constexpr double kOfDoubles_s = 0x1p-22 + 256e-9;
  std::int64_t unit_ns = 1'000'000'000;  // of which all stamps are multiples: the last digit
  for (const StampedPose& pose : trajectory.poses)
    while (pose.stamp_ns % unit_ns != 0) unit_ns /= 10;
  return kOfDoubles_s + 1e-9 * static_cast<double>(unit_ns);
}

}  // namespace

Trajectory frames_at(const Trajectory& trajectory, const std::vector<std::size_t>& indices) {
  Trajectory part = emptied(trajectory);
  part.poses.reserve(indices.size());
  for (const std::size_t i : indices) part.poses.push_back(trajectory.poses[i]);
  return part;
}

Trajectory frames_between(const Trajectory& trajectory, std::int64_t first_ns,
                          std::int64_t last_ns) {
  Trajectory part = emptied(trajectory);
  for (const StampedPose& pose : trajectory.poses)
    if (pose.stamp_ns >= first_ns && pose.stamp_ns <= last_ns) part.poses.push_back(pose);
  return part;
}

std::int64_t longest_spacing_ns(const Trajectory& trajectory) {
  std::vector<double> spacings_ns;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    spacings_ns.push_back(
        static_cast<double>(trajectory.poses[i].stamp_ns - trajectory.poses[i - 1].stamp_ns));
  return spacings_ns.empty() ? 0 : std::llround(kGapSpacings * median_of(std::move(spacings_ns)));
}

Trajectory resample(const Trajectory& recorded, const std::vector<std::int64_t>& stamps_ns,
                    double max_gap_s) {
  Trajectory result;
  result.has_orientation = recorded.has_orientation;
  result.warnings = recorded.warnings;
  result.poses.reserve(stamps_ns.size());
  for (const std::int64_t stamp_ns : stamps_ns) {
    StampedPose pose{stamp_ns, std::nullopt};
    if (const auto T = interpolate(recorded, stamp_ns, max_gap_s))
      pose.T_world_body = T->isometry();
    result.poses.push_back(pose);
  }
  return result;
}

Trajectory spaced(const Trajectory& trajectory, FrameSpacing spacing) {
  // Rounding is small against a spacing; stamps in whole tenths of a second are no rounded ones.
  constexpr double kMostRounding = 1e-3;
  if (spacing.s)
    *spacing.s -= std::min(rounding_of_stamps_s(trajectory), kMostRounding * *spacing.s);
  Trajectory part = emptied(trajectory);
  for (const StampedPose& pose : trajectory.poses)
    if (pose.T_world_body && (part.poses.empty() || is_far(part.poses.back(), pose, spacing)))
      part.poses.push_back(pose);
  return part;
}

Trajectory in_plane(Trajectory trajectory, int across) {
  for (StampedPose& pose : trajectory.poses) {
    if (!pose.T_world_body) continue;
    pose.T_world_body->translation()(across) = 0;
    // The twist of the quaternion about the axis is the nearest rotation about it.
    const Eigen::Quaterniond q(pose.T_world_body->linear());
    const double angle = 2 * std::atan2(q.vec()(across), q.w());
    pose.T_world_body->linear() =
        Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(across)).toRotationMatrix();
  }
  return trajectory;
}

MergedTrajectory merge(std::vector<Trajectory> parts, Overlap overlap) {
  require(!parts.empty(), "merge: there is no trajectory");
  for (const Trajectory& part : parts) {
    require(part.has_times, "merge: a trajectory has no times");
    require(part.size() > 0, "merge: a trajectory has no frame");
    require(part.has_orientation == parts.front().has_orientation,
            "merge: some trajectories have orientations, others have positions alone");
  }
  std::ranges::stable_sort(parts, {}, [](const Trajectory& t) { return t.poses[0].stamp_ns; });
  MergedTrajectory merged;
  merged.trajectory = emptied(parts.front());
  merged.trajectory.warnings.clear();
  std::vector<StampedPose>& poses = merged.trajectory.poses;
  for (const Trajectory& part : parts) {
    const std::int64_t first_ns = part.poses.front().stamp_ns;
    require(overlap == Overlap::kFirstKept || poses.empty() || first_ns > poses.back().stamp_ns,
            poses.empty() ? ""
                          : fmt::format("merge: a trajectory begins at {} ns, before the end of an "
                                        "earlier one at {} ns",
                                        first_ns, poses.back().stamp_ns));
    const std::int64_t after_ns = poses.empty() ? first_ns - 1 : poses.back().stamp_ns;
    for (const StampedPose& pose : part.poses)
      if (pose.stamp_ns > after_ns)
        poses.push_back(pose);
      else
        ++merged.left_out;
    merged.trajectory.warnings.insert(merged.trajectory.warnings.end(), part.warnings.begin(),
                                      part.warnings.end());
  }
  return merged;
}

std::vector<Trajectory> split_at_gaps(const Trajectory& trajectory, double max_gap_s) {
  require(trajectory.has_times, "split: the trajectory has no times");
  std::vector<Trajectory> parts;
  std::vector<StampedPose> lost;  // since the last pose
  for (const StampedPose& pose : trajectory.poses) {
    if (!pose.T_world_body) {
      lost.push_back(pose);
      continue;
    }
    const bool goes_on =
        !parts.empty() && seconds(parts.back().poses.back().stamp_ns, pose.stamp_ns) <= max_gap_s;
    if (!goes_on) parts.push_back(emptied(trajectory));
    std::vector<StampedPose>& poses = parts.back().poses;
    if (goes_on) poses.insert(poses.end(), lost.begin(), lost.end());
    lost.clear();
    poses.push_back(pose);
  }
  return parts;
}

std::vector<Trajectory> split_every(const Trajectory& trajectory, double length_s) {
  require(trajectory.has_times, "split: the trajectory has no times");
  require(length_s > 0, "split: the length of a part is not positive");
  std::vector<Trajectory> parts;
  if (trajectory.poses.empty()) return parts;
  const std::int64_t first_ns = trajectory.poses.front().stamp_ns;
  require(seconds(first_ns, trajectory.poses.back().stamp_ns) / length_s < kMostParts,
          "split: these are more than a million parts");
  double last = -1;
  for (const StampedPose& pose : trajectory.poses) {
    const double number = std::floor(seconds(first_ns, pose.stamp_ns) / length_s);
    if (number != last) parts.push_back(emptied(trajectory));
    last = number;
    parts.back().poses.push_back(pose);
  }
  std::erase_if(parts, [](const Trajectory& part) { return part.posed() == 0; });
  return parts;
}

}  // namespace placegraph
