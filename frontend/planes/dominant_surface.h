#pragma once
#include <placegraph/frontend/planes/inverse_depth_plane.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/image/image.h>

#include <functional>

namespace placegraph {

/// Initial standard deviation of the camera's pitch and roll above the surface. Chosen.
constexpr double kMountingSigma_deg = 5;

/// Measures the depths of pixels, given the predicted inverse depths [1/m].
///
/// Returns one value per pixel, empty where there is no measurement.
using SurfaceDepths = std::function<std::vector<std::optional<MeasuredInverseDepth>>(
    const std::vector<Eigen::Vector2f>& px, const std::vector<double>& expected)>;

/// Region of the surface that is measured.
enum class SurfaceRegion { kAhead, kNear, kFar, kLeft, kRight };
const char* to_string(SurfaceRegion region);

struct SurfaceAppearance {
  /// Too few data (no region has enough depths), no consensus (in no region are enough of them on a
  /// plane), inconsistent (there is a plane, but it contradicts the filter: a vehicle's side, or a
  /// new slope, which the next measurement will accept).
  Outcome outcome;
  Plane plane_cam;  ///< filtered; only predicted if the outcome is a failure
  double sigma_normal_rad = 0;
  double sigma_log_distance = 0;
  SurfaceRegion region = SurfaceRegion::kAhead;
  double share = 0;                     ///< share of the region's depths that are on the surface
  double chi2 = 0;                      ///< chi2 of the innovation, 3 degrees of freedom
  std::vector<Eigen::Vector2f> on_px;   ///< pixels on the surface
  std::vector<Eigen::Vector2f> off_px;  ///< pixels of other things: vehicles, kerbs
};

/// Tracks the surface that a camera moves over or along (Siddiqui 2015, "dominant surface").
///
/// A filter estimates n / d, which is pitch, roll and height. It is predicted by the motion, with
/// noise for the vehicle's pitching, and measured by a plane through the depths of a region below
/// the horizon. If a region has too few depths on the surface, or another plane, the next one is
/// tried: ahead, near, far, left, right, the last good one first. The residual separates pixels
/// that are not on the plane. A plane that contradicts the prediction is not accepted at once; the
/// variance of the filter grows by slope_sigma_deg, so that a slope is tracked from the second
/// measurement on.
class DominantSurface {
 public:
  /// Starts the filter. `mounting_cam`: approximate surface in the camera frame.
  DominantSurface(const DominantSurfaceOptions& options, const Camera& camera,
                  const Plane& mounting_cam);

  /// Measures the surface and updates the filter. `T_cur_last`: motion since the last call,
  /// identity if it is unknown or there was none. `mask`: 0 = not the surface (e.g. from a label
  /// image), CV_8UC1 of the camera's size or empty.
  [[nodiscard]] SurfaceAppearance update(const SurfaceDepths& depths, const SE3& T_cur_last,
                                         const Image& mask, Random& random);

  Plane plane_cam() const;
  /// Pixels of a region, by the current estimate of the surface, on a regular grid of the image.
  std::vector<Eigen::Vector2f> pixels_of(SurfaceRegion region, const Image& mask = {}) const;

 private:
  void predict(const SE3& T_cur_last);
  void widen(double sigma_rad, double sigma_log_distance);
  InverseDepthPlane measure(SurfaceRegion region, const SurfaceDepths& depths, const Image& mask,
                            Random& random, SurfaceAppearance& appearance) const;

  DominantSurfaceOptions options_;
  Camera camera_;
  Eigen::Vector3d g_cam_;  // n / d
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  SurfaceRegion last_region_ = SurfaceRegion::kAhead;
};

}  // namespace placegraph
