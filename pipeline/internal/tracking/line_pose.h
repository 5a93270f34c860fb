#pragma once
#include <placegraph/frontend/internal/relative_pose/pose_3d2d.h>
#include <placegraph/pipeline/internal/lines/line_cue.h>
#include <placegraph/pipeline/internal/tracking/motion_model.h>

namespace placegraph {

/// Follows lines into an image and poses it by them, with the pose that points gave it as a
/// measurement; `lines` is then what was followed best. Lines are sought from where the points say;
/// where those say nothing, from where the motion model says, and several ways ahead while no
/// velocity is known. If lines tell nothing, the answer is that of the points. Outcomes: those of
/// estimate_pose_from_lines.
[[nodiscard]] PoseFromLines pose_with_lines(LineCue& lines, const Image& image,
                                            const SlidingWindow& window, const MotionModel& motion,
                                            const Pose3d2dResult& points, double median_depth,
                                            Random& random);

}  // namespace placegraph
