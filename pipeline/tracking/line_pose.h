#pragma once
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/pipeline/lines/line_cue.h>
#include <placegraph/pipeline/tracking/motion_model.h>

namespace placegraph {

/// Tracks lines into an image and estimates its pose from them, with the pose from points as a
/// measurement; `lines` then contains the best tracking result. The search for lines starts at the
/// pose from points; if there is none, at the pose of the motion model, and, while the velocity is
/// unknown, at several poses ahead. If lines provide no estimate, the pose from points is returned.
/// Outcomes: those of estimate_pose_from_lines.
[[nodiscard]] PoseFromLines pose_with_lines(LineCue& lines, const Image& image,
                                            const SlidingWindow& window, const MotionModel& motion,
                                            const Pose3d2dResult& points, double median_depth,
                                            Random& random);

}  // namespace placegraph
