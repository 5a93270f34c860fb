#pragma once
#include <placegraph/graph/geometry/lie.h>

#include <Eigen/Core>

namespace placegraph {

/// The frame of a floor plan: the map frame, with the smallest rotation that makes its y axis the
/// building's vertical (down). It also provides the frame of the walls: x and y along the walls, z
/// up from the floor.
class PlanFrame {
 public:
  PlanFrame() : PlanFrame(SE3()) {}
  explicit PlanFrame(const SE3& T_walls_map);

  /// (x, z) in the plan of a point on the floor in the frame of the walls [m].
  Eigen::Vector2d plan_of(const Eigen::Vector2d& point_walls) const;
  const SE3& T_walls_map() const { return T_walls_map_; }
  const SO3& R_plan_map() const { return R_plan_map_; }
  double floor_y() const { return t_plan_walls_[1]; }
  /// Rotation about y from the plan's x axis to that of the walls.
  double yaw_rad() const;

 private:
  SE3 T_walls_map_;
  SO3 R_plan_map_;
  Eigen::Matrix3d R_plan_walls_;
  Eigen::Vector3d t_plan_walls_;
};

}  // namespace placegraph
