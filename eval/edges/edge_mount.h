#pragma once
#include <placegraph/eval/edges/edge_error.h>

namespace [[gnu::visibility("default")]] placegraph {

/// The camera in the frame of which the truth gives the poses.
struct TruthMount {
  SE3 T_truth_cam;                    ///< the identity if the truth is the camera's
  Vector6d sigma = Vector6d::Zero();  ///< standard deviations of its tangent [m, rad]
  double parameters = 0;              ///< how many of the six the edges determine
};

/// Fits the mount with which the odometry edges agree best with the truth.
///
/// A truth of another sensor (an inertial unit, markers on the camera) is transformed by a
/// calibration, whose error is common to all edges: T_true = T_truth_cam^-1 T_given T_truth_cam. A
/// priori it is known to 0.1 m and one degree. Edges with large errors count less (Huber 1981).
TruthMount fit_mount(const std::vector<RelativePoseConstraint>& edges, const TrueNodes& truth);

/// The true poses of the camera, from those of the frame that it is mounted in.
TrueNodes mounted(TrueNodes truth, const TruthMount& mount);

}  // namespace placegraph
