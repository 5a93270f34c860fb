#pragma once
#include <placegraph/frontend/planes/homography.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

/// Prior of the ground plane and of the motion.
///
/// The normal has standard deviation `sigma_normal_rad` (pitch and roll equally), the motion has
/// its own sigmas; the distance is only the start of the search.
struct GroundPlanePrior {
  Plane plane_ref;
  double sigma_normal_rad = 0.05;
  /// Standard deviation of the given motion's rotation, each axis.
  double sigma_rotation_rad = 0.003;
  double sigma_direction_rad = 0.03;  ///< standard deviation of its translation's direction
};

struct GroundPlaneResult {
  Outcome outcome;
  Plane plane_ref;                ///< plane, in the scale of the given translation
  double sigma_log_distance = 0;  ///< standard deviation of log(distance)
  /// Standard deviation of the normal, prior included; the worse of two directions.
  double sigma_normal_rad = 0;
  SE3 T_cur_ref;    ///< corrected motion; its length is that of the given one
  double zncc = 0;  ///< correlation of the samples after the fit
  int samples = 0;
};

/// Estimates the ground plane from two views of known motion, by direct alignment.
///
/// Over the samples of the road, I_cur(w(p; n/d)) = gain I_ref(p) + bias is solved for n/d (3),
/// corrections of the rotation (3) and of the direction of t (2), gain and bias by Gauss-Newton
/// with Tukey weights, coarse to fine; the warp is H = K (R + t (n/d)^T) K^-1 (Siddiqui 2014,
/// 2.4.2; Benhimane & Malis 2007). The initial plane is that of `prior`, after a search over
/// distances between 0.7 and 1.4 times its own; `prior` is also a Gaussian prior on pitch and roll.
/// The distance has the scale of t: the known camera height divided by it is the metric scale.
/// `mask_ref`: 0 = not the ground (from labels), CV_8UC1 of the image's size (ArgumentError
/// otherwise) or empty. Outcomes: too few data (samples in view), degenerate (no translation,
/// or the samples do not determine the distance), inconsistent (ZNCC below min_zncc).
[[nodiscard]] GroundPlaneResult align_ground_plane(const Image& image_ref, const Image& image_cur,
                                                   const Camera& camera, const SE3& T_cur_ref,
                                                   const GroundPlanePrior& prior,
                                                   const GroundPlaneOptions& options,
                                                   const Image& mask_ref = {});

/// Estimates the ground plane without an initial plane.
///
/// Exhaustive search over pitch (+- 4 deg about `level_ref`) and distance (0.02 to 50 times |t|) on
/// a coarse level by ZNCC, then align_ground_plane.
[[nodiscard]] GroundPlaneResult search_ground_plane(const Image& image_ref, const Image& image_cur,
                                                    const Camera& camera, const SE3& T_cur_ref,
                                                    const Eigen::Vector3d& level_ref,
                                                    const GroundPlaneOptions& options,
                                                    const Image& mask_ref = {});

}  // namespace placegraph
