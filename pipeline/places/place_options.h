#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/robust_kernel.h>

namespace [[gnu::visibility("default")]] placegraph {

/// How keyframes are grouped into places, and how the place graph is built.
struct PlaceOptions {
  /// Largest distance of a keyframe from its place's anchor keyframe, as a share of the median
  /// depth: the reach of the place.
  double max_distance = 0.3;
  double max_angle_deg = 20;  ///< largest rotation between a keyframe and its place's anchor
  RobustKernel loop_kernel{RobustKernel::Kind::kCauchy, 3};    ///< width in standard deviations
  RobustKernel motion_kernel{RobustKernel::Kind::kCauchy, 2};  ///< for motion of other sensors
  bool merge = true;  ///< places that a loop shows to be one become one
  /// Two places are merged only if the standard deviation of their relative position, along its
  /// worst direction, is at most this share of the younger place's reach.
  double merge_sigma = 0.1;
  void check() const;
};
void visit(OptionVisitor& field, PlaceOptions& options);

}  // namespace placegraph
