#include <placegraph/eval/loops/same_view.h>
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/graph/core/angle.h>

#include <numbers>

namespace placegraph {

void SameView::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SameView& o) {
  field("radius_m", o.radius_m, "largest distance of two views of the same place [m]", {0, 1e6});
  field("heading_deg", o.heading_deg, "largest angle between two views of the same place [deg]",
        {0, 180});
}

bool SameView::holds(const Eigen::Isometry3d& T_world_a, const Eigen::Isometry3d& T_world_b) const {
  if ((T_world_a.translation() - T_world_b.translation()).squaredNorm() > radius_m * radius_m)
    return false;
  const Eigen::Matrix3d R_a_b = T_world_a.linear().transpose() * T_world_b.linear();
  return rotation_angle(R_a_b) <= deg_to_rad(heading_deg);
}

}  // namespace placegraph
