#include <placegraph/backend/initialization/chordal_relaxation.h>
#include <placegraph/backend/initialization/lifted_preconditioner.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

namespace placegraph {
namespace {

constexpr int kMaxProducts = 200;  ///< maximum number of products of one step

double inner(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A.cwiseProduct(B).sum(); }

/// A step of the descent.
struct DescentStep {
  Eigen::MatrixXd eta;
  double promise = 0, length = 0;  // predicted decrease; norm in the preconditioner's metric
  bool at_border = false;
  int products = 0;
};
/// Steihaug's truncated conjugate gradients on the model of f / 2 within the radius.
template <int dim>
DescentStep truncated_cg(const LiftedProblem<dim>& problem, const Eigen::MatrixXd& X,
                         const typename LiftedProblem<dim>::Multipliers& lambda,
                         const LiftedPreconditioner<dim>& preconditioner,
                         const Eigen::MatrixXd& gradient, const Eigen::MatrixXd& preconditioned,
                         double radius, double forcing) {
  DescentStep step;
  step.eta = Eigen::MatrixXd::Zero(X.rows(), X.cols());
  Eigen::MatrixXd H_eta = step.eta, residual = gradient, z = preconditioned, direction = -z;
  double z_r = inner(z, residual);
  const double target = z_r * forcing * forcing;
  double eta_eta = 0, eta_d = 0, d_d = z_r;  // in the preconditioner's metric
  while (step.products < kMaxProducts) {
    const Eigen::MatrixXd H_d = problem.hessian(X, lambda, direction);
    ++step.products;
    const double curvature = inner(direction, H_d);
    const double alpha = z_r / curvature;
    const double longer = eta_eta + 2 * alpha * eta_d + alpha * alpha * d_d;
    if (!(curvature > 0) || longer >= radius * radius) {
      const double to_border =
          (-eta_d + std::sqrt(eta_d * eta_d + d_d * (radius * radius - eta_eta))) / d_d;
      step.eta += to_border * direction;
      H_eta += to_border * H_d;
      eta_eta = radius * radius;
      step.at_border = true;
      break;
    }
    step.eta += alpha * direction;
    H_eta += alpha * H_d;
    eta_eta = longer;
    residual += alpha * H_d;
    z = preconditioner.apply(residual);
    const double z_r_next = inner(z, residual);
    if (!(z_r_next > target)) break;
    const double beta = z_r_next / z_r;
    z_r = z_r_next;
    direction = -z + beta * direction;
    eta_d = beta * (eta_d + alpha * d_d);
    d_d = z_r + beta * beta * d_d;
  }
  step.length = std::sqrt(eta_eta);
  step.promise = -inner(gradient, step.eta) - 0.5 * inner(H_eta, step.eta);
  return step;
}

}  // namespace

template <int dim>
ChordalRelaxation<dim>::ChordalRelaxation(const IsotropicProblem<dim>& problem)
    : problem_(problem), effort_(dim, problem.nodes, problem.edges.size(), problem_.ordering()) {}

template <int dim>
template <class Group>
Eigen::MatrixXd ChordalRelaxation<dim>::point(const std::vector<Group>& poses) const {
  Eigen::MatrixXd X(dim, static_cast<Eigen::Index>(poses.size()) * Lifted::kBlock);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Lifted::Y(X, static_cast<int>(i)) = poses[i].rotation().matrix();
    Lifted::p(X, static_cast<int>(i)) = poses[i].translation();
  }
  return X;
}

template <int dim>
double ChordalRelaxation<dim>::cost(const Eigen::MatrixXd& X) const {
  return problem_.cost(X);
}

template <int dim>
double ChordalRelaxation<dim>::certificate_effort(int factorizations, int solutions) const {
  return effort_.certificate(factorizations, solutions);
}

template <int dim>
typename ChordalRelaxation<dim>::Descent ChordalRelaxation<dim>::minimize(
    Eigen::MatrixXd& X, const DescentOptions& options) const {
  Descent descent;
  problem_.solve_translations(X);
  descent.cost = problem_.cost(X);
  double radius = std::sqrt(2 * descent.cost);
  const double tiny = std::numeric_limits<double>::min();
  LiftedPreconditioner<dim> preconditioner(problem_.isotropic(), problem_.ordering(),
                                           static_cast<int>(X.rows()));
  Eigen::MatrixXd XQ = problem_.product(X);
  bool moved = true;
  const int rank = static_cast<int>(X.rows());
  for (; descent.iterations < options.max_steps && descent.effort < options.max_effort;
       ++descent.iterations) {
    const auto lambda = problem_.multipliers(X, XQ);
    Eigen::MatrixXd gradient = XQ;
    problem_.project(X, gradient);
    if (moved) preconditioner.factorize(X);
    const Eigen::MatrixXd preconditioned = preconditioner.apply(gradient);
    const double promise = inner(gradient, preconditioned);
    if (promise <= options.promise_share * descent.cost + tiny) {
      descent.converged = true;
      break;
    }
    const double forcing = std::min(0.1, std::sqrt(std::sqrt(promise / (descent.cost + tiny))));
    const DescentStep step = truncated_cg(problem_, X, lambda, preconditioner, gradient,
                                          preconditioned, radius, forcing);
    descent.products += step.products;
    descent.effort += effort_.step(rank, step.products);
    const Eigen::MatrixXd next = problem_.retract(X, step.eta);
    const double next_cost = problem_.cost(next);
    // Near convergence both decreases are rounding.
    const double slack = 1e-13 * descent.cost;
    const double quality = (0.5 * (descent.cost - next_cost) + slack) / (step.promise + slack);
    if (quality < 0.25)
      radius = 0.25 * step.length;
    else if (quality > 0.75 && step.at_border)
      radius *= 2;
    moved = quality > 0.05;
    if (moved) {
      const bool still = step.promise < slack;
      X = next;
      descent.cost = next_cost;
      XQ = problem_.product(X);
      if (still) {
        descent.converged = true;
        break;
      }
    } else if (radius * radius < 1e-14 * descent.cost) {
      break;
    }
  }
  return descent;
}

template <int dim>
Eigen::MatrixXd ChordalRelaxation<dim>::escape(const Eigen::MatrixXd& X,
                                               const Eigen::VectorXd& direction) const {
  Eigen::MatrixXd lifted = Eigen::MatrixXd::Zero(X.rows() + 1, X.cols());
  lifted.topRows(X.rows()) = X;
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(lifted.rows(), lifted.cols());
  double largest = 0;
  for (int i = 0; i < problem_.nodes(); ++i)
    largest = std::max(largest, direction.segment<dim>(i * Lifted::kBlock).norm());
  tangent.bottomRows(1) = direction.transpose() / largest;
  // The step starts with one radian of the rotation that moves most, and is halved until the cost
  // falls.
  const double cost_here = problem_.cost(X);
  Eigen::MatrixXd best = lifted;
  double best_cost = cost_here;
  for (double length = 1; length > 1e-8; length *= 0.5) {
    Eigen::MatrixXd moved = problem_.retract(lifted, length * tangent);
    const double cost = problem_.cost(moved);
    if (cost < best_cost) {
      best = std::move(moved);
      best_cost = cost;
    } else if (best_cost < cost_here) {
      break;
    }
  }
  return best;
}

template <int dim>
Eigen::MatrixXd ChordalRelaxation<dim>::round(const Eigen::MatrixXd& X) const {
  using Small = typename IsotropicProblem<dim>::Matrix;
  // The d leading left singular vectors of the rotations.
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(X.rows(), X.rows());
  for (int i = 0; i < problem_.nodes(); ++i) gram += Lifted::Y(X, i) * Lifted::Y(X, i).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
  Eigen::MatrixXd rounded = eigen.eigenvectors().rightCols(dim).transpose() * X;
  int proper = 0;
  for (int i = 0; i < problem_.nodes(); ++i)
    proper += Small(Lifted::Y(rounded, i)).determinant() > 0 ? 1 : -1;
  if (proper < 0) rounded.row(0) *= -1;
  for (int i = 0; i < problem_.nodes(); ++i)
    Lifted::Y(rounded, i) = nearest_rotation(Small(Lifted::Y(rounded, i))).matrix();
  problem_.solve_translations(rounded);
  return rounded;
}

template <int dim>
CertificateMatrix<dim> ChordalRelaxation<dim>::certificate_matrix(const Eigen::MatrixXd& X) const {
  return {problem_.isotropic(), problem_.ordering(), problem_.multipliers(X, problem_.product(X))};
}

template class ChordalRelaxation<2>;
template class ChordalRelaxation<3>;
template Eigen::MatrixXd ChordalRelaxation<2>::point(const std::vector<SE2>&) const;
template Eigen::MatrixXd ChordalRelaxation<3>::point(const std::vector<SE3>&) const;
template Eigen::MatrixXd ChordalRelaxation<3>::point(const std::vector<Sim3>&) const;

}  // namespace placegraph
