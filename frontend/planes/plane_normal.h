#pragma once
#include <placegraph/frontend/planes/homography.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/options.h>

#include <array>
#include <vector>

namespace placegraph {

/// Unit normal of a plane in the reference camera, estimated from homographies to several views.
struct PlaneNormal {
  /// kTooFewData: no view differs enough from the reference; kDegenerate: the views do not
  /// determine the normal (no parallax), or two readings of them are equally good.
  Outcome outcome;
  Eigen::Vector3d normal_ref = Eigen::Vector3d::UnitZ();
  double sigma_rad = 0;  ///< standard deviation in its more uncertain direction
  int views = 0;
};

/// Estimates the normal of a plane from several homographies.
///
/// One homography has two readings (Malis & Vargas 2007), but the normal in the reference is the
/// same for all views: it is the one whose motions by motion_from_homography explain best the
/// positions of the region's corners, by least squares over the normal's two degrees of freedom,
/// started from every reading of every view.
class PlaneNormalEstimator {
 public:
  PlaneNormalEstimator(const Eigen::Matrix3d& K, const std::vector<Eigen::Vector2d>& corners_ref_px,
                       const PlaneNormalOptions& options);
  /// Adds a view; true if it was kept. The corners must be in front of both cameras.
  bool add(const Eigen::Matrix3d& H_cur_ref);
  PlaneNormal estimate() const;

 private:
  double apart_px(const Eigen::Matrix3d& Ha, const Eigen::Matrix3d& Hb) const;

  Eigen::Matrix3d K_;
  std::vector<Eigen::Vector2d> corners_px_;
  PlaneNormalOptions options_;
  double spacing_px_;
  std::vector<Eigen::Matrix3d> views_;
};

}  // namespace placegraph
