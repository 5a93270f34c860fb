#pragma once
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/frontend/lines/pose_from_lines.h>
#include <placegraph/frontend/vanishing/vanishing_points.h>
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// A line track in one view.
struct TrackedLine {
  LineSegment segment;
  ImageLine::Carriers seen;
};
using LineView = std::map<LineId, TrackedLine>;  ///< by id of the track

/// Poses and lines of an initialization.
struct LineInitialization {
  Outcome outcome;
  std::vector<SE3> T_ref_view;    ///< one per view; the first's is identity, the last's |t| 1
  std::map<LineId, Line3> lines;  ///< in the first view's frame
  int inliers = 0, candidates = 0;
};

/// Estimates motion and structure up to scale from three or more views of lines, in order of time.
///
/// Two views of lines do not constrain the motion between them, so that
/// - the rotation of each is from directions: vanishing points of the first view, each tracked
/// by the lines that point to it (min sum |v_cur - R v_ref|^2, Wahba);
/// - the translations of the middle and the last view are from five lines with one linear
/// equation each (translation_from_three_views), in RANSAC: a line of the first and last view
/// must agree with the middle one, in front of all three;
/// - the poses of the views in between are from the lines found, and lines are triangulated from
/// all views.
/// The result is accurate enough to initialize a bundle adjustment, which should verify it.
/// Outcomes: too few data (views, tracks), degenerate (one direction only, lines that did not
/// move), no consensus.
[[nodiscard]] LineInitialization initialize_from_lines(const Camera& camera,
                                                       const std::vector<LineView>& views,
                                                       const LineInitializerOptions& options,
                                                       Random& random);

}  // namespace placegraph
