#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/frontend/lines/line_tracker.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/cues/nearest_depth.h>

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace placegraph {

/// Projection of a segment, whose ends are at `depths` [m] along the optical axis, into a camera
/// that has moved. The part nearer than a twentieth of `typical_depth` [m] is cut off; a segment of
/// which no part remains has length zero.
LineSegment moved_segment(const Camera& camera, const LineSegment& seen,
                          const std::array<double, 2>& depths, const SE3& T_new_old,
                          double typical_depth);

/// Depths of both ends and of the middle of each track that is a line of the window, in the image
/// taken at `T_odom_cam`.
std::vector<KnownDepth> known_depths(const Camera& camera, const std::vector<LineTrack>& tracks,
                                     const SlidingWindow& window, const SE3& T_odom_cam);

/// Parameters of the prediction of tracks from the image at `T_odom_last` to one at `T_odom_cam`.
struct LinePrediction {
  SE3 T_odom_last, T_odom_cam;
  double depth = 1;  ///< depth of tracks without a nearby line of the window [m]
};

/// Predicts a segment for each track: the points at its ends are moved, on its line of the window
/// or at the depth of neighbouring lines. Tracks that are no line of the window continue their
/// drift: `drift_px` contains, by track, the last displacement across its direction beyond the
/// prediction.
std::vector<LineSegment> predict_segments(const Camera& camera,
                                          const std::vector<LineTrack>& tracks,
                                          const SlidingWindow& window,
                                          const LinePrediction& prediction,
                                          const std::map<LineId, double>& drift_px);

}  // namespace placegraph
