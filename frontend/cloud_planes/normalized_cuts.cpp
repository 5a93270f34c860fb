#include <Spectra/SymEigsSolver.h>
#include <placegraph/frontend/cloud_planes/normalized_cuts.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {
namespace {

/// x -> D^-1/2 W D^-1/2 x without the part along the known largest eigenvector D^1/2 1, so that the
/// largest remaining eigenvalue is one minus the second smallest of the problem.
class Deflated {
 public:
  using Scalar = double;
  Deflated(const Eigen::SparseMatrix<double>& matrix, const Eigen::VectorXd& known)
      : matrix_(matrix), known_(known) {}
  Eigen::Index rows() const { return matrix_.rows(); }
  Eigen::Index cols() const { return matrix_.cols(); }
  void perform_op(const double* in, double* out) const {
    const Eigen::Map<const Eigen::VectorXd> x(in, rows());
    Eigen::Map<Eigen::VectorXd> y(out, rows());
    const double along = known_.dot(x);
    // Shifted by one: all other eigenvalues are then in [0, 2], that of the known one is zero.
    y = matrix_ * x + x - 2 * along * known_;
  }

 private:
  const Eigen::SparseMatrix<double>& matrix_;
  const Eigen::VectorXd& known_;
};

std::optional<Eigen::VectorXd> second_vector(const Eigen::SparseMatrix<double>& matrix,
                                             const Eigen::VectorXd& known) {
  constexpr Eigen::Index kDense = 40;
  // Size of the Lanczos basis and restarts. Chosen.
  constexpr int kBasis = 16, kRestarts = 60;
  constexpr double kAccuracy = 1e-4;
  const Eigen::Index n = matrix.rows();
  if (n <= kDense) {
    Eigen::MatrixXd dense = Eigen::MatrixXd(matrix) - 2 * known * known.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(dense);
    if (eigen.info() != Eigen::Success) return std::nullopt;
    return eigen.eigenvectors().col(n - 1);
  }
  Deflated operation(matrix, known);
  Spectra::SymEigsSolver<Deflated> solver(operation, 1, kBasis);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge, kRestarts, kAccuracy);
  if (solver.info() != Spectra::CompInfo::Successful) return std::nullopt;
  return solver.eigenvectors(1).col(0);
}

}  // namespace

std::optional<NormalizedCut> normalized_cut(int nodes, const std::vector<Affinity>& affinities) {
  require(nodes >= 2, "normalized cut: fewer than two nodes");
  Eigen::VectorXd degree = Eigen::VectorXd::Zero(nodes);
  for (const Affinity& edge : affinities) {
    require(edge.a >= 0 && edge.b >= 0 && edge.a < nodes && edge.b < nodes && edge.a != edge.b,
            "normalized cut: an affinity of nodes that do not exist");
    degree[edge.a] += edge.weight;
    degree[edge.b] += edge.weight;
  }
  const Eigen::VectorXd root = degree.cwiseMax(1e-12).cwiseSqrt();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * affinities.size());
  for (const Affinity& edge : affinities) {
    const double value = edge.weight / (root[edge.a] * root[edge.b]);
    entries.emplace_back(edge.a, edge.b, value);
    entries.emplace_back(edge.b, edge.a, value);
  }
  Eigen::SparseMatrix<double> matrix(nodes, nodes);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd known = root.normalized();
  std::optional<Eigen::VectorXd> vector = second_vector(matrix, known);
  if (!vector) return std::nullopt;
  const Eigen::VectorXd y = vector->cwiseQuotient(root);

  // Nodes change to the other side one by one in the order of y; the cut changes by their edges.
  std::vector<int> order(static_cast<std::size_t>(nodes)), rank(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return y[a] < y[b] || (y[a] == y[b] && a < b); });
  for (int i = 0; i < nodes; ++i) rank[order[i]] = i;
  std::vector<double> change(order.size() + 1, 0);
  for (const Affinity& edge : affinities) {
    const auto [low, high] = std::minmax(rank[edge.a], rank[edge.b]);
    change[low] += edge.weight, change[high] -= edge.weight;
  }
  const double total = degree.sum();
  double cut = 0, inside = 0, best = 3;
  NormalizedCut result;
  int best_rank = 0;
  for (int i = 0; i + 1 < nodes; ++i) {
    cut += change[i], inside += degree[order[i]];
    const double value = cut / std::max(inside, 1e-12) + cut / std::max(total - inside, 1e-12);
    if (value >= best) continue;
    best = value, best_rank = i;
  }
  result.value = best;
  result.second.resize(order.size());
  for (int i = 0; i < nodes; ++i) result.second[i] = rank[i] > best_rank;
  return result;
}

}  // namespace placegraph
