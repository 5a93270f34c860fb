#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <array>
#include <vector>

namespace placegraph {

/// Sampson error of two rays with z = 1 for a relative pose `T_ref_cur`.
///
/// The first-order distance of the two pixels to the nearest pair of pixels whose rays intersect
/// (Sampson 1982), `f x_ref^T E x_cur / |(E x_cur, E^T x_ref)_xy|` with E = [t]x R. The translation
/// may have any length except zero.
class EpipolarError {
 public:
  EpipolarError(const Camera& camera, const SE3& T_ref_cur);
  /// Signed error [px]; NaN if both rays are parallel to the translation.
  ///
  /// `J`, if given, receives the derivative by the right tangent of T_ref_cur; along the
  /// translation it is zero.
  double operator()(const Eigen::Vector3d& x_ref, const Eigen::Vector3d& x_cur,
                    Eigen::Matrix<double, 1, 6>* J = nullptr) const;

 private:
  double focal_px_;
  Eigen::Matrix3d E_;
  std::array<Eigen::Matrix3d, 6> dE_;
};

/// Parallax of two views of rays with z = 1 under a motion `T_ref_cur`.
struct TwoViewParallax {
  double median_px = 0;  ///< median displacement of the rays after the rotation is removed
  int ahead = 0;         ///< rays that intersect in front of both cameras
  int behind = 0;        ///< rays that intersect behind both: in front for the opposite translation
};
TwoViewParallax two_view_parallax(const Camera& camera, const SE3& T_ref_cur,
                                  const std::vector<Eigen::Vector3d>& x_ref,
                                  const std::vector<Eigen::Vector3d>& x_cur,
                                  const std::vector<int>& indices);

/// Rays with z = 1 of pixels; throws ArgumentError for a pixel outside the lens model.
std::vector<Eigen::Vector3d> rays_of(const Camera& camera, const std::vector<Eigen::Vector2d>& px);

}  // namespace placegraph
