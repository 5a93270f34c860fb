#pragma once
#include <placegraph/backend/internal/window/window_measurements.h>
#include <placegraph/frontend/internal/lines/vanishing_direction_tracker.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/internal/lines/line_observations.h>

#include <cstdint>
#include <vector>

namespace placegraph {

class SlidingWindow;

/// Motions between earlier keyframes and the newest one that lines along the way of the camera
/// allow. Such lines are never triangulated, but a camera that leaves their direction sees their
/// planes turn: what did not turn says where the newest keyframe does not lie.
/// `families`: directions that lines share, in the window's frame, with the tracks along them.
/// `depth` [m]: of the scene. `max_rotation_rad`: a line whose plane turns by more can be
/// triangulated.
std::vector<MotionObservation> course_along_lines(
    const SlidingWindow& window, const Camera& camera,
    const std::vector<VanishingDirectionTracker::DirectionCluster>& clusters,
    const LineObservations& observations, KeyframeId keyframe, double depth,
    double max_rotation_rad);

}  // namespace placegraph
