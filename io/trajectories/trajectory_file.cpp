#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <cmath>
#include <iterator>

namespace placegraph {
namespace {

using Fields = std::vector<std::string_view>;

constexpr double kQuaternionTolerance = 1e-2;
constexpr double kRotationTolerance = 1e-2;

std::optional<TrajectoryFormat> format_of_line(std::string_view line) {
  if (line.find(',') != line.npos) return TrajectoryFormat::kEuroc;
  Fields fields;
  split_blank(line, fields);
  if (fields.size() == 12) return TrajectoryFormat::kKitti;
  if (fields.size() == 8) return TrajectoryFormat::kTum;
  return std::nullopt;
}

void check_rotation(const TextFile& file, const Eigen::Matrix3d& R) {
  const double deviation = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (deviation > kRotationTolerance || R.determinant() < 0) {
    file.fail(
        fmt::format("the 3x3 part is not a rotation (R^T R differs from 1 by {:.3g}, "
                    "determinant {:.3g})",
                    deviation, R.determinant()));
  }
}

std::optional<Eigen::Isometry3d> parse_kitti(const TextFile& file, const Fields& fields) {
  if (fields.size() != 12) {
    file.fail(fmt::format("expected 12 numbers of a 3x4 pose, found {}", fields.size()));
  }
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  int nans = 0;
  for (int i = 0; i < 12; ++i) {
    const double value = file.number_or_nan(fields[static_cast<std::size_t>(i)], "pose");
    T.matrix()(i / 4, i % 4) = value;
    nans += std::isnan(value);
  }
  if (nans == 12) return std::nullopt;
  if (nans > 0) file.fail(fmt::format("{} of 12 numbers are nan: a lost frame has twelve", nans));
  check_rotation(file, T.linear());
  return T;
}

Eigen::Isometry3d pose_from(const TextFile& file, const Eigen::Vector3d& t,
                            const Eigen::Quaterniond& q) {
  if (!(std::abs(q.norm() - 1) <= kQuaternionTolerance)) {
    file.fail(fmt::format("the quaternion has length {:.6g}, not 1", q.norm()));
  }
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = q.normalized().toRotationMatrix();
  T.translation() = t;
  return T;
}

StampedPose parse_tum(const TextFile& file, const Fields& fields) {
  if (fields.size() != 8) {
    file.fail(fmt::format("expected 8 numbers (t tx ty tz qx qy qz qw), found {}", fields.size()));
  }
  double v[7];
  for (std::size_t i = 0; i < 7; ++i) v[i] = file.number(fields[i + 1], "pose");
  return {file.seconds_as_ns(fields[0], "time"),
          pose_from(file, {v[0], v[1], v[2]}, {v[6], v[3], v[4], v[5]})};
}

StampedPose parse_euroc(const TextFile& file, const Fields& fields) {
  if (fields.size() < 8) {
    file.fail(fmt::format("expected t_ns,px,py,pz,qw,qx,qy,qz, found {} columns", fields.size()));
  }
  double v[7];
  for (std::size_t i = 0; i < 7; ++i) v[i] = file.number(fields[i + 1], "pose");
  return {file.integer(fields[0], "time [ns]"),
          pose_from(file, {v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]})};
}

void add_in_order(const TextFile& file, StampedPose pose, Trajectory& trajectory) {
  if (!trajectory.poses.empty() && pose.stamp_ns <= trajectory.poses.back().stamp_ns) {
    file.fail(fmt::format("time {} ns does not increase", pose.stamp_ns));
  }
  trajectory.poses.push_back(std::move(pose));
}

void set_times(const std::string& path, const std::string& times_path, Trajectory& trajectory) {
  trajectory.has_times = !times_path.empty();
  if (times_path.empty()) return;
  const std::vector<std::int64_t> stamps_ns = read_times(times_path);
  if (stamps_ns.size() != trajectory.size()) {
    throw FileError(times_path, fmt::format("holds {} times, but {} holds {} poses",
                                            stamps_ns.size(), path, trajectory.size()));
  }
  for (std::size_t i = 0; i < stamps_ns.size(); ++i) trajectory.poses[i].stamp_ns = stamps_ns[i];
}

using Buffer = std::back_insert_iterator<fmt::memory_buffer>;

void format_kitti(const StampedPose& pose, Buffer out) {
  if (!pose.T_world_body) {
    fmt::format_to(out, "nan nan nan nan nan nan nan nan nan nan nan nan\n");
    return;
  }
  const auto& T = pose.T_world_body->matrix();
  for (int row = 0; row < 3; ++row) {
    fmt::format_to(out, "{:.12f} {:.12f} {:.12f} {:.9f}{}", T(row, 0), T(row, 1), T(row, 2),
                   T(row, 3), row < 2 ? ' ' : '\n');
  }
}

/// The rotation re-orthonormalized, so that the quaternion written has length 1.
Eigen::Quaterniond unit_quaternion(const Eigen::Isometry3d& T) {
  return SO3::from_matrix(T.linear()).quaternion();
}

void format_tum(const StampedPose& pose, Buffer out) {
  if (!pose.T_world_body) return;
  const Eigen::Quaterniond q = unit_quaternion(*pose.T_world_body);
  const Eigen::Vector3d t = pose.T_world_body->translation();
  const std::int64_t s = pose.stamp_ns / 1000000000, ns = pose.stamp_ns % 1000000000;
  fmt::format_to(out, "{}{}.{:09d} {:.9f} {:.9f} {:.9f} {:.12f} {:.12f} {:.12f} {:.12f}\n",
                 pose.stamp_ns < 0 ? "-" : "", std::abs(s), std::abs(ns), t.x(), t.y(), t.z(),
                 q.x(), q.y(), q.z(), q.w());
}

void format_euroc(const StampedPose& pose, Buffer out) {
  if (!pose.T_world_body) return;
  const Eigen::Quaterniond q = unit_quaternion(*pose.T_world_body);
  const Eigen::Vector3d t = pose.T_world_body->translation();
  fmt::format_to(out, "{},{:.9f},{:.9f},{:.9f},{:.12f},{:.12f},{:.12f},{:.12f}\n", pose.stamp_ns,
                 t.x(), t.y(), t.z(), q.w(), q.x(), q.y(), q.z());
}

void check_writable(const Trajectory& trajectory, TrajectoryFormat format) {
  if (format != TrajectoryFormat::kKitti && !trajectory.has_times) {
    throw ArgumentError("the trajectory has no times, which TUM and EuRoC files need");
  }
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const StampedPose& pose = trajectory.poses[i];
    if (pose.T_world_body && !pose.T_world_body->matrix().allFinite()) {
      throw ArgumentError(fmt::format("pose {} of the trajectory is not finite", i));
    }
    if (i > 0 && pose.stamp_ns <= trajectory.poses[i - 1].stamp_ns) {
      throw ArgumentError(fmt::format("pose {} of the trajectory: time does not increase", i));
    }
  }
}

}  // namespace

TrajectoryFormat detect_trajectory_format(const std::string& path) {
  TextFile file(path);
  std::string_view line;
  if (!file.next_data(line)) throw FileError(path, "holds no poses");
  if (const auto format = format_of_line(line)) return *format;
  file.fail(
      "is no trajectory: expected 12 numbers (KITTI), 8 numbers (TUM) or commas (EuRoC), found " +
      in_quotes(line));
}

Trajectory read_trajectory(const std::string& path, const std::string& times_path) {
  TextFile file(path);
  std::string_view line;
  std::optional<TrajectoryFormat> format;
  Fields fields;
  Trajectory trajectory;
  while (file.next_data(line)) {
    if (!format) format = format_of_line(line);
    if (!format) {
      file.fail(
          "is no trajectory: expected 12 numbers (KITTI), 8 numbers (TUM) or commas (EuRoC), "
          "found " +
          in_quotes(line));
    }
    if (*format == TrajectoryFormat::kEuroc) {
      split_comma(line, fields);
      add_in_order(file, parse_euroc(file, fields), trajectory);
      continue;
    }
    split_blank(line, fields);
    if (*format == TrajectoryFormat::kTum) {
      add_in_order(file, parse_tum(file, fields), trajectory);
    } else {
      const auto index = static_cast<std::int64_t>(trajectory.size());
      trajectory.poses.push_back({index, parse_kitti(file, fields)});
    }
  }
  if (!format) throw FileError(path, "holds no poses");
  if (*format == TrajectoryFormat::kKitti) {
    set_times(path, times_path, trajectory);
  } else if (!times_path.empty()) {
    throw ArgumentError(path + ": has times of its own, so that none are taken from " + times_path);
  }
  return trajectory;
}

void write_trajectory(const std::string& path, const Trajectory& trajectory,
                      TrajectoryFormat format) {
  check_writable(trajectory, format);
  fmt::memory_buffer text;
  if (format == TrajectoryFormat::kTum) {
    fmt::format_to(std::back_inserter(text), "# t tx ty tz qx qy qz qw\n");
  } else if (format == TrajectoryFormat::kEuroc) {
    fmt::format_to(std::back_inserter(text), "#t_ns,px,py,pz,qw,qx,qy,qz\n");
  }
  for (const StampedPose& pose : trajectory.poses) {
    switch (format) {
      case TrajectoryFormat::kKitti:
        format_kitti(pose, std::back_inserter(text));
        break;
      case TrajectoryFormat::kTum:
        format_tum(pose, std::back_inserter(text));
        break;
      case TrajectoryFormat::kEuroc:
        format_euroc(pose, std::back_inserter(text));
        break;
    }
  }
  AtomicFile file(path);
  file.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
  file.commit();
}

}  // namespace placegraph
