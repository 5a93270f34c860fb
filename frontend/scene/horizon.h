#pragma once
#include <placegraph/frontend/vanishing/vanishing_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Options of estimate_horizon.
struct HorizonOptions {
  /// Maximum tilt of the camera; directions beyond are neither upright nor level.
  double max_tilt_deg = 20;
  double prior_deg = 3;        ///< standard deviation of the tilt without any line
  double structure_deg = 0.5;  ///< standard deviation of upright and level edges of a street
  VanishingPointOptions vanishing;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, HorizonOptions& options);

/// Direction of gravity in the image; rays at right angles to it form the horizon.
struct Horizon {
  Outcome outcome;  ///< too few data: no usable line; `down` is the camera's own y axis
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();  ///< unit vector, camera frame
  double sigma_deg = 0;  ///< standard deviation of the less certain of its two tilts
  int directions = 0;    ///< number of vanishing points that support it
};

/// Estimates the horizon by reweighted least squares, initialized with a level camera.
///
/// Upright vanishing points are parallel to `down`, level ones at right angles to it. Errors are
/// those of `find_vanishing_points`.
[[nodiscard]] Horizon estimate_horizon(const std::vector<LineSegment>& segments,
                                       const Camera& camera, const HorizonOptions& options,
                                       Random& random);

}  // namespace placegraph
