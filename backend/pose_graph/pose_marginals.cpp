#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/linear/relative_covariance.h>
#include <placegraph/backend/linear/sparse_inverse.h>
#include <placegraph/backend/pose_graph/pose_marginals.h>
#include <placegraph/backend/solver/normal_equations.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/node_index.h>

namespace placegraph {

/// The group-independent part: the factor, and adjoints for relative poses.
struct PoseMarginals::Impl {
  virtual ~Impl() = default;

  PoseGraph graph;
  NodeIndex index;
  int dof = 0;
  Outcome outcome;

  virtual const BlockCholesky& matrix() const = 0;
  virtual int block_of(int node) const = 0;
  virtual const GraphComponents& components() const = 0;
  /// Adjoint of (T_world_from^-1 T_world_to)^-1.
  virtual Information adjoint(int from, int to) const = 0;

  int node(NodeId id) const {
    const std::optional<int> found = index.find(id);
    require(found.has_value(), "PoseMarginals: unknown node " + to_string(id));
    return *found;
  }
  void require_outcome() const {
    require(static_cast<bool>(outcome),
            "PoseMarginals: the covariances are not available: " + outcome.reason);
  }
  Information relative(int from, int to, const Information& S_from, const Information& S_to,
                       const Information& S_from_to) const {
    return placegraph::relative_covariance(adjoint(from, to), S_from, S_to, S_from_to);
  }
};

namespace {

template <class Base, class Group>
struct Implementation final : Base {
  PackedGraph<Group> packed;
  NormalEquations<Group> equations;

  Implementation(const PoseGraph& of, RotationError rotation_error)
      : packed(pack<Group>(of)), equations(packed) {
    this->graph = of;
    this->index = of.index_by_id();
    this->dof = Group::kDof;
    equations.linearize(packed, rotation_error);
    BlockCholesky& H = equations.matrix();
    this->outcome = H.factorize() && H.smallest_pivot() > 1e-12
                        ? Outcome::ok()
                        : Outcome::failure(Outcome::Code::kDegenerate,
                                           "the constraints leave directions undetermined");
  }
  const BlockCholesky& matrix() const override { return equations.matrix(); }
  int block_of(int node) const override { return equations.block_of(node); }
  const GraphComponents& components() const override { return packed.components; }
  Information adjoint(int from, int to) const override {
    return (packed.poses[to].inverse() * packed.poses[from]).adjoint();
  }
};

}  // namespace

PoseMarginals::PoseMarginals(const PoseGraph& graph, RotationError rotation_error) {
  graph.check();
  switch (graph.kind()) {
    case PoseKind::kSE2:
      impl_ = std::make_unique<Implementation<Impl, SE2>>(graph, rotation_error);
      return;
    case PoseKind::kSE3:
      impl_ = std::make_unique<Implementation<Impl, SE3>>(graph, rotation_error);
      return;
    case PoseKind::kSim3:
      impl_ = std::make_unique<Implementation<Impl, Sim3>>(graph, rotation_error);
  }
}

PoseMarginals::~PoseMarginals() = default;
PoseMarginals::PoseMarginals(PoseMarginals&&) noexcept = default;
PoseMarginals& PoseMarginals::operator=(PoseMarginals&&) noexcept = default;

const Outcome& PoseMarginals::outcome() const { return impl_->outcome; }

Eigen::MatrixXd PoseMarginals::joint_covariance(const std::vector<NodeId>& ids) const {
  impl_->require_outcome();
  const int dof = impl_->dof, count = static_cast<int>(ids.size());
  const Eigen::Index rows = static_cast<Eigen::Index>(impl_->matrix().block_count()) * dof;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows, count * dof);
  std::vector<int> block;
  for (int k = 0; k < count; ++k) {
    block.push_back(impl_->block_of(impl_->node(ids[k])));
    if (block[k] >= 0) columns.block(block[k] * dof, k * dof, dof, dof).setIdentity();
  }
  impl_->matrix().solve(columns);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count * dof, count * dof);
  for (int k = 0; k < count; ++k)
    if (block[k] >= 0)
      covariance.middleRows(k * dof, dof) = columns.middleRows(block[k] * dof, dof);
  return 0.5 * (covariance + covariance.transpose());
}

Information PoseMarginals::covariance(NodeId id) const { return joint_covariance({id}); }

std::vector<Information> PoseMarginals::covariances() const {
  impl_->require_outcome();
  const int dof = impl_->dof;
  const BlockFactor inverse = sparse_inverse(impl_->matrix().factor(), dof);
  const std::vector<int>& position = impl_->matrix().ordering().position;
  std::vector<Information> covariances;
  for (std::size_t node = 0; node < impl_->graph.nodes.size(); ++node) {
    const int i = impl_->block_of(static_cast<int>(node));
    if (i < 0)
      covariances.emplace_back(Information::Zero(dof, dof));
    else
      covariances.emplace_back(inverse_block(inverse, dof, position[i], position[i]));
  }
  return covariances;
}

Information PoseMarginals::relative_covariance(NodeId from, NodeId to) const {
  const int a = impl_->node(from), b = impl_->node(to);
  const std::vector<int>& component = impl_->components().component;
  require(component[a] == component[b], "PoseMarginals: no constraints connect nodes " +
                                            to_string(from) + " and " + to_string(to));
  const Eigen::MatrixXd joint = joint_covariance({from, to});
  const int dof = impl_->dof;
  return impl_->relative(a, b, joint.topLeftCorner(dof, dof),
                         joint.bottomRightCorner(dof, dof), joint.topRightCorner(dof, dof));
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
