#pragma once
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/frontend/internal/features/rectification.h>
#include <placegraph/frontend/internal/features/stereo_matcher.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/cues/cue_options.h>

#include <optional>
#include <vector>

namespace placegraph {

/// What a second camera sees of each segment of the left (or only) image: the right camera of a
/// rectified pair, or one made up from depth. Nothing where it does not see the segment, and for
/// all segments where the frame has neither a right image nor depth. What the right camera sees is
/// corrected by `rectification`.
std::vector<std::optional<LineObservation::SecondCamera>> second_cameras(
    const Frame& frame, const std::vector<LineSegment>& segments, const Calibration& calibration,
    const RectificationError& rectification, const StereoMatcherOptions& stereo,
    const LineCueOptions& options);

/// The line in the right image, moved by `error`: each of its points by the error at the point of
/// the same row of the left line through `left_a` and `left_b` [px].
LineObservation::SecondCamera corrected(LineObservation::SecondCamera second, const Camera& camera,
                                        const Eigen::Vector2d& left_a,
                                        const Eigen::Vector2d& left_b,
                                        const RectificationError& error);

/// The newest disparity of a line of the window, in the middle of its carriers, beside what the
/// motion of the left camera says of it. Nothing where the newest keyframe has no second eye for
/// the line, or where motion says too little. `rectification`: by which the observations are
/// corrected already.
std::optional<DisparitySample> disparity_of_line(const SlidingWindow& window, LineId line,
                                                 const Calibration& calibration,
                                                 const RectificationError& rectification,
                                                 const LineTriangulationOptions& options);

}  // namespace placegraph
