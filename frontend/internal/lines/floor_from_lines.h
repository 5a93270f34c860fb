#pragma once
#include <placegraph/frontend/internal/lines/line_triangulation.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// A line of known place as the camera sees it now.
struct PlacedLine {
  LineId id;
  Line3 line_ref;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< in the line's tangent
  LineSegment seen;                                      ///< its visible part
};

/// A direction of the scene that is known from elsewhere, as from a vanishing point.
struct SharedDirection {
  Eigen::Vector3d d_ref;  ///< unit
  double sigma_rad = 0;
};

struct FloorFromLines {
  Outcome outcome;
  Eigen::Vector3d down_ref = Eigen::Vector3d::UnitY();  ///< unit normal, away from the camera
  double height = 0;                                    ///< of the camera's centre above it
  double sigma_height = 0;
  std::vector<LineId> on_floor;  ///< lines on it or ending there, ascending
};

/// The floor under a camera from lines of a scene of any unit. Uprights (lines near to the
/// camera's y axis that are parallel to each other) and level lines at right angles to them give
/// the vertical; every level line has a height, and so has the lower end of every upright. Of the
/// levels below the camera that enough of them agree on, the lowest is the floor: ceilings lie
/// above, tables and the edge of a skirting higher. Then plane and vertical are fitted together to
/// those that lie on it and to the uprights, robustly, each at its own deviation. Directions that
/// many lines share stand for those lines, which lean together by what is wrong with the way that
/// they were placed from. Outcomes: too few
/// data (nothing upright nor two level directions), no consensus (no level has `min_lines`).
[[nodiscard]] FloorFromLines floor_from_lines(const Camera& camera, const SE3& T_ref_cam,
                                              const std::vector<PlacedLine>& lines,
                                              const FloorFromLinesOptions& options,
                                              const std::vector<SharedDirection>& shared = {});

}  // namespace placegraph
