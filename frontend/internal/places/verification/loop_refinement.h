#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line3.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/geometry/sim3.h>

#include <optional>
#include <vector>

namespace placegraph {

/// A point in both views of a loop, with its depth in either, where that is known.
struct LoopPoint {
  Eigen::Vector2d px_match, px_query;
  std::optional<Eigen::Vector3d> point_match, point_query;  ///< in the camera, in its own unit
};

/// A line of the match's that the query sees.
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

/// Gauss-Newton on the reprojection errors of points in both views, the distances of points without
/// any depth from their epipolar lines, and those of segments' ends from projected lines,
/// Huber-weighted; with the scale between the views' units or without. An error common to all
/// depths (a depth camera's, or of a short baseline) pulls the pose one way from one side and the
/// other way from the other.
LoopRefinement refine_loop(const Camera& camera, const LoopEvidence& evidence, const Sim3& start,
                           double huber_px, bool free_scale);

/// Median of log(depth the query measured / depth that the match's points have in it); nothing with
/// fewer than eight.
std::optional<double> median_log_ratio(const std::vector<LoopPoint>& points,
                                       const SE3& T_query_match);

}  // namespace placegraph
