#pragma once
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/geometry/camera.h>

#include <vector>

namespace placegraph {

struct Pose2d2dOptions;

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
