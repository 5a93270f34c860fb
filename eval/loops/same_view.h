#pragma once
#include <placegraph/graph/core/options.h>

#include <Eigen/Geometry>

namespace [[gnu::visibility("default")]] placegraph {

/// Criteria for two poses with the same view: nearby, with similar orientation.
struct SameView {
  double radius_m = 5;      ///< largest distance of the two positions [m]
  double heading_deg = 30;  ///< largest angle of the rotation between the two poses [deg]
  void check() const;       ///< throws ArgumentError naming the field
  /// Whether two poses (of cameras or bodies, metric) have the same view.
  bool holds(const Eigen::Isometry3d& T_world_a, const Eigen::Isometry3d& T_world_b) const;
};
void visit(OptionVisitor& field, SameView& options);

}  // namespace placegraph
