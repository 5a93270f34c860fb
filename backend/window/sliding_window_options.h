#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Options of the sliding window of keyframes in visual odometry.
struct SlidingWindowOptions {
  int max_keyframes = 8;            ///< above this number the oldest keyframe is marginalized
  int max_iterations = 10;          ///< maximum steps of Levenberg-Marquardt per optimization
  double huber_px = 2.0;            ///< width of Huber's kernel, in standard deviations of a pixel
  double relative_decrease = 1e-4;  ///< stop when the cost falls by less than this share
  /// Standard deviation of the drift of log(scale) that is added to the prior per marginalized
  /// keyframe, in [0, 1]. The scale of a monocular camera drifts by more than the noise of its
  /// points explains.
  double scale_drift = 0;
  /// Whether the pose of the whole window is marginalized as it moves on, so that its oldest
  /// keyframe keeps its pose: for drives in which the window no longer corrects the past. Otherwise
  /// the prior ties the window to the map's frame, and a small late correction of the heading moves
  /// the whole window, by more the longer the path behind it.
  bool hold_oldest = false;
  /// Whether inverse depths come from disparities, so that an error of the focal length is one of
  /// the depths.
  bool depths_from_disparities = false;
  void check() const;
};
/// Visits all options except the last three, which the owner sets for the sensor.
void visit(OptionVisitor& field, SlidingWindowOptions& options);

}  // namespace placegraph
