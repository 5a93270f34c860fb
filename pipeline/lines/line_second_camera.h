#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/frontend/features/rectification.h>
#include <placegraph/frontend/features/stereo_matcher.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/cues/cue_options.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Observations of the segments of the left (or only) image in a second camera: the right camera of
/// a rectified pair, or a virtual one computed from depth. Nothing for segments that it does not
/// observe, and for all segments if the frame has neither a right image nor depth. Observations of
/// the right camera are corrected by `rectification`.
std::vector<std::optional<LineObservation::SecondCamera>> second_cameras(
    const Frame& frame, const std::vector<LineSegment>& segments, const Calibration& calibration,
    const RectificationError& rectification, const StereoMatcherOptions& stereo,
    const LineCueOptions& options);

/// Line in the right image, moved by `error`: each point by the error at the point in the same row
/// of the left line through `left_a` and `left_b` [px].
LineObservation::SecondCamera corrected(LineObservation::SecondCamera second, const Camera& camera,
                                        const Eigen::Vector2d& left_a,
                                        const Eigen::Vector2d& left_b,
                                        const RectificationError& error);

/// The newest disparity of a line of the window, in the middle of its carriers, with the prediction
/// from the motion of the left camera. Nothing if the newest keyframe has no second camera for the
/// line, or if the prediction is too uncertain. `rectification`: correction that has already been
/// applied to the observations.
std::optional<DisparitySample> disparity_of_line(const SlidingWindow& window, LineId line,
                                                 const Calibration& calibration,
                                                 const RectificationError& rectification,
                                                 const LineTriangulationOptions& options);

}  // namespace placegraph
