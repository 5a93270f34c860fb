#pragma once
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/trajectory.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

namespace placegraph::test {

/// Axis-angle rotation and translation as an isometry.
inline Eigen::Isometry3d isometry(const Eigen::Vector3d& rotation_vector,
                                  const Eigen::Vector3d& translation_m) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const double angle = rotation_vector.norm();
  if (angle > 0) T.linear() = Eigen::AngleAxisd(angle, rotation_vector / angle).toRotationMatrix();
  T.translation() = translation_m;
  return T;
}

/// A trajectory of the given poses at 10 Hz.
inline Trajectory trajectory_of(const std::vector<Eigen::Isometry3d>& T_world_cam,
                                bool has_times = true) {
  Trajectory trajectory;
  trajectory.has_times = has_times;
  for (std::size_t i = 0; i < T_world_cam.size(); ++i)
    trajectory.poses.push_back(
        {static_cast<std::int64_t>(i) * (has_times ? 100'000'000 : 1), T_world_cam[i]});
  return trajectory;
}

/// A drive over hills and bends (camera frame: z forward), about `step_m` a frame, with speed and
/// turn rate that change all the time.
inline Trajectory winding_drive(int frames, double step_m = 1.0, bool has_times = true) {
  std::vector<Eigen::Isometry3d> poses;
  Eigen::Isometry3d T_world_cam = Eigen::Isometry3d::Identity();
  for (int i = 0; i < frames; ++i) {
    poses.push_back(T_world_cam);
    const double yaw = 0.05 * std::sin(i * 0.11) + 0.01, pitch = 0.01 * std::cos(i * 0.07);
    T_world_cam = T_world_cam * isometry({pitch, yaw, 0.003 * std::sin(i * 0.05)},
                                         {0, 0, step_m * (1 + 0.4 * std::sin(i * 0.09))});
  }
  return trajectory_of(poses, has_times);
}

/// Every motion of `truth` multiplied on the right by a random one: an odometry that drifts.
inline Trajectory drifting(const Trajectory& truth, double sigma_m, double sigma_rad,
                           Random& random) {
  Trajectory noisy = truth;
  const auto noise = [&](double sigma) {
    return Eigen::Vector3d(random.normal(0, sigma), random.normal(0, sigma),
                           random.normal(0, sigma));
  };
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Eigen::Isometry3d T_a_b =
        truth.poses[i - 1].T_world_body->inverse() * *truth.poses[i].T_world_body;
    noisy.poses[i].T_world_body =
        *noisy.poses[i - 1].T_world_body * T_a_b * isometry(noise(sigma_rad), noise(sigma_m));
  }
  return noisy;
}

}  // namespace placegraph::test
