#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/pose_table.h>
#include <placegraph/io/trajectories/posed_images.h>
#include <placegraph/io/trajectories/repeated_rows.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <iterator>

namespace placegraph {
namespace {

/// Collects the lines of a table.
class Reader {
 public:
  explicit Reader(const PoseTable& table) : table_(table) {
    trajectory_.has_times = table.columns().has_times();
    trajectory_.numbered = table.columns().unit == StampUnit::kFrameNumber;
  }

  void add(const PoseLine& line) {
    const auto index = static_cast<std::int64_t>(trajectory_.size());
    const std::int64_t stamp = table_.columns().stamp ? line.stamp : index;
    if (index > 0 && trajectory_.has_times && stamp == trajectory_.poses.back().stamp_ns) {
      repeated_.push_back({static_cast<std::size_t>(table_.file().line()),
                           static_cast<std::size_t>(index - 1), line.T_world_body});
      return;
    }
    if (index > 0 && stamp <= trajectory_.poses.back().stamp_ns)
      table_.file().fail(trajectory_.numbered
                             ? fmt::format("the number {} of the frame does not increase", stamp)
                             : fmt::format("time {} ns does not increase", stamp));
    if (line.T_world_body && !line.oriented && table_.columns().quaternion && !first_bare_line_)
      first_bare_line_ = table_.file().line();
    oriented_ += line.T_world_body && line.oriented;
    if (index == 0) {
      first_line_ = table_.file().line();
      // Growing would hold the poses twice.
      trajectory_.poses.reserve(1 + table_.file().lines_left());
    }
    trajectory_.poses.push_back({stamp, line.T_world_body});
  }

  int first_line() const { return first_line_; }

  Trajectory finish() {
    trajectory_.has_orientation = oriented_ > 0 || trajectory_.posed() == 0;
    if (oriented_ > 0 && first_bare_line_ > 0)
      throw FileError(table_.file().path(), first_bare_line_,
                      "the quaternion has length 0 or is nan, not 1 as on other lines");
    if (!repeated_.empty())
      trajectory_.warnings.push_back(
          repeated_rows_warning(table_.file().path(), trajectory_.poses, repeated_));
    return std::move(trajectory_);
  }

 private:
  const PoseTable& table_;
  Trajectory trajectory_;
  std::vector<RepeatedStamp> repeated_;
  std::size_t oriented_ = 0;
  int first_line_ = 0, first_bare_line_ = 0;
};

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

/// The re-orthonormalized rotation, so that the written quaternion has length 1.
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

Trajectory read_table(TextFile file, Orientation orientation) {
  PoseTable table(std::move(file));
  Reader reader(table);
  PoseLine line;
  while (table.next(line)) reader.add(line);
  Trajectory trajectory = reader.finish();
  if (orientation == Orientation::kNeeded && !trajectory.has_orientation)
    throw FileError(
        table.file().path(), reader.first_line(),
        "has positions alone (" + table.columns().text() + "), but orientations are needed here");
  return trajectory;
}

Trajectory read_any_poses(const std::string& path, Orientation orientation) {
  if (is_binary_model(path)) return read_binary_images_poses(path);
  TextFile file(path);
  if (std::optional<Trajectory> images = read_posed_images(file)) return std::move(*images);
  return read_table(std::move(file), orientation);
}

void check_writable(const Trajectory& trajectory, TrajectoryFormat format) {
  require(trajectory.has_orientation,
          "the trajectory has positions alone: its poses have no orientation to write");
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

void give_times(Trajectory& trajectory, const std::string& path, const std::string& times_path) {
  require(!trajectory.has_times,
          path + ": has times of its own, so that none are taken from " + times_path);
  const std::vector<std::int64_t> stamps_ns = read_times(times_path);
  const bool numbered = trajectory.numbered;
  if (!numbered && stamps_ns.size() != trajectory.size())
    throw FileError(times_path, fmt::format("holds {} times, but {} holds {} poses",
                                            stamps_ns.size(), path, trajectory.size()));
  for (StampedPose& pose : trajectory.poses) {
    if (pose.stamp_ns < 0 || pose.stamp_ns >= static_cast<std::int64_t>(stamps_ns.size()))
      throw FileError(times_path, fmt::format("holds {} times, but {} holds frame {}",
                                              stamps_ns.size(), path, pose.stamp_ns));
    pose.stamp_ns = stamps_ns[static_cast<std::size_t>(pose.stamp_ns)];
  }
  trajectory.has_times = true;
  trajectory.numbered = false;
}

Trajectory read_trajectory(const std::string& path, const std::string& times_path,
                           Orientation orientation) {
  Trajectory trajectory = read_any_poses(path, orientation);
  if (!times_path.empty()) give_times(trajectory, path, times_path);
  return trajectory;
}

Trajectory read_timed_poses(const std::string& path, Orientation orientation) {
  Trajectory trajectory = read_trajectory(path, {}, orientation);
  if (!trajectory.has_times)
    throw FileError(path, "has poses without times, which are needed here");
  return trajectory;
}

Trajectory read_frame_poses(const std::string& path) {
  Trajectory trajectory = read_trajectory(path);
  if (trajectory.has_times)
    throw FileError(path, "has times of its own, but is read frame by frame (KITTI: 12 numbers)");
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
