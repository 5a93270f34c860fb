#pragma once
#include <placegraph/frontend/planes/homography.h>
#include <placegraph/frontend/planes/planar_regions.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/graph/geometry/se3.h>

#include <optional>

namespace [[gnu::visibility("default")]] placegraph {

/// One solution (reading) for two views of planes.
///
/// The motion has |t| = 1, and the planes the scale of |t|.
struct PlanesReading {
  SE3 T_cur_ref;
  /// Covariance of T_cur_ref, perturbed on the right, [translation, rotation]; zero along the
  /// translation, whose length is unobservable.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  std::vector<Plane> planes_ref;  ///< planes of the regions
  /// Inverse covariance of each plane's normal over distance.
  std::vector<Eigen::Matrix3d> inverse_covariances;
  double cost = 0;  ///< joint cost of the matches [nats]
};

/// Motion between two views of planes, see motion_from_planes.
struct MotionFromPlanesResult {
  Outcome outcome;
  /// Solutions, the likeliest first. More than one if the data are ambiguous: always for one plane
  /// (two, except for special motions), and for planes whose second readings agree.
  std::vector<PlanesReading> readings;
  /// R_cur_ref if the views differ by a rotation alone (outcome degenerate).
  std::optional<SO3> R_cur_ref;
  double rotation_cost = 0;  ///< cost of the matches under a pure rotation [nats]
  /// Cost of the matches with an independent homography for each plane [nats].
  double homographies_cost = 0;
};

/// Estimates the one motion that explains several planes.
///
/// Every region's homography is decomposed (Malis & Vargas 2007); under each possible motion the
/// other planes follow linearly from their matches; motion (5) and planes (3 each, normal over
/// distance) are refined together on the symmetric transfer error, and readings with matches behind
/// a camera are dropped. Needs a camera without distortion (ArgumentError). Outcomes: too few data
/// (no region), degenerate (pure rotation, by description length, with R_cur_ref set; or the
/// matches do not determine a parameter), inconsistent (no reading has the matches in front of both
/// cameras, or independent homographies describe them in fewer nats: the planes move independently
/// or the camera model is wrong; the readings are then not reliable).
[[nodiscard]] MotionFromPlanesResult motion_from_planes(const Camera& camera,
                                                        const PointMatches& matches,
                                                        const PlanarRegionsResult& regions,
                                                        const MotionFromPlanesOptions& options);

}  // namespace placegraph
