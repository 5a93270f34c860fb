#pragma once
#include <placegraph/backend/window/window_measurements.h>
#include <placegraph/frontend/lines/vanishing_direction_tracker.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/lines/line_observations.h>

#include <cstdint>
#include <vector>

namespace placegraph {

class SlidingWindow;

/// Constraints on the motion between earlier keyframes and the newest one from lines along the
/// direction of travel. Such lines are never triangulated, but if the camera moves away from their
/// direction, their planes rotate; a plane that has not rotated excludes positions of the newest
/// keyframe. `clusters`: directions shared by several lines, in the window's frame, with the tracks
/// along them. `depth` [m]: depth of the scene. `max_rotation_rad`: a line whose plane rotates by
/// more can be triangulated.
std::vector<MotionObservation> translation_along_lines(
    const SlidingWindow& window, const Camera& camera,
    const std::vector<VanishingDirectionTracker::DirectionCluster>& clusters,
    const LineObservations& observations, KeyframeId keyframe, double depth,
    double max_rotation_rad);

}  // namespace placegraph
