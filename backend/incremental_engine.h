#pragma once
#include <placegraph/backend/elimination_tree.h>
#include <placegraph/backend/growing_components.h>
#include <placegraph/backend/incremental_optimizer.h>
#include <placegraph/backend/incremental_terms.h>

#include <unordered_map>

namespace placegraph {

/// What IncrementalOptimizer does, whatever the group.
class IncrementalOptimizer::Engine {
 public:
  virtual ~Engine() = default;
  virtual PoseKind kind() const = 0;
  /// All that comes in has been checked by the caller.
  virtual void add_node(const PoseNode& node) = 0;
  /// `poses_hold`: constraints that join components move neither.
  virtual void add_constraints(const std::vector<Constraint>& constraints, bool poses_hold) = 0;
  virtual void revise(const ConstraintRevision& revision) = 0;
  virtual void set_weight(const ConstraintWeight& weight) = 0;
  /// Iterates until the predicted excess is less than `excess` of the cost; fills `step`.
  virtual void optimize(double excess, IncrementalStep& step) = 0;

  virtual int constraints() const = 0;
  virtual const Constraint& constraint(int number) const = 0;
  virtual int find(std::int64_t node_id) const = 0;  ///< -1: unknown
  virtual Pose pose(int node) const = 0;
  virtual PoseGraph graph() const = 0;
  virtual double cost() const = 0;
  virtual Eigen::MatrixXd covariance(const std::vector<int>& nodes) const = 0;
  virtual Information relative_covariance(int from, int to) const = 0;

  static std::unique_ptr<Engine> make(PoseKind kind, const IncrementalOptions& options);
};

template <class Group>
class IncrementalEngine final : public IncrementalOptimizer::Engine {
 public:
  explicit IncrementalEngine(const IncrementalOptions& options);

  PoseKind kind() const override { return static_cast<PoseKind>(Pose(Group()).index()); }
  void add_node(const PoseNode& node) override;
  void add_constraints(const std::vector<Constraint>& constraints, bool poses_hold) override;
  void revise(const ConstraintRevision& revision) override;
  void set_weight(const ConstraintWeight& weight) override;
  void optimize(double excess, IncrementalStep& step) override;
  int constraints() const override { return static_cast<int>(constraints_.size()); }
  const Constraint& constraint(int number) const override { return constraints_[number]; }
  int find(std::int64_t node_id) const override;
  Pose pose(int node) const override { return nodes_[node].T_world_node; }
  PoseGraph graph() const override;
  double cost() const override;
  Eigen::MatrixXd covariance(const std::vector<int>& nodes) const override;
  Information relative_covariance(int from, int to) const override;

 private:
  using Tangent = typename Group::Tangent;
  using Tree = EliminationTree<Group::kDof>;

  struct Node {
    Group T_world_node, T_before;  ///< before the present iteration
    std::vector<int> edges, positions;
    bool gradient_stale = false;
  };
  struct Edge : EdgeTerm<Group> {
    int term = -1;  ///< of the tree
    bool visited = false;
  };
  struct Position : PositionTerm<Group> {
    int term = -1;
    bool visited = false;
  };

  void attach(int constraint, double weight);
  void detach(int constraint);
  void add_edge(const RelativePoseConstraint& constraint, int number, double weight);
  void add_position(const PositionConstraint& constraint, int number, double weight);
  void join(const Edge& edge);
  void split(int from, int to);
  void apply_held();
  void evaluate(int edge);
  void linearize(int edge);
  void evaluate_position(int position);
  void evaluate_around(const std::vector<int>& nodes);
  void set_gradients();
  int relinearize(const std::vector<int>& edges, double change);
  int relinearize_all(double change);
  bool factorize(IncrementalStep& step);
  void relax_damping();
  bool iterate(double threshold, IncrementalStep& step);
  void solve_from_scratch(IncrementalStep& step);
  PackedGraph<Group> packed() const;

  IncrementalOptions options_;
  std::vector<std::int64_t> ids_;
  std::unordered_map<std::int64_t, int> index_;
  std::vector<char> fixed_;
  std::vector<Constraint> constraints_;
  std::vector<int> place_;  ///< of every constraint in edges_ or positions_; -1: of weight 0
  std::vector<Node> nodes_;
  GrowingComponents components_;
  std::vector<Edge> edges_;
  std::vector<double> edge_costs_;  ///< of every edge, close together
  std::vector<Position> positions_;
  std::vector<int> free_edges_, free_positions_;  ///< places that wait for others
  std::vector<int> visited_, gradient_stale_;     ///< edges of the iteration; nodes
  /// Steps since the tree's damping was raised, and after how many it is lowered again.
  double begin_ = 1;  ///< share of the allowed excess at which iterations begin
  int steps_damped_ = 0, patience_ = 1;
  bool poses_hold_ = false;  ///< joining components moves neither
  int nodes_when_ordered_ = 0;
  Tree tree_;
};

}  // namespace placegraph
