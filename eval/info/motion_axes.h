#pragma once
#include <placegraph/eval/info/motion_steps.h>

namespace placegraph {

/// The plane of the motion; see trajectory_info().
MotionPlane motion_plane(const PosedFrames& frames);

/// The axis of the body that looks along the motion; see trajectory_info().
ForwardAxis forward_axis(const PosedFrames& frames);

/// The mean of the unit directions of motion in the body's axes.
/// `turned` gives the orientation that is assumed for one that was read. Empty if the body moves in
/// too few steps.
std::optional<Eigen::Vector3d> mean_direction_body(
    const PosedFrames& frames, Eigen::Quaterniond (*turned)(const Eigen::Quaterniond&));

}  // namespace placegraph
