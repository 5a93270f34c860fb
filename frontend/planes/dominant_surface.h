#pragma once
#include <placegraph/frontend/planes/inverse_depth_plane.h>
#include <placegraph/graph/image/image.h>

#include <functional>

namespace placegraph {

/// Depths of pixels as a sensor tells them, with the inverse depths [1/m] that are expected; as
/// many answers as pixels, none where it does not see.
using SurfaceDepths = std::function<std::vector<std::optional<InverseDepth>>(
    const std::vector<Eigen::Vector2f>& px, const std::vector<double>& expected)>;

struct DominantSurfaceOptions {
  InverseDepthPlaneOptions fit;
  /// The road that is looked at first, in distances of the surface; the other regions lie in it or
  /// beside it.
  double near_heights = 2, far_heights = 12, half_width_heights = 1.5;
  int pixels = 400;                      ///< asked for in one region
  double min_share = 0.4;                ///< of a region's pixels that must lie on the surface
  double mounting_sigma_deg = 5;         ///< pitch and roll before anything was seen
  double mounting_sigma_distance = 0.3;  ///< height before anything was seen, as a share of it
  double pitching_sigma_deg = 0.3;       ///< pitch and roll from one look to the next
  double distance_drift = 0.005;         ///< height from one look to the next, as a share of it
  double slope_sigma_deg = 2;            ///< pitch and roll where the slope may have changed
  void check() const;
};
void visit(OptionVisitor& field, DominantSurfaceOptions& options);

/// Where a surface is looked at.
enum class SurfaceRegion { kAhead, kNear, kFar, kLeft, kRight };
const char* to_string(SurfaceRegion region);

struct SurfaceLook {
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
  [[nodiscard]] SurfaceLook look(const SurfaceDepths& depths, const SE3& T_cur_last,
                                 const Image& mask, Random& random);

  Plane plane_cam() const;
  /// Pixels of a region, by the surface's present place, on a regular grid of the image.
  std::vector<Eigen::Vector2f> pixels_of(SurfaceRegion region, const Image& mask = {}) const;

 private:
  void predict(const SE3& T_cur_last);
  void widen(double sigma_rad, double sigma_log_distance);
  InverseDepthPlane measure(SurfaceRegion region, const SurfaceDepths& depths, const Image& mask,
                            Random& random, SurfaceLook& look) const;

  DominantSurfaceOptions options_;
  Camera camera_;
  Eigen::Vector3d g_cam_;  // n / d
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  SurfaceRegion last_region_ = SurfaceRegion::kAhead;
};

}  // namespace placegraph
