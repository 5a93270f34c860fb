#pragma once
#include <placegraph/graph/geometry/lie.h>

#include <Eigen/Core>

namespace placegraph {

/// The frame of a floor plan: the map's, turned as little as makes its y the building's vertical
/// (down). Beside it stands the frame of the walls: x and y along the walls, z up from the floor.
class PlanFrame {
 public:
  PlanFrame() : PlanFrame(SE3()) {}
  explicit PlanFrame(const SE3& T_walls_map);

  /// (x, z) of the plan of a point of the floor in the frame of the walls [m].
  Eigen::Vector2d plan_of(const Eigen::Vector2d& point_walls) const;
  const SE3& T_walls_map() const { return T_walls_map_; }
  const SO3& R_plan_map() const { return R_plan_map_; }
  double floor_y() const { return t_plan_walls_[1]; }
  /// From the plan's x axis to the walls' one, about y.
  double yaw_rad() const;

 private:
  SE3 T_walls_map_;
  SO3 R_plan_map_;
  Eigen::Matrix3d R_plan_walls_;
  Eigen::Vector3d t_plan_walls_;
};

}  // namespace placegraph
