#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// One frame of the ground truth and what the estimate says of it. The matrices stand as the files
/// gave them, not re-orthonormalized: the peers' figures are computed so.
struct FramePair {
  int frame = 0;              ///< index in the ground truth
  std::int64_t stamp_ns = 0;  ///< of the ground truth; an index where it has no times
  Eigen::Isometry3d T_world_truth = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Isometry3d> T_world_estimate;  ///< nothing where the frame is lost
};

/// A^-1 B by the general 4x4 inverse, as the KITTI devkit has it: matrices with seven digits are
/// not exactly orthonormal, and transposing the rotation instead changes the fourth digit of r_rel.
inline Eigen::Matrix4d relative_pose(const Eigen::Isometry3d& T_world_a,
                                     const Eigen::Isometry3d& T_world_b) {
  return T_world_a.matrix().inverse() * T_world_b.matrix();
}

/// Distance driven [m] up to every frame along the ground truth, the first 0.
std::vector<double> travelled_m(const std::vector<FramePair>& pairs);

}  // namespace placegraph
