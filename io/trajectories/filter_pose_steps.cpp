#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/trajectory_edit.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/filter_steps.h>
#include <placegraph/io/trajectories/transform_file.h>

#include <map>

namespace placegraph {
namespace {

using Isometry = Eigen::Isometry3d;

/// A step that changes every pose by itself.
template <class Change>
FilterFunction each_pose(Change change) {
  return [change](Trajectory trajectory) {
    for (StampedPose& pose : trajectory.poses) {
      if (!pose.T_world_body) continue;
      *pose.T_world_body = change(*pose.T_world_body);
      if (!trajectory.has_orientation) pose.T_world_body->linear().setIdentity();
    }
    return trajectory;
  };
}

/// The same where the orientations count.
template <class Change>
FilterFunction each_oriented_pose(Change change) {
  return [each = each_pose(change)](const Trajectory& trajectory) {
    require(trajectory.has_orientation, "the trajectory has positions alone");
    return each(trajectory);
  };
}

/// Appends the motion to every motion from pose to pose.
Trajectory propagated(Trajectory trajectory, const Isometry& T) {
  require(trajectory.has_orientation, "the trajectory has positions alone");
  std::optional<Isometry> T_read_last, T_world_last;
  for (StampedPose& pose : trajectory.poses) {
    if (!pose.T_world_body) continue;
    const Isometry read = *pose.T_world_body;
    if (T_read_last)
      *pose.T_world_body = *T_world_last * (T_read_last->inverse(Eigen::Affine) * read * T);
    T_read_last = read;
    T_world_last = *pose.T_world_body;
  }
  return trajectory;
}

FilterFunction parse_transform(FilterWords& words) {
  const bool right = words.take_if("right"), propagate = !right && words.take_if("propagate");
  if (!right && !propagate) words.take_if("left");
  const bool numbers_given = parse_double(words.peek()).has_value();
  Isometry T = Isometry::Identity();
  if (numbers_given) {
    std::vector<double> numbers;
    while (parse_double(words.peek())) numbers.push_back(words.number("a number"));
    T = transform_of(numbers);
  } else {
    T = read_transform(words.take("a file or the numbers of a transform"));
  }
  if (words.take_if("inverse")) T = T.inverse(Eigen::Affine);
  if (propagate) return [T](const Trajectory& trajectory) { return propagated(trajectory, T); };
  if (right) return each_oriented_pose([T](const Isometry& pose) { return pose * T; });
  return each_pose([T](const Isometry& pose) { return T * pose; });
}

FilterFunction parse_scale(FilterWords& words) {
  const double factor = words.number("the factor");
  require(factor > 0, "the factor is not positive");
  return each_pose([factor](Isometry pose) {
    pose.translation() *= factor;
    return pose;
  });
}

FilterFunction parse_invert(FilterWords&) {
  return each_oriented_pose([](const Isometry& pose) { return pose.inverse(Eigen::Affine); });
}

FilterFunction parse_origin(FilterWords&) {
  return [](const Trajectory& trajectory) {
    for (const StampedPose& pose : trajectory.poses)
      if (pose.T_world_body) {
        const Isometry T = pose.T_world_body->inverse(Eigen::Affine);
        return each_pose([&T](const Isometry& each) { return T * each; })(trajectory);
      }
    return trajectory;
  };
}

FilterFunction parse_project(FilterWords& words) {
  static const std::map<std::string, int> across = {{"yz", 0}, {"xz", 1}, {"xy", 2}};
  const std::string& plane = words.take("a plane: xy, xz or yz");
  const auto found = across.find(plane);
  require(found != across.end(), in_quotes(plane) + " is none of xy, xz, yz");
  return [axis = found->second](const Trajectory& trajectory) {
    return in_plane(trajectory, axis);
  };
}

/// The four numbers of the quaternion of a rotation, w x y z.
Eigen::Vector4d scalar_first_numbers(const Isometry& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return {q.w(), q.x(), q.y(), q.z()};
}

Isometry with_quaternion(Isometry pose, double w, double x, double y, double z) {
  pose.linear() = Eigen::Quaterniond(w, x, y, z).toRotationMatrix();
  return pose;
}

FilterFunction parse_quaternion(FilterWords& words) {
  const std::string& order = words.take("the order of the file: wxyz or xyzw");
  require(order == "wxyz" || order == "xyzw", in_quotes(order) + " is neither wxyz nor xyzw");
  // The numbers were read in the other order: as x y z w, if the file has w x y z.
  if (order == "wxyz")
    return each_oriented_pose([](const Isometry& pose) {
      const Eigen::Vector4d q = scalar_first_numbers(pose);
      return with_quaternion(pose, q[1], q[2], q[3], q[0]);
    });
  return each_oriented_pose([](const Isometry& pose) {
    const Eigen::Vector4d q = scalar_first_numbers(pose);
    return with_quaternion(pose, q[3], q[0], q[1], q[2]);
  });
}

/// The rotation from axes of that name to those with x forward, y left, z up.
Eigen::Matrix3d R_flu_axes(const std::string& name) {
  static const std::map<std::string, Eigen::Matrix3d> known = [] {
    std::map<std::string, Eigen::Matrix3d> all;
    all["flu"] = all["nwu"] = Eigen::Matrix3d::Identity();
    all["frd"] = all["ned"] = Eigen::Vector3d(1, -1, -1).asDiagonal();
    all["rfu"] = all["enu"] = Eigen::Matrix3d{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}};
    all["camera"] = Eigen::Matrix3d{{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}};
    all["opengl"] = Eigen::Matrix3d{{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}};
    return all;
  }();
  const auto found = known.find(name);
  require(found != known.end(),
          in_quotes(name) + " is none of camera, opengl, flu, frd, rfu, enu, ned, nwu");
  return found->second;
}

FilterFunction parse_axes(FilterWords& words) {
  const std::string which = words.take("which axes: body, world or both");
  require(which == "body" || which == "world" || which == "both",
          in_quotes(which) + " is none of body, world, both");
  const std::string pair = words.take("the change, as camera:flu");
  const std::size_t colon = pair.find(':');
  require(colon != pair.npos, in_quotes(pair) + " is no change FROM:TO, as camera:flu");
  const Eigen::Matrix3d R_from_to = R_flu_axes(pair.substr(0, colon)).transpose() *
                                    R_flu_axes(pair.substr(colon + 1));
  const Isometry T_from_to(R_from_to), T_to_from(R_from_to.transpose());
  if (which == "world")
    return each_pose([T_to_from](const Isometry& pose) { return T_to_from * pose; });
  const bool both = which == "both";
  return each_oriented_pose([both, T_from_to, T_to_from](const Isometry& pose) {
    return both ? T_to_from * pose * T_from_to : pose * T_from_to;
  });
}

}  // namespace

const std::vector<FilterStepKind>& pose_steps() {
  static const std::vector<FilterStepKind> steps = {
      {"transform", "transform FILE [inverse]",
       "moves the world by T (`left`), the body (`right`) or every motion (`propagate`)",
       parse_transform},
      {"axes", "axes WHICH FROM:TO",
       "other axes of the `body`, the `world` or `both`, as `axes body camera:flu`",
       parse_axes},
      {"origin", "origin", "moves the world so that the first pose is the identity", parse_origin},
      {"scale", "scale X", "multiplies positions by X", parse_scale},
      {"invert", "invert", "replaces every pose by its inverse", parse_invert},
      {"quaternion", "quaternion wxyz",
       "for quaternions that the file has in this order, but that were read as xyzw (or `xyzw`)",
       parse_quaternion},
      {"project", "project xy",
       "puts the poses into a plane of the world: xy, xz or yz",
       parse_project},
  };
  return steps;
}

}  // namespace placegraph
