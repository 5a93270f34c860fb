#include <placegraph/pipeline/scene/plan_frame.h>

#include <Eigen/Geometry>
#include <cmath>

namespace placegraph {

PlanFrame::PlanFrame(const SE3& T_walls_map) : T_walls_map_(T_walls_map) {
  const Eigen::Vector3d down = -T_walls_map.rotation().matrix().row(2).transpose();
  const Eigen::Quaterniond q_plan_map =
      Eigen::Quaterniond::FromTwoVectors(down, Eigen::Vector3d::UnitY());
  R_plan_map_ = SO3(q_plan_map);
  R_plan_walls_ = q_plan_map.toRotationMatrix() * T_walls_map.rotation().matrix().transpose();
  t_plan_walls_ = q_plan_map * T_walls_map.inverse().translation();
}

Eigen::Vector2d PlanFrame::plan_of(const Eigen::Vector2d& p) const {
  const Eigen::Vector3d q = R_plan_walls_ * Eigen::Vector3d(p[0], p[1], 0) + t_plan_walls_;
  return {q[0], q[2]};
}

double PlanFrame::yaw_rad() const { return std::atan2(R_plan_walls_(2, 0), R_plan_walls_(0, 0)); }

}  // namespace placegraph
