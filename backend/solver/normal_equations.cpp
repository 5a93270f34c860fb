#include <placegraph/backend/factors/point_in_node.h>
#include <placegraph/backend/factors/position_error.h>
#include <placegraph/backend/solver/normal_equations.h>

#include <algorithm>

namespace placegraph {
namespace {

template <int kDof>
using SlotMap = Eigen::Map<Eigen::Matrix<double, kDof, kDof>, 0, Eigen::OuterStride<>>;

template <class Derived>
void add(const BlockCholesky::Slot& slot, const Eigen::MatrixBase<Derived>& block) {
  SlotMap<Derived::RowsAtCompileTime> target(slot.first, Eigen::OuterStride<>(slot.stride));
  target += block;
}

}  // namespace

template <class Group>
std::vector<int> NormalEquations<Group>::number_blocks(const PackedGraph<Group>& graph) {
  std::vector<int> blocks(graph.poses.size(), -1);
  int count = 0;
  for (std::size_t node = 0; node < blocks.size(); ++node)
    if (!graph.components.held[node]) blocks[node] = count++;
  return blocks;
}

template <class Group>
std::vector<std::pair<int, int>> NormalEquations<Group>::pairs(
    const PackedGraph<Group>& graph) const {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(graph.edges.size());
  for (const auto& edge : graph.edges) {
    const int from = block_of(edge.from), to = block_of(edge.to);
    if (edge.weight != 0 && from >= 0 && to >= 0) pairs.emplace_back(from, to);
  }
  for (const auto& observation : graph.observations) {
    const int node = block_of(observation.node), point = block_of(observation.point);
    if (node >= 0 && point >= 0) pairs.emplace_back(node, point);
  }
  return pairs;
}

template <class Group>
NormalEquations<Group>::NormalEquations(const PackedGraph<Group>& graph)
    : block_of_node_(number_blocks(graph)),
      matrix_(static_cast<int>(std::ranges::count(graph.components.held, 0)), kDof, pairs(graph)),
      gradient_(static_cast<Eigen::Index>(matrix_.block_count()) * kDof) {
  in_pattern_.reserve(graph.edges.size());
  coupling_.reserve(graph.edges.size());
  for (int block = 0; block < block_count(); ++block)
    diagonal_.push_back(matrix_.slot(block, block));
  for (const auto& edge : graph.edges) {
    const int from = block_of(edge.from), to = block_of(edge.to);
    in_pattern_.push_back(edge.weight != 0);
    coupling_.push_back(edge.weight != 0 && from >= 0 && to >= 0 ? matrix_.slot(from, to) : Slot{});
  }
  for (const auto& observation : graph.observations) {
    const int node = block_of(observation.node), point = block_of(observation.point);
    observation_coupling_.push_back(node >= 0 && point >= 0 ? matrix_.slot(node, point) : Slot{});
  }
}

template <class Group>
bool NormalEquations<Group>::fits(const PackedGraph<Group>& graph) const {
  if (graph.poses.size() != block_of_node_.size() || graph.edges.size() != in_pattern_.size() ||
      graph.observations.size() != observation_coupling_.size())
    return false;
  for (std::size_t node = 0; node < graph.components.held.size(); ++node)
    if ((graph.components.held[node] != 0) != (block_of_node_[node] < 0)) return false;
  // After edges are dropped the pattern is still valid, but too large; if many are dropped, a new
  // order is faster.
  std::size_t kept = 0, dropped = 0;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (graph.edges[i].weight != 0 && !in_pattern_[i]) return false;
    if (in_pattern_[i]) ++(graph.edges[i].weight != 0 ? kept : dropped);
  }
  return dropped * 50 <= kept;
}

template <class Group>
double NormalEquations<Group>::linearize(const PackedGraph<Group>& graph,
                                         RotationError rotation_error) {
  using Matrix = typename Group::Jacobian;
  using Vector = typename Group::Tangent;
  matrix_.set_zero();
  gradient_.setZero();
  double cost = 0;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto& edge = graph.edges[i];
    if (edge.weight == 0) continue;
    const Group T_from_to = graph.poses[edge.from].inverse() * graph.poses[edge.to];
    Matrix J_to;
    const Vector e = pose_error(edge.T_to_from * T_from_to, rotation_error, &J_to);
    const Vector weighted_e = edge.information * e;
    const RobustKernel::Value rho = edge.kernel.evaluate(e.dot(weighted_e));
    cost += edge.weight * rho.rho;
    const double weight = edge.weight * rho.first;
    // J_from = -J_to Ad: all blocks follow from that of `to`.
    const Matrix information_J = weight * edge.information * J_to;
    const Matrix H_to_to = J_to.transpose() * information_J;
    const Vector g_to = weight * (J_to.transpose() * weighted_e);
    const int from = block_of(edge.from), to = block_of(edge.to);
    if (to >= 0) {
      add(diagonal_[to], H_to_to);
      gradient_.template segment<kDof>(to * kDof) += g_to;
    }
    if (from < 0) continue;
    const Matrix adjoint = T_from_to.inverse().adjoint();
    const Matrix H_to_from = -H_to_to * adjoint;
    add(diagonal_[from], -adjoint.transpose() * H_to_from);
    gradient_.template segment<kDof>(from * kDof) -= adjoint.transpose() * g_to;
    if (to < 0) continue;
    if (coupling_[i].transposed)
      add(coupling_[i], H_to_from);
    else
      add(coupling_[i], H_to_from.transpose());
  }
  add_positions(graph, cost);
  add_observations(graph, cost);
  return cost;
}

template <class Group>
void NormalEquations<Group>::add_positions(const PackedGraph<Group>& graph, double& cost) {
  using Matrix = typename Group::Jacobian;
  for (const auto& position : graph.positions) {
    if (position.weight == 0) continue;
    const PositionLinearization<Group> at(graph.poses[position.node], position.lever_arm,
                                          position.position_world);
    const Eigen::Vector3d weighted_e = position.information * at.e;
    const RobustKernel::Value rho = position.kernel.evaluate(at.e.dot(weighted_e));
    cost += position.weight * rho.rho;
    const int block = block_of(position.node);
    if (block < 0) continue;
    const double weight = position.weight * rho.first;
    add(diagonal_[block], Matrix(weight * at.J.transpose() * position.information * at.J));
    gradient_.template segment<kDof>(block * kDof) += weight * at.J.transpose() * weighted_e;
  }
}

template <class Group>
void NormalEquations<Group>::add_observations(const PackedGraph<Group>& graph, double& cost) {
  using Matrix = typename Group::Jacobian;
  constexpr int rotations = kDof == 3 ? 1 : kDof - 3;  // and the scale
  for (std::size_t i = 0; i < graph.observations.size(); ++i) {
    const auto& observation = graph.observations[i];
    const PointLinearization<Group> at(graph.poses[observation.node],
                                       point_of(graph.poses[observation.point]),
                                       observation.p_node);
    const Eigen::Vector3d weighted_e = observation.information * at.e;
    cost += at.e.dot(weighted_e);
    const int node = block_of(observation.node), point = block_of(observation.point);
    const auto add_own = [&](int block, const auto& J) {
      if (block < 0) return;
      add(diagonal_[block], Matrix(J.transpose() * observation.information * J));
      gradient_.template segment<kDof>(block * kDof) += J.transpose() * weighted_e;
    };
    add_own(node, at.J_node);
    add_own(point, at.J_point);
    if (point < 0) continue;
    Matrix stays = Matrix::Zero();
    stays.diagonal().template tail<rotations>().setConstant(observation.information.trace());
    add(diagonal_[point], stays);
    if (node < 0) continue;
    const Matrix H_point_node = at.J_point.transpose() * observation.information * at.J_node;
    if (observation_coupling_[i].transposed)
      add(observation_coupling_[i], H_point_node);
    else
      add(observation_coupling_[i], Matrix(H_point_node.transpose()));
  }
}

template <class Group>
void NormalEquations<Group>::move(PackedGraph<Group>& graph, const Eigen::VectorXd& dx) const {
  for (std::size_t node = 0; node < graph.poses.size(); ++node)
    if (const int block = block_of_node_[node]; block >= 0)
      graph.poses[node] = graph.poses[node].plus(dx.template segment<kDof>(block * kDof));
}

template class NormalEquations<SE2>;
template class NormalEquations<SE3>;
template class NormalEquations<Sim3>;

}  // namespace placegraph
