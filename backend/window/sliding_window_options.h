#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

struct SlidingWindowOptions {
  int max_keyframes = 8;  ///< the oldest is marginalized beyond this
  int max_iterations = 10;
  double huber_px = 2.0;            ///< width of the Huber kernel on reprojection errors, in sigmas
  double relative_decrease = 1e-4;  ///< of the cost, to stop
  /// The prior forgets its unit of length by this deviation (logarithm) with each keyframe that
  /// leaves: a single eye's unit wanders by more than the noise of its points explains.
  double scale_drift = 0;
  /// Where the window lies as a whole is integrated out as it moves on, and its oldest keyframe
  /// stays where it is: for drives whose past is not corrected by the window any more. Otherwise
  /// the prior holds the window in the map's frame, and a hair of heading it learns late moves all
  /// of it, the more the longer the way behind it.
  bool hold_oldest = false;
  void check() const;
};
/// All but what follows from the sensor: scale_drift and hold_oldest are set by the window's owner.
void visit(OptionVisitor& field, SlidingWindowOptions& options);

}  // namespace placegraph
