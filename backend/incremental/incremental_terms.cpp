#include <placegraph/backend/factors/position_error.h>
#include <placegraph/backend/incremental/incremental_terms.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

template <class Group>
void EdgeTerm<Group>::evaluate(const Group& T_world_from, const Group& T_world_to,
                               RotationError kind) {
  if (edge.weight == 0) {
    cost = 0;
    g_from.setZero();
    g_to.setZero();
    change = scale > 0 ? 1 : 0;
    return;
  }
  const RelativePoseLinearization<Group> at(edge.T_to_from, T_world_from, T_world_to, kind);
  const Tangent information_e = edge.information * at.e;
  const RobustKernel::Value rho = edge.kernel.evaluate(at.e.dot(information_e));
  const double weight = edge.weight * rho.first;
  cost = edge.weight * rho.rho;
  g_from.noalias() = weight * (at.J_from.transpose() * information_e);
  g_to.noalias() = weight * (at.J_to.transpose() * information_e);
  if (scale < 0) {
    change = 1;
    return;
  }
  const double rotated = std::max((at.J_from - J_from).squaredNorm() / J_from.squaredNorm(),
                                  (at.J_to - J_to).squaredNorm() / J_to.squaredNorm());
  const double scaled = std::abs(weight - scale) / std::max(weight, scale);
  change = std::max(std::sqrt(rotated), weight == scale ? 0.0 : scaled);
}

template <class Group>
typename EdgeTerm<Group>::NormalBlocks EdgeTerm<Group>::linearize(const Group& T_world_from,
                                                                  const Group& T_world_to,
                                                                  RotationError kind) {
  const RelativePoseLinearization<Group> at(edge.T_to_from, T_world_from, T_world_to, kind);
  J_from = at.J_from;
  J_to = at.J_to;
  change = 0;
  scale = edge.weight == 0
              ? 0
              : edge.weight * edge.kernel.evaluate(at.e.dot(edge.information * at.e)).first;
  const Jacobian information_from = scale * (edge.information * J_from);
  const Jacobian information_to = scale * (edge.information * J_to);
  return {J_from.transpose() * information_from, J_from.transpose() * information_to,
          J_to.transpose() * information_to};
}

template <class Group>
typename Group::Jacobian PositionTerm<Group>::evaluate(const Group& T_world_node) {
  const PositionLinearization<Group> at(T_world_node, position.lever_arm, position.position_world);
  const Eigen::Vector3d information_e = position.information * at.e;
  const RobustKernel::Value rho = position.kernel.evaluate(at.e.dot(information_e));
  const double weight = position.weight * rho.first;
  cost = position.weight * rho.rho;
  g = weight * (at.J.transpose() * information_e);
  return weight * (at.J.transpose() * position.information * at.J);
}

template struct EdgeTerm<SE2>;
template struct EdgeTerm<SE3>;
template struct EdgeTerm<Sim3>;
template struct PositionTerm<SE2>;
template struct PositionTerm<SE3>;
template struct PositionTerm<Sim3>;

}  // namespace placegraph
