#include <placegraph/backend/initialization/lifted_preconditioner.h>

#include <Eigen/QR>

namespace placegraph {
namespace {

constexpr double kDamping = 1e-11;  ///< share of the diagonal, against rounding
constexpr double kHold = 1e6;       ///< multiple of the diagonal, at the held nodes

/// Orthonormal basis of [W; K], W d x d antisymmetric, K (r-d) x d, as columns of r d numbers.
template <int dim>
Eigen::MatrixXd tangent_basis(int rank) {
  const int angles = dim * rank - dim * (dim + 1) / 2;
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(rank * dim, angles);
  int k = 0;
  for (int a = 0; a < dim; ++a)
    for (int b = a + 1; b < dim; ++b, ++k) {
      basis(b * rank + a, k) = -M_SQRT1_2;
      basis(a * rank + b, k) = M_SQRT1_2;
    }
  for (int row = dim; row < rank; ++row)
    for (int column = 0; column < dim; ++column, ++k) basis(column * rank + row, k) = 1;
  return basis;
}

/// [Y Z] with Z an orthonormal basis of the complement of Y's columns.
template <int dim>
Eigen::MatrixXd frame(const Eigen::MatrixXd& Y) {
  const Eigen::Index rank = Y.rows();
  Eigen::MatrixXd frame(rank, rank);
  if (rank > dim) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(Y);
    frame.setIdentity();
    frame.applyOnTheLeft(qr.householderQ());
  }
  frame.leftCols<dim>() = Y;
  return frame;
}

}  // namespace

template <int dim>
std::vector<std::pair<int, int>> LiftedPreconditioner<dim>::pairs(
    const IsotropicProblem<dim>& problem) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(problem.edges.size());
  for (const auto& edge : problem.edges) pairs.emplace_back(edge.from, edge.to);
  return pairs;
}

template <int dim>
LiftedPreconditioner<dim>::LiftedPreconditioner(const IsotropicProblem<dim>& problem,
                                                const BlockOrdering& ordering, int rank)
    : problem_(problem),
      rank_(rank),
      angles_(dim * rank - dim * (dim + 1) / 2),
      basis_(tangent_basis<dim>(rank)),
      matrix_(problem.nodes, angles_ + rank, pairs(problem), ordering) {}

template <int dim>
void LiftedPreconditioner<dim>::assemble() {
  matrix_.set_zero();
  const int size = angles_ + rank_;
  // Tangent vectors rotated by the edge's measurement, and applied to its translation.
  Eigen::MatrixXd rotated(rank_ * dim, angles_), seen(rank_ * dim, angles_),
      shifted(rank_, angles_);
  Eigen::MatrixXd from(size, size), to(size, size), cross(size, size);
  const auto add = [&](int i, int j, const Eigen::MatrixXd& block) {
    const BlockCholesky::Slot slot = matrix_.slot(i, j);
    Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> kept(slot.first, size, size,
                                                              Eigen::OuterStride<>(slot.stride));
    if (slot.transposed)
      kept += block.transpose();
    else
      kept += block;
  };
  for (const auto& edge : problem_.edges) {
    const double kappa = edge.rotation_weight, tau = edge.translation_weight;
    const Eigen::MatrixXd G = frames_[edge.from].transpose() * frames_[edge.to];
    for (int a = 0; a < angles_; ++a) {
      const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, dim>> E(basis_.col(a).data(),
                                                                           rank_, dim);
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, dim>>(rotated.col(a).data(), rank_, dim)
          .noalias() = E * edge.R;
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, dim>>(seen.col(a).data(), rank_, dim)
          .noalias() = G * E;
      shifted.col(a).noalias() = E * edge.t;
    }
    from.setZero();
    from.diagonal().head(angles_).setConstant(kappa);
    from.diagonal().tail(rank_).setConstant(tau);
    from.topLeftCorner(angles_, angles_).noalias() += tau * shifted.transpose() * shifted;
    from.topRightCorner(angles_, rank_) = tau * shifted.transpose();
    from.bottomLeftCorner(rank_, angles_) = tau * shifted;
    to.setZero();
    to.diagonal().head(angles_).setConstant(kappa);
    to.diagonal().tail(rank_).setConstant(tau);
    cross.topLeftCorner(angles_, angles_).noalias() = -kappa * rotated.transpose() * seen;
    cross.topRightCorner(angles_, rank_).noalias() = -tau * shifted.transpose() * G;
    cross.bottomLeftCorner(rank_, angles_).setZero();
    cross.bottomRightCorner(rank_, rank_) = -tau * G;
    add(edge.from, edge.from, from);
    add(edge.to, edge.to, to);
    add(edge.from, edge.to, cross);
  }
}

template <int dim>
void LiftedPreconditioner<dim>::factorize(const Eigen::MatrixXd& X) {
  frames_.clear();
  for (int i = 0; i < problem_.nodes; ++i)
    frames_.push_back(frame<dim>(X.middleCols<dim>(i * (dim + 1))));
  assemble();
  const int size = angles_ + rank_;
  const Eigen::VectorXd diagonal = matrix_.diagonal();
  Eigen::VectorXd damping(diagonal.size());
  for (double share = kDamping;; share *= 100) {
    for (Eigen::Index i = 0; i < diagonal.size(); ++i)
      damping[i] = diagonal[i] > 0 ? share * diagonal[i] : 1;
    for (const int root : problem_.roots)
      damping.segment(root * size, size) += kHold * diagonal.segment(root * size, size);
    if (matrix_.factorize(damping)) return;
  }
}

template <int dim>
Eigen::MatrixXd LiftedPreconditioner<dim>::apply(const Eigen::MatrixXd& V) const {
  const int size = angles_ + rank_;
  Eigen::MatrixXd x(static_cast<Eigen::Index>(problem_.nodes) * size, 1);
  Eigen::Matrix<double, Eigen::Dynamic, dim> local(rank_, dim);
  for (int i = 0; i < problem_.nodes; ++i) {
    local.noalias() = frames_[i].transpose() * V.middleCols<dim>(i * (dim + 1));
    x.block(i * size, 0, angles_, 1).noalias() =
        basis_.transpose() * Eigen::Map<const Eigen::VectorXd>(local.data(), local.size());
    x.block(i * size + angles_, 0, rank_, 1).noalias() =
        frames_[i].transpose() * V.col(i * (dim + 1) + dim);
  }
  matrix_.solve(x);
  Eigen::MatrixXd Z(V.rows(), V.cols());
  for (int i = 0; i < problem_.nodes; ++i) {
    Eigen::Map<Eigen::VectorXd>(local.data(), local.size()).noalias() =
        basis_ * x.block(i * size, 0, angles_, 1);
    Z.middleCols<dim>(i * (dim + 1)).noalias() = frames_[i] * local;
    Z.col(i * (dim + 1) + dim).noalias() = frames_[i] * x.block(i * size + angles_, 0, rank_, 1);
  }
  return Z;
}

template class LiftedPreconditioner<2>;
template class LiftedPreconditioner<3>;

}  // namespace placegraph
