#include <placegraph/backend/solver/free_directions.h>
#include <placegraph/backend/solver/normal_equations.h>
#include <placegraph/backend/solver/packed_free_directions.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/pose_graph/landmark_graph.h>

#include <Eigen/Dense>
#include <algorithm>

namespace placegraph {
namespace {

/// Share of the diagonal that is regarded as zero curvature, and that is added for the
/// factorization.
constexpr double kNothing = 1e-10;

/// The null space of H in units of the diagonal, one column a direction; at most
/// FreeDirections::kMost of them.
class NullSpace {
 public:
  explicit NullSpace(BlockCholesky& H) : H_(H) {
    const Eigen::VectorXd diagonal = H.diagonal();
    constexpr double kLeast = 1e-6;  // share of the largest; a zero diagonal is a free direction
    const Eigen::VectorXd unit = diagonal.cwiseMax(kLeast * diagonal.maxCoeff());
    root_ = unit.cwiseSqrt();
    factorized_ = H_.factorize(kNothing * unit);
  }

  Eigen::MatrixXd directions() const {
    if (!factorized_) return Eigen::MatrixXd(root_.size(), 0);
    const Eigen::Index unknowns = root_.size();
    constexpr Eigen::Index kFirst = 8;
    for (Eigen::Index size = std::min(kFirst, unknowns);;
         size = std::min(2 * size, std::min<Eigen::Index>(unknowns, FreeDirections::kMost))) {
      const Eigen::MatrixXd found = flat_part(random_block(size));
      if (found.cols() < size || size == unknowns || size == FreeDirections::kMost) return found;
    }
  }

 private:
  Eigen::MatrixXd random_block(Eigen::Index size) const {
    Random random(0, 0);
    Eigen::MatrixXd block(root_.size(), size);
    for (Eigen::Index j = 0; j < size; ++j)
      for (Eigen::Index i = 0; i < root_.size(); ++i) block(i, j) = random.uniform(-1, 1);
    return block;
  }

  /// The free part of the subspace, after iterations of (H + shift)^-1 on it. In scaled coordinates
  /// y = sqrt(diag) x.
  Eigen::MatrixXd flat_part(Eigen::MatrixXd y) const {
    // Inverse iterations. Chosen.
    constexpr int kIterations = 4;
    for (int k = 0; k < kIterations; ++k) {
      y = root_.asDiagonal() * y;
      H_.solve(y);
      y = root_.asDiagonal() * y;
      y = Eigen::HouseholderQR<Eigen::MatrixXd>(y).householderQ() *
          Eigen::MatrixXd::Identity(y.rows(), y.cols());
    }
    Eigen::MatrixXd image(y.rows(), y.cols());
    Eigen::VectorXd product;
    for (Eigen::Index j = 0; j < y.cols(); ++j) {
      H_.multiply(y.col(j).cwiseQuotient(root_), product);
      image.col(j) = product.cwiseQuotient(root_);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(y.transpose() * image);
    const auto free = (ritz.eigenvalues().array() < kNothing).count();  // ascending
    return y * ritz.eigenvectors().leftCols(free);
  }

  BlockCholesky& H_;
  Eigen::VectorXd root_;  ///< square root of the diagonal
  bool factorized_;
};

}  // namespace

template <class Group>
FreeDirections find_free_directions(const PackedGraph<Group>& graph, RotationError rotation_error) {
  // As in native_solver.cpp; a node moves with a thousandth of the largest motion. Chosen.
  constexpr double kSingularPivot = 1e-12, kMoves = 1e-3;
  FreeDirections free;
  NormalEquations<Group> equations(graph);
  if (equations.block_count() == 0) return free;
  equations.linearize(graph, rotation_error);
  BlockCholesky& H = equations.matrix();
  if (!(H.diagonal().maxCoeff() > 0)) return free;
  if (H.factorize() && H.smallest_pivot() >= kSingularPivot) return free;
  const Eigen::MatrixXd directions = NullSpace(H).directions();
  free.count = static_cast<int>(directions.cols());
  if (free.count == 0) return free;
  std::vector<double> motion(graph.poses.size());
  for (std::size_t i = 0; i < motion.size(); ++i)
    if (const int block = equations.block_of(static_cast<int>(i)); block >= 0)
      motion[i] = directions.middleRows<Group::kDof>(block * Group::kDof).norm();
  const double most = *std::ranges::max_element(motion);
  for (std::size_t i = 0; i < motion.size(); ++i)
    if (motion[i] > kMoves * most) free.nodes.push_back(static_cast<int>(i));
  return free;
}

FreeDirections find_free_directions(const PoseGraph& graph, RotationError rotation_error) {
  graph.check();
  switch (graph.kind()) {
    case PoseKind::kSE2:
      return find_free_directions(pack<SE2>(graph), rotation_error);
    case PoseKind::kSE3:
      return find_free_directions(pack<SE3>(graph), rotation_error);
    case PoseKind::kSim3:
      break;
  }
  return find_free_directions(pack<Sim3>(graph), rotation_error);
}

FreeDirections find_free_directions(const LandmarkGraph& graph, RotationError rotation_error) {
  graph.check();
  if (graph.poses.kind() == PoseKind::kSim3)
    return find_free_directions(graph.poses, rotation_error);
  if (graph.poses.kind() == PoseKind::kSE2)
    return find_free_directions(pack<SE2>(graph), rotation_error);
  return find_free_directions(pack<SE3>(graph), rotation_error);
}

template FreeDirections find_free_directions(const PackedGraph<SE2>&, RotationError);
template FreeDirections find_free_directions(const PackedGraph<SE3>&, RotationError);
template FreeDirections find_free_directions(const PackedGraph<Sim3>&, RotationError);

}  // namespace placegraph
