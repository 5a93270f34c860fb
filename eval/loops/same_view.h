#pragma once
#include <placegraph/graph/core/options.h>

#include <Eigen/Geometry>

namespace [[gnu::visibility("default")]] placegraph {

/// When two poses see the same place: near each other and looking in the same direction.
struct SameView {
  double radius_m = 5;      ///< between the two positions, at most
  double heading_deg = 30;  ///< angle of the rotation between the two poses, at most
  void check() const;       ///< throws ArgumentError naming the field
  /// Whether two poses (of cameras or bodies, metric) see the same place.
  bool holds(const Eigen::Isometry3d& T_world_a, const Eigen::Isometry3d& T_world_b) const;
};
void visit(OptionVisitor& field, SameView& options);

}  // namespace placegraph
