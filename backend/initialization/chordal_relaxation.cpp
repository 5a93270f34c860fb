#include <placegraph/backend/initialization/chordal_relaxation.h>
#include <placegraph/backend/initialization/lifted_preconditioner.h>
#include <placegraph/backend/linear/block_cholesky.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <optional>

namespace placegraph {
namespace {

constexpr int kMaxProducts = 200;  ///< of one step
/// Operations per edge, beside those that grow with the rank, and per node.
constexpr double kLinearization = 500, kProduct = 200, kNode = 100;

double inner(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A.cwiseProduct(B).sum(); }

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
struct ChordalRelaxation<dim>::Impl {
  static constexpr int kBlock = dim + 1;
  using Block = Eigen::Matrix<double, kBlock, kBlock>;
  using Multipliers = std::vector<Small<dim>>;

  const IsotropicProblem<dim> problem;
  std::vector<std::pair<int, int>> pairs;  // of the blocks
  BlockOrdering order;
  std::optional<BlockCholesky> laplacian;  // factorized

  explicit Impl(const IsotropicProblem<dim>& isotropic) : problem(isotropic) {
    for (const auto& edge : problem.edges) pairs.emplace_back(edge.from, edge.to);
    order = order_blocks(problem.nodes, kBlock, pairs);
    factorize_translations();
  }

  /// The translations' Laplacian, the first one of every component held.
  void factorize_translations() {
    laplacian.emplace(problem.nodes, 1, pairs, order);
    laplacian->set_zero();
    for (const auto& edge : problem.edges) {
      *laplacian->slot(edge.from, edge.from).first += edge.translation_weight;
      *laplacian->slot(edge.to, edge.to).first += edge.translation_weight;
      *laplacian->slot(edge.from, edge.to).first -= edge.translation_weight;
    }
    Eigen::VectorXd hold = Eigen::VectorXd::Zero(problem.nodes);
    const double mean = laplacian->diagonal().mean();
    for (const int root : problem.roots) hold[root] = mean > 0 ? mean : 1;
    if (!laplacian->factorize(hold)) laplacian.reset();
  }

  /// Replaces the translations by the best ones for the rotations.
  void solve_translations(Eigen::MatrixXd& X) const {
    if (!laplacian) return;
    Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(nodes(), X.rows());
    for (const auto& edge : problem.edges) {
      const Eigen::VectorXd step = edge.translation_weight * (Y(X, edge.from) * edge.t);
      rhs.row(edge.to) += step;
      rhs.row(edge.from) -= step;
    }
    laplacian->solve(rhs);
    for (int i = 0; i < nodes(); ++i) p(X, i) = rhs.row(i);
  }

  int nodes() const { return problem.nodes; }
  static auto Y(Eigen::MatrixXd& X, int i) { return X.middleCols<dim>(i * kBlock); }
  static auto Y(const Eigen::MatrixXd& X, int i) { return X.middleCols<dim>(i * kBlock); }
  static auto p(Eigen::MatrixXd& X, int i) { return X.col(i * kBlock + dim); }
  static auto p(const Eigen::MatrixXd& X, int i) { return X.col(i * kBlock + dim); }

  /// X Q
  Eigen::MatrixXd product(const Eigen::MatrixXd& X) const {
    Eigen::MatrixXd XQ = Eigen::MatrixXd::Zero(X.rows(), X.cols());
    Eigen::Matrix<double, Eigen::Dynamic, dim> rotation(X.rows(), dim);
    Eigen::VectorXd translation(X.rows());
    for (const auto& edge : problem.edges) {
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

  double cost(const Eigen::MatrixXd& X) const {
    double f = 0;
    for (const auto& edge : problem.edges) {
      const auto from = Y(X, edge.from);
      f +=
          edge.rotation_weight * (Y(X, edge.to) - from * edge.R).squaredNorm() +
          edge.translation_weight * (p(X, edge.to) - p(X, edge.from) - from * edge.t).squaredNorm();
    }
    return f;
  }

  /// Lambda_i = sym(Y_i^T (XQ)_i)
  Multipliers multipliers(const Eigen::MatrixXd& X, const Eigen::MatrixXd& XQ) const {
    Multipliers lambda;
    lambda.reserve(nodes());
    for (int i = 0; i < nodes(); ++i)
      lambda.push_back(symmetric_part<dim>(Y(X, i).transpose() * Y(XQ, i)));
    return lambda;
  }

  /// Onto the tangent space at X: V_i - Y_i sym(Y_i^T V_i).
  void project(const Eigen::MatrixXd& X, Eigen::MatrixXd& V) const {
    for (int i = 0; i < nodes(); ++i) {
      auto V_i = Y(V, i);
      const Small<dim> normal = symmetric_part<dim>(Y(X, i).transpose() * V_i);
      V_i.noalias() -= Y(X, i) * normal;
    }
  }

  /// By the polar factor of Y_i + V_i; the translations follow the rotations, so that a bend of a
  /// long chain is not held back by them.
  Eigen::MatrixXd retract(const Eigen::MatrixXd& X, const Eigen::MatrixXd& V) const {
    Eigen::MatrixXd moved = X + V;
    for (int i = 0; i < nodes(); ++i) {
      auto Y_i = Y(moved, i);
      const Small<dim> gram = Y_i.transpose() * Y_i;
      Y_i = (Y_i * inverse_square_root<dim>(gram)).eval();
    }
    solve_translations(moved);
    return moved;
  }

  /// proj(V Q - V Lambda)
  Eigen::MatrixXd hessian(const Eigen::MatrixXd& X, const Multipliers& lambda,
                          const Eigen::MatrixXd& V) const {
    Eigen::MatrixXd H = product(V);
    for (int i = 0; i < nodes(); ++i) Y(H, i).noalias() -= Y(V, i) * lambda[i];
    project(X, H);
    return H;
  }

  // Operations are counted, not timed, so that the same input gives the same bits.
  double factorization_operations(int block) const {
    return order.operations * block * block * block;
  }
  double solution_operations(int block) const { return 2 * order.fill * block * block; }
  double edges() const { return static_cast<double>(problem.edges.size()); }
  /// Of one Gauss-Newton iteration on the pose graph.
  double iteration_operations() const {
    constexpr int dof = dim * (dim + 1) / 2;
    return factorization_operations(dof) + solution_operations(dof) +
           edges() * dof * kLinearization;
  }
  int lifted_block(int rank) const { return dim * rank - dim * (dim + 1) / 2 + rank; }
  /// Of a product with the Hessian and one with the preconditioner.
  double product_operations(int rank) const {
    return solution_operations(lifted_block(rank)) + edges() * (kProduct + 8.0 * rank * dim) +
           nodes() * (kNode + 8.0 * rank * rank * dim);
  }
  /// Of an outer step, beside the products.
  double step_operations(int rank) const {
    const int block = lifted_block(rank);
    return factorization_operations(block) + edges() * (kProduct + 4.0 * rank * block * block) +
           2 * product_operations(rank);
  }

  struct Step {
    Eigen::MatrixXd eta;
    double promise = 0, length = 0;  // decrease of the model; norm in the preconditioner's metric
    bool at_border = false;
    int products = 0;
  };
  /// Steihaug's truncated conjugate gradients on the model of f / 2 within the radius.
  Step truncated_cg(const Eigen::MatrixXd& X, const Multipliers& lambda,
                    const LiftedPreconditioner<dim>& preconditioner,
                    const Eigen::MatrixXd& gradient, const Eigen::MatrixXd& preconditioned,
                    double radius, double forcing) const {
    Step step;
    step.eta = Eigen::MatrixXd::Zero(X.rows(), X.cols());
    Eigen::MatrixXd H_eta = step.eta, residual = gradient, z = preconditioned, direction = -z;
    double z_r = inner(z, residual);
    const double target = z_r * forcing * forcing;
    double eta_eta = 0, eta_d = 0, d_d = z_r;  // in the preconditioner's metric
    while (step.products < kMaxProducts) {
      const Eigen::MatrixXd H_d = hessian(X, lambda, direction);
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

  Descent minimize(Eigen::MatrixXd& X, const DescentOptions& options) const {
    Descent descent;
    solve_translations(X);
    descent.cost = cost(X);
    double radius = std::sqrt(2 * descent.cost);
    const double tiny = std::numeric_limits<double>::min();
    LiftedPreconditioner<dim> preconditioner(problem, order, static_cast<int>(X.rows()));
    Eigen::MatrixXd XQ = product(X);
    bool moved = true;
    const int rank = static_cast<int>(X.rows());
    for (; descent.iterations < options.max_steps && descent.effort < options.max_effort;
         ++descent.iterations) {
      const Multipliers lambda = multipliers(X, XQ);
      Eigen::MatrixXd gradient = XQ;
      project(X, gradient);
      if (moved) preconditioner.factorize(X);
      const Eigen::MatrixXd preconditioned = preconditioner.apply(gradient);
      const double promise = inner(gradient, preconditioned);
      if (promise <= options.promise_share * descent.cost + tiny) {
        descent.converged = true;
        break;
      }
      const double forcing = std::min(0.1, std::sqrt(std::sqrt(promise / (descent.cost + tiny))));
      const Step step =
          truncated_cg(X, lambda, preconditioner, gradient, preconditioned, radius, forcing);
      descent.products += step.products;
      descent.effort += (step_operations(rank) + step.products * product_operations(rank)) /
                        iteration_operations();
      const Eigen::MatrixXd next = retract(X, step.eta);
      const double next_cost = cost(next);
      // At the end both are rounding.
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
        XQ = product(X);
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
};

template <int dim>
ChordalRelaxation<dim>::ChordalRelaxation(const IsotropicProblem<dim>& problem)
    : impl_(std::make_unique<Impl>(problem)) {}
template <int dim>
ChordalRelaxation<dim>::~ChordalRelaxation() = default;

template <int dim>
template <class Group>
Eigen::MatrixXd ChordalRelaxation<dim>::point(const std::vector<Group>& poses) const {
  Eigen::MatrixXd X(dim, static_cast<Eigen::Index>(poses.size()) * Impl::kBlock);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Impl::Y(X, static_cast<int>(i)) = poses[i].rotation().matrix();
    Impl::p(X, static_cast<int>(i)) = poses[i].translation();
  }
  return X;
}

template <int dim>
double ChordalRelaxation<dim>::cost(const Eigen::MatrixXd& X) const {
  return impl_->cost(X);
}

template <int dim>
double ChordalRelaxation<dim>::certificate_effort(int factorizations, int solutions) const {
  return (factorizations * impl_->factorization_operations(dim + 1) +
          solutions * impl_->solution_operations(dim + 1)) /
         impl_->iteration_operations();
}

template <int dim>
typename ChordalRelaxation<dim>::Descent ChordalRelaxation<dim>::minimize(
    Eigen::MatrixXd& X, const DescentOptions& options) const {
  return impl_->minimize(X, options);
}

template <int dim>
Eigen::MatrixXd ChordalRelaxation<dim>::escape(const Eigen::MatrixXd& X,
                                               const Eigen::VectorXd& direction) const {
  Eigen::MatrixXd lifted = Eigen::MatrixXd::Zero(X.rows() + 1, X.cols());
  lifted.topRows(X.rows()) = X;
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(lifted.rows(), lifted.cols());
  double largest = 0;
  for (int i = 0; i < impl_->nodes(); ++i)
    largest = std::max(largest, direction.segment<dim>(i * Impl::kBlock).norm());
  tangent.bottomRows(1) = direction.transpose() / largest;
  // Halved from a radian at the rotation that moves most until the cost falls.
  const double cost_here = impl_->cost(X);
  Eigen::MatrixXd best = lifted;
  double best_cost = cost_here;
  for (double length = 1; length > 1e-8; length *= 0.5) {
    Eigen::MatrixXd moved = impl_->retract(lifted, length * tangent);
    const double cost = impl_->cost(moved);
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
  // The d leading left singular vectors of the rotations.
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(X.rows(), X.rows());
  for (int i = 0; i < impl_->nodes(); ++i) gram += Impl::Y(X, i) * Impl::Y(X, i).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
  Eigen::MatrixXd rounded = eigen.eigenvectors().rightCols(dim).transpose() * X;
  int proper = 0;
  for (int i = 0; i < impl_->nodes(); ++i)
    proper += Small<dim>(Impl::Y(rounded, i)).determinant() > 0 ? 1 : -1;
  if (proper < 0) rounded.row(0) *= -1;
  for (int i = 0; i < impl_->nodes(); ++i)
    Impl::Y(rounded, i) = nearest_rotation(Small<dim>(Impl::Y(rounded, i))).matrix();
  impl_->solve_translations(rounded);
  return rounded;
}

template <int dim>
CertificateMatrix<dim> ChordalRelaxation<dim>::certificate_matrix(const Eigen::MatrixXd& X) const {
  return {impl_->problem, impl_->order, impl_->multipliers(X, impl_->product(X))};
}

template class ChordalRelaxation<2>;
template class ChordalRelaxation<3>;
template Eigen::MatrixXd ChordalRelaxation<2>::point(const std::vector<SE2>&) const;
template Eigen::MatrixXd ChordalRelaxation<3>::point(const std::vector<SE3>&) const;
template Eigen::MatrixXd ChordalRelaxation<3>::point(const std::vector<Sim3>&) const;

}  // namespace placegraph
