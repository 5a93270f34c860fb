#pragma once
#include <placegraph/backend/factors/factor.h>

namespace placegraph {

/// A point of the world as a node sees it: r = W (T_world_node^-1 * p_world - p_node), W^T W =
/// information; with q = T_world_node^-1 * p_world and T exp(xi), xi = [translation, rotation],
///   d q / d xi = [-I, hat(q)],  d q / d p_world = R_world_node^T
/// In the plane the third component of the point is left out, and d q / d angle = [q_y, -q_x].
template <class Group>
class PointInNodeFactor;

template <>
class PointInNodeFactor<SE3> final : public SizedFactor<3, SE3, Eigen::Vector3d> {
 public:
  PointInNodeFactor(const Eigen::Vector3d& p_node, const Eigen::Matrix3d& whitening)
      : p_node_(p_node), W_(whitening) {}

  bool compute(const SE3& T_world_node, const Eigen::Vector3d& p_world, Residual& r,
               Jacobians* J) const override {
    const Eigen::Vector3d q = T_world_node.inverse() * p_world;
    r.noalias() = W_ * (q - p_node_);
    if (!J) return true;
    std::get<0>(*J) << -W_, W_ * hat(q);
    std::get<1>(*J).noalias() = W_ * T_world_node.rotation().matrix().transpose();
    return true;
  }

 private:
  Eigen::Vector3d p_node_;
  Eigen::Matrix3d W_;
};

template <>
class PointInNodeFactor<SE2> final : public SizedFactor<2, SE2, Eigen::Vector3d> {
 public:
  PointInNodeFactor(const Eigen::Vector2d& p_node, const Eigen::Matrix2d& whitening)
      : p_node_(p_node), W_(whitening) {}

  bool compute(const SE2& T_world_node, const Eigen::Vector3d& p_world, Residual& r,
               Jacobians* J) const override {
    const Eigen::Matrix2d R = T_world_node.rotation().matrix();
    const Eigen::Vector2d q = R.transpose() * (p_world.head<2>() - T_world_node.translation());
    r.noalias() = W_ * (q - p_node_);
    if (!J) return true;
    std::get<0>(*J) << -W_, W_ * Eigen::Vector2d(q.y(), -q.x());
    std::get<1>(*J) << W_ * R.transpose(), Eigen::Vector2d::Zero();
    return true;
  }

 private:
  Eigen::Vector2d p_node_;
  Eigen::Matrix2d W_;
};

}  // namespace placegraph
