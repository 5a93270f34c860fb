#include <placegraph/frontend/align/alignment_covariance.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kReach = 4;              // grid steps
constexpr double kRounding = 1.0 / 6;  // variance of the difference of two rounded grey values

/// Projects the columns of C out of the columns of J.
void project_out(const MatrixXd& C, const VectorXd& weight, MatrixXd& J) {
  const MatrixXd WC = weight.asDiagonal() * C;
  const MatrixXd share = (C.transpose() * WC).ldlt().solve(WC.transpose() * J);
  if (share.allFinite()) J -= C * share;
}

/// Inverse of a symmetric matrix with mixed units; nothing if it is singular.
std::optional<MatrixXd> inverse_of(const MatrixXd& H) {
  if (!(H.diagonal().minCoeff() > 0)) return std::nullopt;
  const VectorXd scale = H.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd S = scale.asDiagonal() * H * scale.asDiagonal();
  const Eigen::LLT<MatrixXd> llt(S);
  if (llt.info() != Eigen::Success || llt.rcond() < 1e-10) return std::nullopt;
  const MatrixXd inverse = llt.solve(MatrixXd::Identity(H.rows(), H.cols()));
  return MatrixXd(scale.asDiagonal() * inverse * scale.asDiagonal());
}

/// The samples on their grid: index of the row of J, -1 where there is none.
Eigen::MatrixXi grid_of(const TemplateLevel& level, const SeenSamples& seen,
                        const VectorXd& weight) {
  Eigen::MatrixXi grid = Eigen::MatrixXi::Constant(level.rows, level.columns, -1);
  for (std::size_t i = 0; i < seen.index.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const TemplateSample& sample = level.samples[seen.index[i]];
    if (weight[row] > 0) grid(sample.row, sample.column) = static_cast<int>(i);
  }
  return grid;
}

/// sum c(i - j) J_i J_j^T; `variance` receives c(0).
MatrixXd correlated_sum(const Eigen::MatrixXi& grid, const MatrixXd& J, const VectorXd& psi,
                        double& variance) {
  MatrixXd sum = MatrixXd::Zero(J.cols(), J.cols());
  for (int dr = 0; dr <= kReach; ++dr)
    for (int dc = dr == 0 ? 0 : -kReach; dc <= kReach; ++dc) {
      MatrixXd products = MatrixXd::Zero(J.cols(), J.cols());
      double covariance = 0;
      int pairs = 0;
      for (int r = 0; r + dr < grid.rows(); ++r)
        for (int c = std::max(0, -dc); c < grid.cols() - std::max(0, dc); ++c) {
          const int i = grid(r, c), j = grid(r + dr, c + dc);
          if (i < 0 || j < 0) continue;
          covariance += psi[i] * psi[j];
          products.noalias() += J.row(i).transpose() * J.row(j);
          ++pairs;
        }
      if (pairs == 0) continue;
      covariance /= pairs;
      if (dr == 0 && dc == 0) {
        variance = covariance = std::max(covariance, kRounding);
        sum += covariance * products;
      } else {
        sum += covariance * (products + products.transpose());
      }
    }
  return sum;
}

/// The matrix, raised to at least a tenth of `floor` in every direction.
MatrixXd bounded_below(const MatrixXd& M, const MatrixXd& floor) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(M, floor);
  if (solver.info() != Eigen::Success) return M;
  const MatrixXd L = floor * solver.eigenvectors();
  return L * solver.eigenvalues().cwiseMax(0.1).asDiagonal() * L.transpose();
}

}  // namespace

std::optional<AlignmentCovariance> alignment_covariance(const PlanarTemplate& planar_template,
                                                        const Image& image, int level,
                                                        const PlanarWarp& warp,
                                                        const GradientAlignmentOptions& options) {
  const TemplateLevel& samples = planar_template.levels().at(static_cast<std::size_t>(level));
  SeenSamples seen;
  see_samples(samples, planar_template, image, level, warp.H_cur_ref(), true, seen);
  if (seen.index.size() < 2) return std::nullopt;
  PhotometricFit fit;
  fit_photometry(options.similarity, seen.ref, seen.cur, options.kernel, options.kernel_width, fit);

  const auto n = static_cast<Eigen::Index>(seen.index.size());
  const PlanarWarp::Generators A = template_generators(planar_template, warp);
  const RobustKernel kernel{options.kernel, options.kernel_width};
  MatrixXd J(n, warp.dof()), C(n, 2);
  VectorXd psi(n), psi_slope(n), weight(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const TemplateSample& sample = samples.samples[seen.index[k]];
    const Eigen::Vector2d gradient = 0.5 * (fit.slope[k] * sample.gradient + seen.gradient[k]);
    J.row(i) = generator_row(sample.x, gradient).transpose() * A;
    C.row(i) << fit.model[k], 1;
    const double e = seen.cur[k] - fit.model[k], s = e * e / (fit.sigma_grey * fit.sigma_grey);
    const RobustKernel::Value rho = kernel.evaluate(s);
    weight[i] = rho.first;
    psi[i] = rho.first * e;
    psi_slope[i] = rho.first + 2 * s * rho.second;
  }
  if (options.similarity != Similarity::kSsd) project_out(C, weight, J);
  const MatrixXd unweighted =
      J.transpose() * (weight.array() > 0).cast<double>().matrix().asDiagonal() * J;
  auto H_inverse = inverse_of(J.transpose() * psi_slope.asDiagonal() * J);
  if (!H_inverse) H_inverse = inverse_of(J.transpose() * weight.asDiagonal() * J);
  if (!H_inverse) return std::nullopt;
  AlignmentCovariance result;
  double variance = 0;
  const MatrixXd correlated = correlated_sum(grid_of(samples, seen, weight), J, psi, variance);
  const MatrixXd independent = variance * unweighted;
  const MatrixXd M = bounded_below(correlated, independent);
  result.covariance = *H_inverse * M * *H_inverse;
  result.sigma_grey = fit.sigma_grey;
  const VectorXd unit = H_inverse->diagonal().cwiseInverse();
  result.independent_share = (*H_inverse * independent * *H_inverse * unit.asDiagonal()).trace() /
                             (result.covariance * unit.asDiagonal()).trace();
  return result;
}

double corner_sigma_px(const PlanarTemplate& planar_template, const PlanarWarp& warp,
                       const MatrixXd& covariance) {
  const auto J = planar_template.corner_jacobian(warp);
  const MatrixXd corners = J * covariance * J.transpose();
  double largest = 0;
  for (int c = 0; c < 4; ++c)
    largest = std::max(largest, corners.block<2, 2>(2 * c, 2 * c).trace());
  return std::isfinite(largest) ? std::sqrt(largest) : std::numeric_limits<double>::infinity();
}

double promised_corner_sigma_px(const PlanarTemplate& planar_template, int level,
                                const PlanarWarp& warp, double sigma_grey) {
  const TemplateLevel& samples = planar_template.levels().at(static_cast<std::size_t>(level));
  Eigen::Matrix<double, 9, 9> gram = Eigen::Matrix<double, 9, 9>::Zero();
  for (const TemplateSample& sample : samples.samples)
    gram.selfadjointView<Eigen::Lower>().rankUpdate(generator_row(sample.x, sample.gradient));
  gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
  const PlanarWarp::Generators A = template_generators(planar_template, warp);
  const auto H_inverse = inverse_of(A.transpose() * gram * A);
  if (!H_inverse) return std::numeric_limits<double>::infinity();
  return corner_sigma_px(planar_template, warp, sigma_grey * sigma_grey * *H_inverse);
}

}  // namespace placegraph
