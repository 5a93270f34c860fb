#include <placegraph/backend/initialization/initialization.h>
#include <placegraph/backend/initialization/isotropic_problem.h>
#include <placegraph/backend/linear/block_cholesky.h>

#include <Eigen/SVD>
#include <deque>
#include <optional>

namespace placegraph {
namespace {

/// The unknowns of the linear systems: all nodes except the anchors.
struct Unknowns {
  std::vector<int> block;  // block of every node; -1: anchor
  int count = 0;
  std::vector<std::pair<int, int>> pairs;

  template <class Edges>
  Unknowns(const std::vector<char>& anchor, const Edges& edges) {
    block.reserve(anchor.size());
    for (const char is_anchor : anchor) block.push_back(is_anchor ? -1 : count++);
    pairs.reserve(edges.size());
    for (const auto& edge : edges)
      if (block[edge.from] >= 0 && block[edge.to] >= 0)
        pairs.emplace_back(block[edge.from], block[edge.to]);
  }
};

/// Least squares of sum w |x_to - A^T x_from - b|^2 over the unknown blocks, A a rotation (or one).
template <int size>
class LeastSquares {
 public:
  using Matrix = Eigen::Matrix<double, size, size>;

  LeastSquares(const Unknowns& unknowns, const BlockOrdering& ordering, int columns)
      : unknowns_(unknowns),
        matrix_(unknowns.count, size, unknowns.pairs, ordering),
        diagonal_(Eigen::VectorXd::Zero(unknowns.count)),
        rhs_(Eigen::MatrixXd::Zero(unknowns.count * size, columns)) {}

  /// `anchored(node)`: the value (size x columns) of an anchor.
  template <class Difference, class Anchored>
  void add(int from, int to, double weight, const Matrix& A, const Eigen::MatrixBase<Difference>& b,
           Anchored&& anchored) {
    const int i = unknowns_.block[from], j = unknowns_.block[to];
    if (j >= 0) {
      diagonal_[j] += weight;
      auto rhs = rhs_.template middleRows<size>(j * size);
      rhs += weight * b;
      if (i < 0) rhs.noalias() += weight * (A.transpose() * anchored(from));
    }
    if (i >= 0) {
      diagonal_[i] += weight;
      auto rhs = rhs_.template middleRows<size>(i * size);
      rhs.noalias() -= weight * (A * b);
      if (j < 0) rhs.noalias() += weight * (A * anchored(to));
    }
    if (i < 0 || j < 0) return;
    const BlockCholesky::Slot slot = matrix_.slot(j, i);
    block(slot) -= slot.transposed ? Matrix(weight * A) : Matrix(weight * A.transpose());
  }
  /// + weight |x_node - b|^2
  template <class Value>
  void add(int node, double weight, const Eigen::MatrixBase<Value>& b) {
    const int i = unknowns_.block[node];
    if (i < 0) return;
    diagonal_[i] += weight;
    rhs_.template middleRows<size>(i * size) += weight * b;
  }

  /// The solution by blocks of the unknowns; empty if the system is singular up to rounding.
  std::optional<Eigen::MatrixXd> solve() {
    for (int i = 0; i < unknowns_.count; ++i)
      block(matrix_.slot(i, i)).diagonal().setConstant(diagonal_[i]);
    if (!matrix_.factorize()) return {};
    matrix_.solve(rhs_);
    if (!rhs_.allFinite()) return {};
    return std::move(rhs_);
  }

 private:
  static auto block(const BlockCholesky::Slot& slot) {
    return Eigen::Map<Matrix, 0, Eigen::OuterStride<>>(slot.first,
                                                       Eigen::OuterStride<>(slot.stride));
  }
  const Unknowns& unknowns_;
  BlockCholesky matrix_;
  Eigen::VectorXd diagonal_;
  Eigen::MatrixXd rhs_;
};

template <class Group>
Group with(const Group& pose, const decltype(pose.rotation())& rotation,
           const typename Group::Point& translation) {
  if constexpr (Group::kDof == 7)
    return Sim3(rotation, translation, pose.scale());
  else
    return Group(rotation, translation);
}

/// Step 2: rotations of all unknowns. In the plane the matrices M_i are multiples of rotations,
/// determined by their first rows.
template <class Group, int dim = kSpaceDim<Group>>
bool chordal_rotations(PackedGraph<Group>& graph, const IsotropicProblem<dim>& problem,
                       const Unknowns& unknowns, const BlockOrdering& ordering) {
  constexpr int columns = dim == 2 ? 1 : 3;
  LeastSquares<dim> system(unknowns, ordering, columns);
  const Eigen::Matrix<double, dim, columns> zero = Eigen::Matrix<double, dim, columns>::Zero();
  const auto anchored = [&](int node) -> Eigen::Matrix<double, dim, columns> {
    return graph.poses[node].rotation().matrix().transpose().template leftCols<columns>();
  };
  for (const auto& edge : problem.edges)
    system.add(edge.from, edge.to, edge.rotation_weight, edge.R, zero, anchored);
  const std::optional<Eigen::MatrixXd> rows = system.solve();
  if (!rows) return false;
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    if (unknowns.block[i] < 0) continue;
    const auto M_transposed = rows->template middleRows<dim>(unknowns.block[i] * dim);
    Group& pose = graph.poses[i];
    if constexpr (dim == 2) {
      pose = Group(SO2(std::atan2(-M_transposed(1, 0), M_transposed(0, 0))), pose.translation());
    } else {
      const SO3 R = nearest_rotation(Eigen::Matrix3d(M_transposed.transpose()));
      pose = with(pose, R, pose.translation());
    }
  }
  return true;
}

/// A translation part of T_world_node * lever_arm that does not depend on the node's position.
template <class Group>
typename Group::Point rotated_arm(const Group& pose, const Eigen::Vector3d& lever_arm) {
  const typename Group::Point arm = lever_arm.head<kSpaceDim<Group>>();
  return pose * arm - pose.translation();
}

template <class Group>
double position_weight(const typename PackedGraph<Group>::Position& position) {
  constexpr int dim = kSpaceDim<Group>;
  return position.weight *
         harmonic_mean<dim>(position.information.template topLeftCorner<dim, dim>());
}

/// Step 3: translations of all unknowns; measured positions are used if a held node ties their
/// component to the world.
template <class Group, int dim = kSpaceDim<Group>>
bool chordal_translations(PackedGraph<Group>& graph, const IsotropicProblem<dim>& problem,
                          const Unknowns& unknowns, const BlockOrdering& ordering) {
  const GraphComponents& components = graph.components;
  LeastSquares<1> system(unknowns, ordering, dim);
  const LeastSquares<1>::Matrix one = LeastSquares<1>::Matrix::Identity();
  const auto anchored = [&](int node) -> Eigen::Matrix<double, 1, dim> {
    return graph.poses[node].translation().transpose();
  };
  for (const auto& edge : problem.edges)
    system.add(edge.from, edge.to, edge.translation_weight, one,
               (graph.poses[edge.from].rotation() * edge.t).transpose(), anchored);
  for (const auto& position : graph.positions) {
    if (components.floating[components.component[position.node]]) continue;
    const typename Group::Point target =
        position.position_world.template head<dim>() -
        rotated_arm(graph.poses[position.node], position.lever_arm);
    system.add(position.node, position_weight<Group>(position), target.transpose());
  }
  const std::optional<Eigen::MatrixXd> translations = system.solve();
  if (!translations) return false;
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    if (unknowns.block[i] >= 0)
      graph.poses[i] = with(graph.poses[i], graph.poses[i].rotation(),
                            translations->row(unknowns.block[i]).transpose());
  return true;
}

Eigen::VectorXd solve_log_scales(const PackedGraph<Sim3>& graph, const Unknowns& unknowns,
                                 const BlockOrdering& ordering) {
  Eigen::VectorXd log_scale(graph.poses.size());
  for (Eigen::Index i = 0; i < log_scale.size(); ++i)
    log_scale[i] = std::log(graph.poses[i].scale());
  LeastSquares<1> system(unknowns, ordering, 1);
  const LeastSquares<1>::Matrix one = LeastSquares<1>::Matrix::Identity();
  const auto anchored = [&](int node) { return LeastSquares<1>::Matrix(log_scale[node]); };
  for (const auto& edge : graph.edges) {
    if (edge.weight == 0) continue;
    const double known = edge.information(6, 6), mean = edge.information.trace() / 7;
    system.add(edge.from, edge.to, edge.weight * std::max(known, 1e-6 * mean), one,
               LeastSquares<1>::Matrix(-std::log(edge.T_to_from.scale())), anchored);
  }
  if (const std::optional<Eigen::MatrixXd> solved = system.solve())
    for (Eigen::Index i = 0; i < log_scale.size(); ++i)
      if (unknowns.block[i] >= 0) log_scale[i] = (*solved)(unknowns.block[i], 0);
  return log_scale;
}

/// Weighted point pairs of one component, and the motion that aligns the first to the second
/// (Umeyama 1991); a similarity for Sim(3).
template <class Group>
class Alignment {
 public:
  static constexpr int dim = kSpaceDim<Group>;
  using Point = typename Group::Point;

  void add(const Point& from, const Point& to, double weight) {
    pairs_.push_back({from, to, weight});
  }
  Group motion() const {
    Point mean_from = Point::Zero(), mean_to = Point::Zero();
    double total = 0;
    for (const Pair& pair : pairs_) {
      mean_from += pair.weight * pair.from;
      mean_to += pair.weight * pair.to;
      total += pair.weight;
    }
    if (!(total > 0)) return Group();
    mean_from /= total;
    mean_to /= total;
    Eigen::Matrix<double, dim, dim> M = Eigen::Matrix<double, dim, dim>::Zero();
    double spread = 0;
    for (const Pair& pair : pairs_) {
      M += pair.weight * (pair.to - mean_to) * (pair.from - mean_from).transpose();
      spread += pair.weight * (pair.from - mean_from).squaredNorm();
    }
    if (pairs_.size() < 2 || !(M.norm() > 0)) return shift(mean_to - mean_from);
    const auto R = nearest_rotation(M);
    if constexpr (Group::kDof == 7) {
      const double scale = (R.matrix().transpose() * M).trace() / spread;
      if (!(scale > 0)) return shift(mean_to - mean_from);
      return Sim3(R, mean_to - scale * (R * mean_from), scale);
    } else {
      return Group(R, mean_to - R * mean_from);
    }
  }

 private:
  struct Pair {
    Point from, to;
    double weight;
  };
  static Group shift(const Point& by) { return with(Group(), Group().rotation(), by); }
  std::vector<Pair> pairs_;
};

}  // namespace

template <class Group>
void align_to_positions(PackedGraph<Group>& graph) {
  const GraphComponents& components = graph.components;
  std::vector<Alignment<Group>> alignments(components.first.size());
  for (const auto& position : graph.positions) {
    const Group& pose = graph.poses[position.node];
    alignments[components.component[position.node]].add(
        pose.translation() + rotated_arm(pose, position.lever_arm),
        position.position_world.template head<kSpaceDim<Group>>(),
        position_weight<Group>(position));
  }
  std::vector<Group> motions;
  for (int i = 0; i < components.count(); ++i)
    motions.push_back(components.floating[i] ? alignments[i].motion() : Group());
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    if (components.floating[components.component[i]])
      graph.poses[i] = motions[components.component[i]] * graph.poses[i];
}

template <class Group>
void spanning_tree_initialization(PackedGraph<Group>& graph) {
  struct Step {
    int edge, to;
  };
  std::vector<std::vector<Step>> steps(graph.poses.size());
  for (std::size_t k = 0; k < graph.edges.size(); ++k) {
    const auto& edge = graph.edges[k];
    if (edge.weight == 0) continue;
    steps[edge.from].push_back({static_cast<int>(k), edge.to});
    steps[edge.to].push_back({static_cast<int>(k), edge.from});
  }
  std::vector<char> reached = graph.components.anchor;
  std::deque<int> open;
  std::deque<Step> postponed;
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    if (reached[i]) open.push_back(static_cast<int>(i));
  const auto reach = [&](const Step& step) {
    const auto& edge = graph.edges[step.edge];
    graph.poses[step.to] = edge.to == step.to ? graph.poses[edge.from] * edge.T_to_from.inverse()
                                              : graph.poses[edge.to] * edge.T_to_from;
    reached[step.to] = true;
    open.push_back(step.to);
  };
  while (!open.empty() || !postponed.empty()) {
    if (open.empty()) {
      if (!reached[postponed.front().to]) reach(postponed.front());
      postponed.pop_front();
      continue;
    }
    for (const Step& step : steps[open.front()]) {
      if (reached[step.to]) continue;
      if (graph.edges[step.edge].odometry)
        reach(step);
      else
        postponed.push_back(step);
    }
    open.pop_front();
  }
  align_to_positions(graph);
}

template <class Group>
void chordal_initialization(PackedGraph<Group>& graph, RotationError rotation_error) {
  const Unknowns unknowns(graph.components.anchor, graph.edges);
  const BlockOrdering ordering = order_blocks(unknowns.count, Group::kDof, unknowns.pairs);
  Eigen::VectorXd log_scale;
  if constexpr (Group::kDof == 7) {
    log_scale = solve_log_scales(graph, unknowns, ordering);
    for (std::size_t i = 0; i < graph.poses.size(); ++i)
      if (unknowns.block[i] >= 0)
        graph.poses[i] = Sim3(graph.poses[i].rotation(), graph.poses[i].translation(),
                              std::exp(log_scale[static_cast<Eigen::Index>(i)]));
  }
  const auto problem = isotropic_problem(graph, rotation_error, log_scale);
  if (!chordal_rotations(graph, problem, unknowns, ordering) ||
      !chordal_translations(graph, problem, unknowns, ordering)) {
    spanning_tree_initialization(
        graph);  // the weights differ so much that the systems are singular up to rounding
    return;
  }
  align_to_positions(graph);
}

Eigen::VectorXd log_scales(const PackedGraph<Sim3>& graph) {
  const Unknowns unknowns(graph.components.anchor, graph.edges);
  return solve_log_scales(graph, unknowns,
                          order_blocks(unknowns.count, Sim3::kDof, unknowns.pairs));
}

#define PLACEGRAPH_INSTANTIATE(Group)                              \
  template void align_to_positions(PackedGraph<Group>&);           \
  template void spanning_tree_initialization(PackedGraph<Group>&); \
  template void chordal_initialization(PackedGraph<Group>&, RotationError);
PLACEGRAPH_INSTANTIATE(SE2)
PLACEGRAPH_INSTANTIATE(SE3)
PLACEGRAPH_INSTANTIATE(Sim3)
#undef PLACEGRAPH_INSTANTIATE

}  // namespace placegraph
