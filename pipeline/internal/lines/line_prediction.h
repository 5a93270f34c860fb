#pragma once
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/frontend/internal/lines/line_tracker.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/internal/cues/nearest_depth.h>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace placegraph {

/// Where a camera that has moved sees a segment whose ends lie at `depths` [m] along its axis. What
/// comes nearer than a twentieth of `typical_depth` [m] is cut off; a segment of which nothing is
/// left has no length.
LineSegment moved_segment(const Camera& camera, const LineSegment& seen,
                          const std::array<double, 2>& depths, const SE3& T_new_old,
                          double typical_depth);

/// Depths of both ends and of the middle of each track that is a line of the window, in the image
/// taken at `T_odom_cam`.
std::vector<KnownDepth> known_depths(const Camera& camera, const std::vector<LineTrack>& tracks,
                                     const SlidingWindow& window, const SE3& T_odom_cam);

/// Where tracks of the image taken at `T_odom_last` are expected in one taken at `T_odom_cam`.
struct LinePrediction {
  SE3 T_odom_last, T_odom_cam;
  double depth = 1;  ///< [m] of tracks that no line of the window is near
};

/// A segment for each track: the points at its ends, on its line of the window or as deep as the
/// lines beside it, are moved. Tracks that are no line of the window drift on as they did:
/// `drift_px` holds, by track, how far it moved across its direction beyond what was expected the
/// last time.
std::vector<LineSegment> predict_segments(const Camera& camera,
                                          const std::vector<LineTrack>& tracks,
                                          const SlidingWindow& window,
                                          const LinePrediction& prediction,
                                          const std::map<LineId, double>& drift_px);

}  // namespace placegraph
