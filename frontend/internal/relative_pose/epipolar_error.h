#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <array>
#include <vector>

namespace placegraph {

/// How far two rays with z = 1 are from meeting, for a relative pose `T_ref_cur` whose translation
/// may have any length but zero: the first-order distance of the two pixels to the pair of pixels
/// that would meet (Sampson 1982), `f x_ref^T E x_cur / |(E x_cur, E^T x_ref)_xy|` with
/// E = [t]x R.
class EpipolarError {
 public:
  EpipolarError(const Camera& camera, const SE3& T_ref_cur);
  /// [px], signed; NaN where both rays point along the translation. `J`, if given, receives the
  /// derivative by the right tangent of T_ref_cur; along the translation it is zero.
  double operator()(const Eigen::Vector3d& x_ref, const Eigen::Vector3d& x_cur,
                    Eigen::Matrix<double, 1, 6>* J = nullptr) const;

 private:
  double focal_px_;
  Eigen::Matrix3d E_;
  std::array<Eigen::Matrix3d, 6> dE_;
};

/// What two views of rays with z = 1 say of the translation of `T_ref_cur` beyond its direction.
struct TwoViewParallax {
  double median_px = 0;  ///< displacement of the rays that the rotation leaves
  int ahead = 0;         ///< rays that meet before both eyes
  int behind = 0;        ///< rays that meet behind both: before both for the opposite translation
};
TwoViewParallax two_view_parallax(const Camera& camera, const SE3& T_ref_cur,
                                  const std::vector<Eigen::Vector3d>& x_ref,
                                  const std::vector<Eigen::Vector3d>& x_cur,
                                  const std::vector<int>& indices);

/// Rays with z = 1 of pixels; throws ArgumentError for a pixel that the camera cannot have taken.
std::vector<Eigen::Vector3d> rays_of(const Camera& camera, const std::vector<Eigen::Vector2d>& px);

}  // namespace placegraph
