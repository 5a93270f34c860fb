#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/robust_kernel.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Options for grouping keyframes into places and for building the place graph.
struct PlaceOptions {
  /// Maximum distance of a keyframe from the anchor keyframe of its place, as a share of the median
  /// depth; it defines the reach of the place.
  double max_distance = 0.3;
  double max_angle_deg = 20;  ///< maximum rotation between a keyframe and the anchor of its place
  /// Robust kernel of loops; width in standard deviations.
  RobustKernel loop_kernel{RobustKernel::Kind::kCauchy, 3};
  /// Robust kernel of motion measured by other sensors.
  RobustKernel motion_kernel{RobustKernel::Kind::kCauchy, 2};
  bool merge = true;  ///< merge places that a loop shows to be the same
  /// Two places are merged only if the standard deviation of their relative position, in its most
  /// uncertain direction, is at most this share of the younger place's reach.
  double merge_sigma = 0.1;
  void check() const;
};
void visit(OptionVisitor& field, PlaceOptions& options);

}  // namespace placegraph
