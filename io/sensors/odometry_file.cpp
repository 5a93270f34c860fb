#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/sensors/odometry_file.h>
#include <placegraph/io/trajectories/repeated_rows.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace placegraph {
namespace {

using Fields = std::vector<std::string_view>;

constexpr double kMaxStep_m = 1e9;  ///< longer than any real step; its square does not overflow

SE3 parse_pose(const TextFile& file, const Fields& fields, std::size_t at) {
  double v[7];
  for (std::size_t i = 0; i < 7; ++i) v[i] = file.number(fields[at + i], "pose");
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (std::abs(q.norm() - 1) > 1e-2) file.fail("quaternion is not of unit length");
  return SE3(q.normalized().toRotationMatrix(), Eigen::Vector3d(v[0], v[1], v[2]));
}

/// Parses six standard deviations or the 21 numbers of an upper triangle.
Matrix6d parse_covariance(const TextFile& file, const Fields& fields, std::size_t at) {
  Matrix6d covariance = Matrix6d::Zero();
  if (fields.size() - at == 6) {
    for (int i = 0; i < 6; ++i) {
      const double sigma = file.number(fields[at + i], "standard deviation");
      if (!(sigma > 0)) file.fail("standard deviation must be positive");
      covariance(i, i) = sigma * sigma;
    }
    return covariance;
  }
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j)
      covariance(i, j) = covariance(j, i) = file.number(fields[at++], "covariance");
  if (covariance.llt().info() != Eigen::Success) file.fail("covariance is not positive definite");
  return covariance;
}

/// Reads poses of the frames, or poses with their own times, in any format of read_trajectory.
MeasuredMotion read_poses(const std::string& path, const MotionNoise& noise,
                          const std::vector<std::int64_t>& stamps_ns, const LogSink& log) {
  Trajectory trajectory = read_trajectory(path);
  for (const std::string& warning : trajectory.warnings)
    if (log) log(LogLevel::kWarning, warning);
  if (trajectory.has_times) return MeasuredMotion(trajectory, noise);
  if (trajectory.size() != stamps_ns.size())
    throw FileError(path, std::to_string(trajectory.size()) +
                              " poses without times, but the sequence has " +
                              std::to_string(stamps_ns.size()) + " frames");
  for (std::size_t i = 0; i < stamps_ns.size(); ++i) trajectory.poses[i].stamp_ns = stamps_ns[i];
  if (trajectory.posed() < 2) throw FileError(path, "at least two poses needed");
  return MeasuredMotion(trajectory, noise);
}

}  // namespace

MeasuredMotion read_odometry(const std::string& path, const MotionNoise& noise,
                             const std::vector<std::int64_t>& stamps_ns, const LogSink& log) {
  noise.check();
  TextFile file(path);
  std::string_view line;
  Fields fields;
  std::vector<MotionStep> steps;
  std::vector<StampedPose> poses;
  std::vector<RepeatedStamp> repeated;
  std::size_t count = 0;
  bool first = true;
  std::int64_t last_ns = 0;
  SE3 T_odom_last;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (first) {
      count = fields.size();
      const bool motion_lines =
          line.find_first_of(",;") == line.npos &&
          (count == 8 || count == 9 || count == 14 || count == 15 || count == 29 || count == 30);
      if (!motion_lines) return read_poses(path, noise, stamps_ns, log);
    }
    const bool is_pose = count == 8 || count == 14 || count == 29;
    if (fields.size() != count)
      file.fail(std::to_string(count) + " fields needed as in the first line, not " +
                std::to_string(fields.size()));
    MotionStep step;
    step.to_ns = file.seconds_as_ns(fields[is_pose ? 0 : 1], "time");
    step.from_ns = is_pose ? last_ns : file.seconds_as_ns(fields[0], "time");
    const std::size_t at = is_pose ? 1 : 2;
    const SE3 pose = parse_pose(file, fields, at);
    if (is_pose && !first && step.to_ns == last_ns) {
      repeated.push_back(
          {static_cast<std::size_t>(file.line()), poses.size() - 1, pose.isometry()});
      continue;
    }
    step.T_from_to = is_pose ? T_odom_last.inverse() * pose : pose;
    if (!(is_pose && first) && !(step.T_from_to.translation().norm() <= kMaxStep_m))
      file.fail("the step is longer than 1e9 m");
    step.covariance =
        count - at == 7 ? noise.covariance(step.T_from_to) : parse_covariance(file, fields, at + 7);
    if (!(is_pose && first) && (step.to_ns <= step.from_ns || (!first && step.from_ns < last_ns)))
      file.fail("times must increase");
    if (!(is_pose && first)) steps.push_back(step);
    if (is_pose) poses.push_back({step.to_ns, pose.isometry()});
    last_ns = step.to_ns;
    T_odom_last = pose;
    first = false;
  }
  const std::string warning = repeated_rows_warning(path, poses, repeated);
  if (steps.empty()) throw FileError(path, "there is no step of motion in it");
  if (!warning.empty() && log) log(LogLevel::kWarning, warning);
  return MeasuredMotion(std::move(steps));
}

}  // namespace placegraph
