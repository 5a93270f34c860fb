#pragma once
#include <placegraph/frontend/internal/vanishing/vanishing_points.h>
#include <placegraph/graph/core/outcome.h>

#include <vector>

namespace placegraph {

struct HorizonOptions {
  double max_tilt_deg = 20;    ///< of the camera from level; directions beyond are of neither kind
  double prior_deg = 3;        ///< how level the camera is without any line
  double structure_deg = 0.5;  ///< how upright and level the edges of a street are
  VanishingPointOptions vanishing;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, HorizonOptions& options);

/// Where down is, by which the horizon is where rays are at right angles to it.
struct Horizon {
  Outcome outcome;  ///< too few data: no line says anything, `down` is the camera's own y axis
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();  ///< unit, camera frame
  double sigma_deg = 0;                             ///< of the larger of its two tilts
  int directions = 0;                               ///< vanishing points that show it
};

/// The direction that upright vanishing points point to and level ones are at right angles to, by
/// reweighted least squares from a level camera on. Errors are those of `find_vanishing_points`.
[[nodiscard]] Horizon estimate_horizon(const std::vector<LineSegment>& segments,
                                       const Camera& camera, const HorizonOptions& options,
                                       Random& random);

}  // namespace placegraph
