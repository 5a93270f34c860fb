#pragma once
#include <placegraph/frontend/internal/planes/homography.h>
#include <placegraph/frontend/internal/planes/planar_regions.h>
#include <placegraph/graph/geometry/se3.h>

#include <optional>

namespace placegraph {

struct MotionFromPlanesOptions {
  int max_iterations = 30;
  double ambiguity_log_ratio = 6;  ///< readings this close in likelihood to the best are kept
  void check() const;
};
void visit(OptionVisitor& field, MotionFromPlanesOptions& options);

/// One way to see two views of planes: the motion with |t| = 1, the planes in units of |t|.
struct PlanesReading {
  SE3 T_cur_ref;
  /// Of T_cur_ref, perturbed on the right, [translation, rotation]; zero along the translation,
  /// whose length is not seen.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  std::vector<Plane> planes_ref;                     ///< of each region
  std::vector<Eigen::Matrix3d> inverse_covariances;  ///< of each plane's normal over distance
  double cost = 0;                                   ///< of the matches, jointly [nats]
};

struct MotionFromPlanesResult {
  Outcome outcome;
  /// The likeliest first. More than one where the data cannot tell: always so for one plane (two,
  /// but for special motions), and for planes whose second readings agree.
  std::vector<PlanesReading> readings;
  /// R_cur_ref where the views differ by nothing but a rotation (outcome degenerate).
  std::optional<SO3> R_cur_ref;
  double rotation_cost = 0;      ///< of the matches if the camera only turned [nats]
  double homographies_cost = 0;  ///< of the matches if each plane moved as it liked [nats]
};

/// The one motion behind several planes: every region's homography is decomposed (Malis & Vargas
/// 2007); under each possible motion the other planes follow linearly from their matches; motion
/// (5) and planes (3 each, normal over distance) are refined together on the symmetric transfer
/// error, and readings with matches behind a camera are dropped. Needs a camera without distortion
/// (ArgumentError). Outcomes: too few data (no region), degenerate (pure rotation, by description
/// length: then R_cur_ref is given; or the matches leave a parameter free), inconsistent (no
/// reading has the matches in front of both cameras, or free homographies describe them in fewer
/// nats: the planes move each their own way or the camera is another; the readings are then
/// evidence only).
[[nodiscard]] MotionFromPlanesResult motion_from_planes(const Camera& camera,
                                                        const PointMatches& matches,
                                                        const PlanarRegionsResult& regions,
                                                        const MotionFromPlanesOptions& options);

}  // namespace placegraph
