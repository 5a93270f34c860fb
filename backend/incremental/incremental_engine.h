#pragma once
#include <placegraph/backend/incremental/incremental_graph.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <memory>
#include <vector>

namespace placegraph {

/// Group-independent interface of the implementation of IncrementalOptimizer.
class IncrementalEngine {
 public:
  virtual ~IncrementalEngine() = default;
  virtual PoseKind kind() const = 0;
  /// The caller has checked all inputs.
  virtual void add_node(const PoseNode& node) = 0;
  /// `poses_hold`: constraints that connect components move neither component.
  virtual void add_constraints(const std::vector<Constraint>& constraints, bool poses_hold) = 0;
  virtual void revise(const ConstraintRevision& revision) = 0;
  virtual void set_weights(const std::vector<ConstraintWeight>& weights) = 0;
  /// Iterates until the predicted excess is less than `excess` of the cost; fills `step`.
  virtual void optimize(double excess, IncrementalStep& step) = 0;

  virtual int constraints() const = 0;
  virtual const Constraint& constraint(int number) const = 0;
  virtual int find(NodeId node_id) const = 0;  ///< position; -1: unknown
  virtual Pose pose(int node) const = 0;
  virtual PoseGraph graph() const = 0;
  virtual double cost() const = 0;
  virtual Eigen::MatrixXd covariance(const std::vector<int>& nodes) const = 0;
  virtual Information relative_covariance(int from, int to) const = 0;

  static std::unique_ptr<IncrementalEngine> make(PoseKind kind, const IncrementalOptions& options);
};

template <class Group>
class IncrementalEngineOf final : public IncrementalEngine {
 public:
  explicit IncrementalEngineOf(const IncrementalOptions& options);

  PoseKind kind() const override { return static_cast<PoseKind>(Pose(Group()).index()); }
  void add_node(const PoseNode& node) override { graph_.add_node(node); }
  void add_constraints(const std::vector<Constraint>& constraints, bool poses_hold) override {
    graph_.add_constraints(constraints, poses_hold);
  }
  void revise(const ConstraintRevision& revision) override { graph_.revise(revision); }
  void set_weights(const std::vector<ConstraintWeight>& weights) override {
    graph_.set_weights(weights);
  }
  void optimize(double excess, IncrementalStep& step) override;
  int constraints() const override { return graph_.constraints(); }
  const Constraint& constraint(int number) const override { return graph_.constraint(number); }
  int find(NodeId node_id) const override { return graph_.find(node_id); }
  Pose pose(int node) const override { return graph_.pose(node); }
  PoseGraph graph() const override { return graph_.graph(); }
  double cost() const override { return graph_.cost(); }
  Eigen::MatrixXd covariance(const std::vector<int>& nodes) const override;
  Information relative_covariance(int from, int to) const override;

 private:
  bool factorize(IncrementalStep& step);
  void relax_damping();
  bool iterate(double threshold, IncrementalStep& step);
  void solve_from_scratch(IncrementalStep& step);

  IncrementalOptions options_;
  IncrementalGraph<Group> graph_;
  typename IncrementalGraph<Group>::Tree& tree_;
  double begin_ = 1;  ///< share of the allowed excess at which iterations start
  /// Steps since the tree's damping was raised, and the number of steps after which it is lowered
  /// again.
  int steps_damped_ = 0, patience_ = 1;
  int nodes_when_ordered_ = 0;
};

}  // namespace placegraph
