#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line3.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/geometry/sim3.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Point in both views of a loop, with its depth in either view if it is known.
struct LoopPoint {
  Eigen::Vector2d px_match, px_query;
  /// Position in the camera frame, in the scale of its view.
  std::optional<Eigen::Vector3d> point_match, point_query;
};

/// Line of the match that is also in the query.
struct LoopLine {
  Line3 line_match;
  LineSegment seen_by_query;
};

struct LoopEvidence {
  std::vector<LoopPoint> points;
  std::vector<LoopLine> lines;
};

struct LoopRefinement {
  Sim3 S_match_query;
  Matrix7d normal = Matrix7d::Zero();  ///< J^T W J [1/px^2], right tangent of S_match_query
  double rmse_px = 0;
};

/// Refines the pose of a loop by Gauss-Newton on Huber-weighted image errors.
///
/// The errors are reprojection errors of points in both views, distances of points without any
/// depth from their epipolar lines, and distances of segments' ends from projected lines. The scale
/// between the views is estimated or not. Points of both views are used because an error common to
/// all depths (of a depth camera, or of a short baseline) biases the pose in opposite directions
/// from the two sides.
LoopRefinement refine_loop(const Camera& camera, const LoopEvidence& evidence, const Sim3& start,
                           double huber_px, bool free_scale);

/// Median of log(depth measured in the query / depth predicted there from the match's points).
///
/// No result with fewer than eight depths.
std::optional<double> median_log_ratio(const std::vector<LoopPoint>& points,
                                       const SE3& T_query_match);

}  // namespace placegraph
