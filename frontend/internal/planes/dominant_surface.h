#pragma once
#include <placegraph/frontend/internal/planes/inverse_depth_plane.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/image/image.h>

#include <functional>

namespace placegraph {

/// Depths of pixels as a sensor tells them, with the inverse depths [1/m] that are expected; as
/// many answers as pixels, none where it does not see.
using SurfaceDepths = std::function<std::vector<std::optional<InverseDepth>>(
    const std::vector<Eigen::Vector2f>& px, const std::vector<double>& expected)>;

/// Where a surface is looked at.
enum class SurfaceRegion { kAhead, kNear, kFar, kLeft, kRight };
const char* to_string(SurfaceRegion region);

struct SurfaceAppearance {
  /// Too few data (no region shows enough depths), no consensus (in none do enough of them lie on
  /// a plane), inconsistent (there is a plane, but not where the surface can be: a vehicle's side,
  /// or the slope has changed, which the next look will believe).
  Outcome outcome;
  Plane plane_cam;  ///< filtered; as predicted where the outcome is no
  double sigma_normal_rad = 0;
  double sigma_log_distance = 0;
  SurfaceRegion region = SurfaceRegion::kAhead;
  double share = 0;                     ///< of the region's depths that lie on the surface
  double chi2 = 0;                      ///< of the innovation, 3 degrees of freedom
  std::vector<Eigen::Vector2f> on_px;   ///< pixels on the surface
  std::vector<Eigen::Vector2f> off_px;  ///< pixels of other things: vehicles, kerbs
};

/// The surface a camera moves over or along (Siddiqui 2015, "dominant surface"), followed from look
/// to look by a filter of its n / d, that is pitch, roll and height: predicted by the motion, with
/// the vehicle's nodding added, and measured by a plane through the depths of a region below the
/// horizon. Where a region shows too little of it, or something else, the next one is tried: ahead,
/// near, far, left, right, the last good one first. What lies off the plane is told apart by its
/// residual. A plane that contradicts the prediction is not taken at once; but the filter opens
/// by slope_sigma_deg, so that a slope is followed from the second look on.
class DominantSurface {
 public:
  /// `mounting_cam`: about where the surface is in the camera.
  DominantSurface(const DominantSurfaceOptions& options, const Camera& camera,
                  const Plane& mounting_cam);

  /// `T_cur_last`: the motion since the last look, identity if none is known or there was none.
  /// `mask`: 0 = not the surface (a label image's answer), CV_8UC1 of the camera's size or empty.
  [[nodiscard]] SurfaceAppearance look(const SurfaceDepths& depths, const SE3& T_cur_last,
                                       const Image& mask, Random& random);

  Plane plane_cam() const;
  /// Pixels of a region, by the surface's present place, on a regular grid of the image.
  std::vector<Eigen::Vector2f> pixels_of(SurfaceRegion region, const Image& mask = {}) const;

 private:
  void predict(const SE3& T_cur_last);
  void widen(double sigma_rad, double sigma_log_distance);
  InverseDepthPlane measure(SurfaceRegion region, const SurfaceDepths& depths, const Image& mask,
                            Random& random, SurfaceAppearance& look) const;

  DominantSurfaceOptions options_;
  Camera camera_;
  Eigen::Vector3d g_cam_;  // n / d
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  SurfaceRegion last_region_ = SurfaceRegion::kAhead;
};

}  // namespace placegraph
