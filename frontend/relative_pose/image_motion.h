#pragma once
#include <placegraph/frontend/relative_pose/relative_pose.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Motion of the camera between two images, up to scale, from points that move in them.
class ImageMotion {
 public:
  /// Nothing if the points determine no motion, or if too few of them agree with it.
  static std::optional<ImageMotion> estimate(const Camera& camera,
                                             const std::vector<Eigen::Vector2d>& px_ref,
                                             const std::vector<Eigen::Vector2d>& px_cur,
                                             Random& random);
  /// Displacement from a pixel of the first image to the nearest pixel of the second one at which
  /// the motion allows its point, at any depth.
  struct Displacement {
    Eigen::Vector2d px = Eigen::Vector2d::Zero();
    double sigma_px = 0;  ///< standard deviation of its length by that of the motion
  };
  /// Nothing for a pixel on which the motion says nothing, such as that of its own direction.
  std::optional<Displacement> least_displacement(const Eigen::Vector2d& px) const;

 private:
  ImageMotion(const Camera& camera, const RelativePose& pose) : camera_(camera), pose_(pose) {}
  std::optional<Displacement> by_rotation(const Eigen::Vector3d& ray,
                                          const Eigen::Vector2d& px) const;
  std::optional<Displacement> by_epipolar_line(const SE3& T_ref_cur,
                                               const Eigen::Vector3d& ray) const;

  Camera camera_;
  RelativePose pose_;
};

}  // namespace placegraph
