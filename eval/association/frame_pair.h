#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A pose of the ground truth and the pose of the estimate for the same frame.
///
/// Matrices are as in the files, not re-orthonormalized, as in the KITTI devkit and other tools.
struct FramePair {
  int frame = 0;              ///< index in the ground truth
  std::int64_t stamp_ns = 0;  ///< stamp of the ground truth; an index if it has no times
  Eigen::Isometry3d T_world_truth = Eigen::Isometry3d::Identity();  ///< the true pose [m]
  std::optional<Eigen::Isometry3d> T_world_estimate;  ///< nothing where the frame is lost
};

/// T_a_b = T_world_a^-1 T_world_b by the general 4x4 inverse, as in the KITTI devkit.
///
/// Matrices with seven digits are not exactly orthonormal, and transposing the rotation instead
/// changes the fourth digit of r_rel.
inline Eigen::Matrix4d relative_pose(const Eigen::Isometry3d& T_world_a,
                                     const Eigen::Isometry3d& T_world_b) {
  return T_world_a.matrix().inverse() * T_world_b.matrix();
}

/// Angle [rad], in [0, pi], of a rotation matrix that may be orthonormal to some digits only.
double rotation_angle(const Eigen::Matrix3d& R);

/// Angle [rad], in [0, pi], of the part of a rotation about an axis (swing and twist).
double twist_angle(const Eigen::Matrix3d& R, const Eigen::Vector3d& axis);

/// Length of the true path [m] up to every frame; 0 at the first.
std::vector<double> travelled_m(const std::vector<FramePair>& pairs);

}  // namespace placegraph
