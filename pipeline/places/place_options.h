#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/robust_kernel.h>

namespace [[gnu::visibility("default")]] placegraph {

struct PlaceOptions {
  double max_distance =
      0.3;  ///< of a keyframe from its place's anchor, as a share of the median depth
  double max_angle_deg = 20;  ///< between a keyframe and its place's anchor
  RobustKernel loop_kernel{RobustKernel::Kind::kCauchy, 3};
  RobustKernel motion_kernel{RobustKernel::Kind::kCauchy, 2};  ///< of other sensors' motion
  bool merge = true;         ///< places that a loop shows to be one become one
  double merge_sigma = 0.1;  ///< how well they must be known to each other, share of the reach
  void check() const;
};
void visit(OptionVisitor& field, PlaceOptions& options);

}  // namespace placegraph
