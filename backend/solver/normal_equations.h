#pragma once
#include <placegraph/backend/factors/pose_error.h>
#include <placegraph/backend/linear/block_cholesky.h>
#include <placegraph/backend/solver/packed_graph.h>

#include <optional>

namespace placegraph {

/// The normal equations H dx = -g of a packed graph, with one block for every free node:
/// f(x [+] dx) ~ f + 2 g^T dx + dx^T H dx with f = sum weight rho(e^T Omega e), H = sum w J^T Omega
/// J, g = sum w J^T Omega e, w = weight rho' (iteratively reweighted Gauss-Newton). Points have
/// blocks of the same size; their rotation (and scale) is uncoupled and fixed by a diagonal entry.
template <class Group>
class NormalEquations {
 public:
  static constexpr int kDof = Group::kDof;

  /// The pattern is that of the edges whose weight is not zero.
  explicit NormalEquations(const PackedGraph<Group>& graph);

  /// Whether the graph still has the pattern: the same nodes, held nodes and edges; edges that had
  /// no weight must still have none.
  bool fits(const PackedGraph<Group>& graph) const;

  /// Fills H and g at the graph's poses; returns the cost f.
  double linearize(const PackedGraph<Group>& graph, RotationError rotation_error);

  BlockCholesky& matrix() { return matrix_; }
  const BlockCholesky& matrix() const { return matrix_; }
  const Eigen::VectorXd& gradient() const { return gradient_; }  ///< g, by blocks
  /// The block of a node; -1 if it is held.
  int block_of(int node) const { return block_of_node_[static_cast<std::size_t>(node)]; }
  int block_count() const { return matrix_.block_count(); }

  /// Moves the graph: graph [+] dx.
  void move(PackedGraph<Group>& graph, const Eigen::VectorXd& dx) const;

 private:
  using Slot = BlockCholesky::Slot;
  static std::vector<int> number_blocks(const PackedGraph<Group>& graph);
  std::vector<std::pair<int, int>> pairs(const PackedGraph<Group>& graph) const;
  /// Both add to H, g and the cost.
  void add_positions(const PackedGraph<Group>& graph, double& cost);
  void add_observations(const PackedGraph<Group>& graph, double& cost);

  std::vector<int> block_of_node_;
  std::vector<char> in_pattern_;  // whether each edge is in the pattern
  BlockCholesky matrix_;
  std::vector<Slot> diagonal_;  // by blocks
  std::vector<Slot> coupling_;  // by edges; empty slot where there is none
  std::vector<Slot> observation_coupling_;
  Eigen::VectorXd gradient_;
};

}  // namespace placegraph
