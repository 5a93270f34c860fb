#pragma once
#include <placegraph/frontend/internal/planes/homography.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>

namespace placegraph {

/// What is known beforehand: the normal to `sigma_normal_rad` (pitch and roll alike), the motion to
/// its sigmas; the distance is only where the search starts.
struct GroundPlanePrior {
  Plane plane_ref;
  double sigma_normal_rad = 0.05;
  double sigma_rotation_rad = 0.003;  ///< of the motion that is handed over, each axis
  double sigma_direction_rad = 0.03;  ///< of its translation's direction
};

struct GroundPlaneResult {
  Outcome outcome;
  Plane plane_ref;                ///< in the unit of the translation that was handed over
  double sigma_log_distance = 0;  ///< standard deviation of log(distance)
  double sigma_normal_rad = 0;    ///< of the normal, prior included; the worse of two directions
  SE3 T_cur_ref;                  ///< the motion, corrected; its length is as it was handed over
  double zncc = 0;                ///< of the samples, after the fit
  int samples = 0;
};

/// The ground plane from two views of known motion, by direct alignment: over the samples of the
/// road, I_cur(w(p; n/d)) = gain I_ref(p) + bias is solved for n/d (3), corrections of the
/// rotation (3) and of the direction of t (2), gain and bias by Gauss-Newton with Tukey weights,
/// coarse to fine; the warp is H = K (R + t (n/d)^T) K^-1 (Siddiqui 2014, 2.4.2; Benhimane & Malis
/// 2007). `prior` gives the start, after a search over distances between 0.7 and 1.4 times its own,
/// and a Gaussian prior on pitch and roll. With t up to scale, so is the distance: the known camera
/// height over it is the metric scale. `mask_ref`: 0 = not the ground (what labels say), CV_8UC1 of
/// the image's size (ArgumentError otherwise) or empty. Outcomes: too few data (samples in view),
/// degenerate (translation along nothing the ground shows), inconsistent (ZNCC below min_zncc).
[[nodiscard]] GroundPlaneResult align_ground_plane(const Image& image_ref, const Image& image_cur,
                                                   const Camera& camera, const SE3& T_cur_ref,
                                                   const GroundPlanePrior& prior,
                                                   const GroundPlaneOptions& options,
                                                   const Image& mask_ref = {});

/// The same without a start: exhaustive search over pitch (+- 4 deg about `level_ref`) and distance
/// (0.02 to 50 times |t|) on a coarse level by ZNCC, then align_ground_plane.
[[nodiscard]] GroundPlaneResult search_ground_plane(const Image& image_ref, const Image& image_cur,
                                                    const Camera& camera, const SE3& T_cur_ref,
                                                    const Eigen::Vector3d& level_ref,
                                                    const GroundPlaneOptions& options,
                                                    const Image& mask_ref = {});

}  // namespace placegraph
