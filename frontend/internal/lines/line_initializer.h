#pragma once
#include <placegraph/frontend/internal/lines/pose_from_lines.h>
#include <placegraph/frontend/internal/vanishing/vanishing_points.h>
#include <placegraph/frontend/lines/line_options.h>
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

struct LineInitialization {
  Outcome outcome;
  std::vector<SE3> T_ref_view;    ///< one per view; the first's is identity, the last's |t| 1
  std::map<LineId, Line3> lines;  ///< in the first view's frame
  int inliers = 0, candidates = 0;
};

/// Motion and structure from three views of lines or more, up to scale, the views in order of time.
/// Two views of lines put no constraint on the motion between them, so that
///  - the rotation of each comes from directions: vanishing points of the first view, each followed
///    by the tracks that point to it (min sum |v_cur - R v_ref|^2, Wahba);
///  - the translations of the middle and the last view come from five lines each of which gives one
///    linear equation (translation_from_three_views), in RANSAC: a line of the first and last view
///    must be met in the middle one, before all three;
///  - views in between are posed by the lines found, and lines are placed by all views.
/// It is good enough to begin a bundle adjustment with, which should judge it. Outcomes: too few
/// data (views, tracks), degenerate (one direction only, lines that did not move), no consensus.
[[nodiscard]] LineInitialization initialize_from_lines(const Camera& camera,
                                                       const std::vector<LineView>& views,
                                                       const LineInitializerOptions& options,
                                                       Random& random);

}  // namespace placegraph
