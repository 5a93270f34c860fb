#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Size and optimization of the sliding window of keyframes behind visual odometry.
struct SlidingWindowOptions {
  int max_keyframes = 8;            ///< beyond this the oldest keyframe is marginalized
  int max_iterations = 10;          ///< steps of Levenberg-Marquardt of one optimization, at most
  double huber_px = 2.0;            ///< width of Huber's kernel, in standard deviations of a pixel
  double relative_decrease = 1e-4;  ///< stop when the cost falls by less than this share
  /// Standard deviation of the logarithm of the scale that the prior loses with each keyframe that
  /// leaves, in [0, 1]: the scale of a monocular camera drifts by more than the noise of its points
  /// explains.
  double scale_drift = 0;
  /// Whether the pose of the window as a whole is marginalized as it moves on, so that its oldest
  /// keyframe stays where it is: for drives in which the window no longer corrects the past.
  /// Otherwise the prior ties the window to the map's frame, and a small late correction of the
  /// heading moves all of it, the more the longer the path behind it.
  bool hold_oldest = false;
  void check() const;
};
/// All but what follows from the sensor: scale_drift and hold_oldest are set by the window's owner.
void visit(OptionVisitor& field, SlidingWindowOptions& options);

}  // namespace placegraph
