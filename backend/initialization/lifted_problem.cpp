#include <placegraph/backend/initialization/lifted_problem.h>

#include <Eigen/Eigenvalues>

namespace placegraph {
namespace {

template <int dim>
using Small = Eigen::Matrix<double, dim, dim>;

template <int dim>
Small<dim> symmetric_part(const Small<dim>& A) {
  return 0.5 * (A + A.transpose());
}

/// A^-1/2 of a symmetric positive definite matrix.
template <int dim>
Small<dim> inverse_square_root(const Small<dim>& A) {
  const Eigen::SelfAdjointEigenSolver<Small<dim>> eigen(A);
  return eigen.operatorInverseSqrt();
}

}  // namespace

template <int dim>
LiftedProblem<dim>::LiftedProblem(const IsotropicProblem<dim>& isotropic) : isotropic_(isotropic) {
  for (const auto& edge : isotropic_.edges) pairs_.emplace_back(edge.from, edge.to);
  ordering_ = order_blocks(isotropic_.nodes, kBlock, pairs_);
  factorize_translations();
}

/// The Laplacian of the translations, with the first of every component held.
template <int dim>
void LiftedProblem<dim>::factorize_translations() {
  laplacian_.emplace(isotropic_.nodes, 1, pairs_, ordering_);
  laplacian_->set_zero();
  for (const auto& edge : isotropic_.edges) {
    *laplacian_->slot(edge.from, edge.from).first += edge.translation_weight;
    *laplacian_->slot(edge.to, edge.to).first += edge.translation_weight;
    *laplacian_->slot(edge.from, edge.to).first -= edge.translation_weight;
  }
  Eigen::VectorXd hold = Eigen::VectorXd::Zero(isotropic_.nodes);
  const double mean = laplacian_->diagonal().mean();
  for (const int root : isotropic_.roots) hold[root] = mean > 0 ? mean : 1;
  if (!laplacian_->factorize(hold)) laplacian_.reset();
}

template <int dim>
void LiftedProblem<dim>::solve_translations(Eigen::MatrixXd& X) const {
  if (!laplacian_) return;
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(nodes(), X.rows());
  for (const auto& edge : isotropic_.edges) {
    const Eigen::VectorXd step = edge.translation_weight * (Y(X, edge.from) * edge.t);
    rhs.row(edge.to) += step;
    rhs.row(edge.from) -= step;
  }
  laplacian_->solve(rhs);
  for (int i = 0; i < nodes(); ++i) p(X, i) = rhs.row(i);
}

template <int dim>
Eigen::MatrixXd LiftedProblem<dim>::product(const Eigen::MatrixXd& X) const {
  Eigen::MatrixXd XQ = Eigen::MatrixXd::Zero(X.rows(), X.cols());
  Eigen::Matrix<double, Eigen::Dynamic, dim> rotation(X.rows(), dim);
  Eigen::VectorXd translation(X.rows());
  for (const auto& edge : isotropic_.edges) {
    const auto from = Y(X, edge.from);
    rotation = Y(X, edge.to);
    rotation.noalias() -= from * edge.R;
    rotation *= edge.rotation_weight;
    translation = p(X, edge.to) - p(X, edge.from);
    translation.noalias() -= from * edge.t;
    translation *= edge.translation_weight;
    Y(XQ, edge.to) += rotation;
    p(XQ, edge.to) += translation;
    auto XQ_from = Y(XQ, edge.from);
    XQ_from.noalias() -= rotation * edge.R.transpose();
    XQ_from.noalias() -= translation * edge.t.transpose();
    p(XQ, edge.from) -= translation;
  }
  return XQ;
}

template <int dim>
double LiftedProblem<dim>::cost(const Eigen::MatrixXd& X) const {
  double f = 0;
  for (const auto& edge : isotropic_.edges) {
    const auto from = Y(X, edge.from);
    f += edge.rotation_weight * (Y(X, edge.to) - from * edge.R).squaredNorm() +
         edge.translation_weight * (p(X, edge.to) - p(X, edge.from) - from * edge.t).squaredNorm();
  }
  return f;
}

template <int dim>
typename LiftedProblem<dim>::Multipliers LiftedProblem<dim>::multipliers(
    const Eigen::MatrixXd& X, const Eigen::MatrixXd& XQ) const {
  Multipliers lambda;
  lambda.reserve(nodes());
  for (int i = 0; i < nodes(); ++i)
    lambda.push_back(symmetric_part<dim>(Y(X, i).transpose() * Y(XQ, i)));
  return lambda;
}

template <int dim>
void LiftedProblem<dim>::project(const Eigen::MatrixXd& X, Eigen::MatrixXd& V) const {
  for (int i = 0; i < nodes(); ++i) {
    auto V_i = Y(V, i);
    const Small<dim> normal = symmetric_part<dim>(Y(X, i).transpose() * V_i);
    V_i.noalias() -= Y(X, i) * normal;
  }
}

template <int dim>
Eigen::MatrixXd LiftedProblem<dim>::retract(const Eigen::MatrixXd& X,
                                            const Eigen::MatrixXd& V) const {
  Eigen::MatrixXd moved = X + V;
  for (int i = 0; i < nodes(); ++i) {
    auto Y_i = Y(moved, i);
    const Small<dim> gram = Y_i.transpose() * Y_i;
    Y_i = (Y_i * inverse_square_root<dim>(gram)).eval();
  }
  solve_translations(moved);
  return moved;
}

template <int dim>
Eigen::MatrixXd LiftedProblem<dim>::hessian(const Eigen::MatrixXd& X, const Multipliers& lambda,
                                            const Eigen::MatrixXd& V) const {
  Eigen::MatrixXd H = product(V);
  for (int i = 0; i < nodes(); ++i) Y(H, i).noalias() -= Y(V, i) * lambda[i];
  project(X, H);
  return H;
}

template class LiftedProblem<2>;
template class LiftedProblem<3>;

}  // namespace placegraph
