#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/linear/relative_covariance.h>
#include <placegraph/backend/linear/sparse_inverse.h>
#include <placegraph/backend/pose_graph/pose_graph_doubts.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/backend/solver/free_directions.h>
#include <placegraph/backend/solver/normal_equations.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/node_index.h>

#include <algorithm>
#include <utility>

namespace placegraph {

/// The group-independent part: the factor, and adjoints for relative poses.
struct PoseMarginals::Impl {
  virtual ~Impl() = default;

  PoseGraph graph;
  std::vector<NodeId> ids;  ///< of the nodes, then of the points
  NodeIndex index;          ///< of `ids`
  int dof = 0, dim = 0;     ///< components of a pose and of a point
  Outcome outcome;

  virtual const BlockCholesky& matrix() const = 0;
  virtual int block_of(int variable) const = 0;
  virtual const GraphComponents& components() const = 0;
  /// Adjoint of (T_world_from^-1 T_world_to)^-1.
  virtual Information adjoint(int from, int to) const = 0;

  int size_of(int variable) const {
    return static_cast<std::size_t>(variable) < graph.nodes.size() ? dof : dim;
  }
  int variable(NodeId id) const {
    const std::optional<int> found = index.find(id);
    require(found.has_value(), "PoseMarginals: unknown node " + to_string(id));
    return *found;
  }
  int node(NodeId id) const {
    const int found = variable(id);
    require(static_cast<std::size_t>(found) < graph.nodes.size(),
            "PoseMarginals: " + to_string(id) + " is a point");
    return found;
  }
  void require_outcome() const {
    require(static_cast<bool>(outcome),
            "PoseMarginals: the covariances are not available: " + outcome.reason);
  }
  Information relative(int from, int to, const Information& S_from, const Information& S_to,
                       const Information& S_from_to) const {
    return placegraph::relative_covariance(adjoint(from, to), S_from, S_to, S_from_to);
  }
  /// Covariances of a range of variables from the sparse inverse subset.
  std::vector<Information> covariances(std::size_t begin, std::size_t end) const {
    require_outcome();
    const BlockFactor inverse = sparse_inverse(matrix().factor(), dof);
    const std::vector<int>& position = matrix().ordering().position;
    std::vector<Information> result;
    for (std::size_t k = begin; k < end; ++k) {
      const int i = block_of(static_cast<int>(k)), size = size_of(static_cast<int>(k));
      result.emplace_back(Information::Zero(size, size));
      if (i >= 0)
        result.back() =
            inverse_block(inverse, dof, position[i], position[i]).topLeftCorner(size, size);
    }
    return result;
  }
};

namespace {

template <class Base, class Group>
struct Implementation final : Base {
  PackedGraph<Group> packed;
  NormalEquations<Group> equations;

  Implementation(const PoseGraph& of, PackedGraph<Group> of_packed, RotationError rotation_error)
      : packed(std::move(of_packed)), equations(packed) {
    this->graph = of;
    for (const PoseNode& node : of.nodes) this->ids.push_back(node.id);
    this->dof = Group::kDof;
    this->dim = Group::kDof == 3 ? 2 : 3;
    equations.linearize(packed, rotation_error);
    BlockCholesky& H = equations.matrix();
    if (H.factorize() && H.smallest_pivot() > 1e-12) this->outcome = Outcome::ok();
  }
  const BlockCholesky& matrix() const override { return equations.matrix(); }
  int block_of(int variable) const override { return equations.block_of(variable); }
  const GraphComponents& components() const override { return packed.components; }
  Information adjoint(int from, int to) const override {
    return (packed.poses[to].inverse() * packed.poses[from]).adjoint();
  }
};

/// Indexes the variables of the marginals, and says what is undetermined.
template <class Impl, class Graph>
void complete(const Graph& graph, RotationError rotation_error, Impl& impl) {
  impl.index = NodeIndex(impl.ids);
  if (impl.outcome) return;
  const FreeDirections free = find_free_directions(graph, rotation_error);
  std::vector<NodeId> ids;
  for (const int variable : free.nodes) ids.push_back(impl.ids[static_cast<std::size_t>(variable)]);
  impl.outcome = Outcome::failure(Outcome::Code::kDegenerate,
                                  "the constraints leave directions undetermined" +
                                      (ids.empty() ? "" : ", of " + some_ids(ids)));
}

}  // namespace

PoseMarginals::PoseMarginals(const PoseGraph& graph, RotationError rotation_error) {
  graph.check();
  const auto make = [&]<class Group>(const Group&) {
    impl_ =
        std::make_unique<Implementation<Impl, Group>>(graph, pack<Group>(graph), rotation_error);
  };
  switch (graph.kind()) {
    case PoseKind::kSE2:
      make(SE2());
      break;
    case PoseKind::kSE3:
      make(SE3());
      break;
    case PoseKind::kSim3:
      make(Sim3());
  }
  complete(graph, rotation_error, *impl_);
}

PoseMarginals::PoseMarginals(const LandmarkGraph& graph, RotationError rotation_error) {
  graph.check();
  if (graph.poses.kind() == PoseKind::kSE2)
    impl_ =
        std::make_unique<Implementation<Impl, SE2>>(graph.poses, pack<SE2>(graph), rotation_error);
  else
    impl_ =
        std::make_unique<Implementation<Impl, SE3>>(graph.poses, pack<SE3>(graph), rotation_error);
  for (const GraphPoint& point : graph.points) impl_->ids.push_back(point.id);
  complete(graph, rotation_error, *impl_);
}

PoseMarginals::~PoseMarginals() = default;
PoseMarginals::PoseMarginals(PoseMarginals&&) noexcept = default;
PoseMarginals& PoseMarginals::operator=(PoseMarginals&&) noexcept = default;

const Outcome& PoseMarginals::outcome() const { return impl_->outcome; }

Eigen::MatrixXd PoseMarginals::joint_covariance(const std::vector<NodeId>& ids) const {
  impl_->require_outcome();
  const int dof = impl_->dof;
  std::vector<int> block, size, at;  // of every id: its block, its components, its first column
  int columns_of_all = 0;
  for (const NodeId id : ids) {
    const int variable = impl_->variable(id);
    block.push_back(impl_->block_of(variable));
    size.push_back(impl_->size_of(variable));
    at.push_back(columns_of_all);
    columns_of_all += size.back();
  }
  const Eigen::Index rows = static_cast<Eigen::Index>(impl_->matrix().block_count()) * dof;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows, columns_of_all);
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (block[k] >= 0) columns.block(block[k] * dof, at[k], size[k], size[k]).setIdentity();
  // Some at once, so that a large covariance can be interrupted; chosen.
  constexpr int kAtOnce = 64;
  for (int first = 0; first < columns_of_all; first += kAtOnce)
    impl_->matrix().solve(columns.middleCols(first, std::min(kAtOnce, columns_of_all - first)));
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(columns_of_all, columns_of_all);
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (block[k] >= 0)
      covariance.middleRows(at[k], size[k]) = columns.middleRows(block[k] * dof, size[k]);
  return 0.5 * (covariance + covariance.transpose());
}

Information PoseMarginals::covariance(NodeId id) const { return joint_covariance({id}); }

std::vector<Information> PoseMarginals::covariances() const {
  return impl_->covariances(0, impl_->graph.nodes.size());
}

std::vector<Information> PoseMarginals::point_covariances() const {
  return impl_->covariances(impl_->graph.nodes.size(), impl_->ids.size());
}

Information PoseMarginals::relative_covariance(NodeId from, NodeId to) const {
  const int a = impl_->node(from), b = impl_->node(to);
  const std::vector<int>& component = impl_->components().component;
  require(component[a] == component[b], "PoseMarginals: no constraints connect nodes " +
                                            to_string(from) + " and " + to_string(to));
  const Eigen::MatrixXd joint = joint_covariance({from, to});
  const int dof = impl_->dof;
  return impl_->relative(a, b, joint.topLeftCorner(dof, dof), joint.bottomRightCorner(dof, dof),
                         joint.topRightCorner(dof, dof));
}

std::vector<Information> PoseMarginals::constraint_covariances() const {
  impl_->require_outcome();
  const int dof = impl_->dof;
  const BlockFactor inverse = sparse_inverse(impl_->matrix().factor(), dof);
  const std::vector<int>& position = impl_->matrix().ordering().position;
  const auto block = [&](int a, int b) -> Information {
    const int i = impl_->block_of(a), j = impl_->block_of(b);
    if (i < 0 || j < 0) return Information::Zero(dof, dof);
    return inverse_block(inverse, dof, position[i], position[j]);
  };
  std::vector<Information> covariances;
  for (const Constraint& constraint : impl_->graph.constraints) {
    covariances.emplace_back();
    const auto* relative = std::get_if<RelativePoseConstraint>(&constraint);
    if (!relative) continue;
    const int from = impl_->node(relative->from), to = impl_->node(relative->to);
    covariances.back() =
        impl_->relative(from, to, block(from, from), block(to, to), block(from, to));
  }
  return covariances;
}

}  // namespace placegraph
