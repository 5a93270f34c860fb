#pragma once
#include <placegraph/frontend/internal/flow/point_tracker.h>
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/internal/core/random.h>

#include <vector>

namespace placegraph {

/// Fails if the observations of a pose leave its rotation open: `information` is that of its right
/// tangent, and its standard deviation must be below half a degree.
///
/// Few points in a small part of the image agree with a rotation that is wrong by several degrees,
/// and new points would get their depths by it.
[[nodiscard]] Outcome determines_rotation(const Matrix6d& information);

/// Whether the images contradict the rotation of the camera since the previous image.
///
/// The rotation is compared with that of the motion that the tracks show without the map. It is
/// contradicted if it differs by more than the covariance of that motion explains, and if the
/// motion explains more tracks than `T_previous_this`. Of several motions that explain the tracks
/// of a plane, the nearest counts. Most tracks near the epipolar lines of `T_previous_this` support
/// it; the motion is then not estimated.
[[nodiscard]] bool contradicts_rotation(const Camera& camera, const std::vector<PointTrack>& tracks,
                                        const SE3& T_previous_this, const Pose2d2dOptions& options,
                                        Random& random);

}  // namespace placegraph
