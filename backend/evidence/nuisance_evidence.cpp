#include <placegraph/backend/evidence/nuisance_evidence.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace placegraph {

NuisanceEvidence with_own_errors(const NuisanceEvidence& evidence,
                                 const Eigen::VectorXd& own_sigmas) {
  Eigen::MatrixXd sum = evidence.information;
  sum.diagonal() += own_sigmas.cwiseAbs2().cwiseInverse();
  const Eigen::MatrixXd kept =
      Eigen::MatrixXd::Identity(sum.rows(), sum.cols()) - evidence.information * sum.inverse();
  const Eigen::MatrixXd information = kept * evidence.information;
  return {kept * evidence.gradient, 0.5 * (information + information.transpose())};
}

double squared_difference(const NuisanceEvidence& evidence, const Eigen::VectorXd& q,
                          const Eigen::VectorXd& prior_sigmas, double& freedom) {
  // Eigenvalue, in units of the prior, of a direction without evidence. Chosen.
  constexpr double kNothing = 1e-6;
  const auto unit = prior_sigmas.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(unit * evidence.information * unit);
  const Eigen::VectorXd gradient = eigen.eigenvectors().transpose() *
                                   (unit * (evidence.gradient + evidence.information * q)).eval();
  double sum = 0;
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    const double lambda = eigen.eigenvalues()[i];
    if (!(lambda > kNothing)) continue;
    sum += gradient[i] * gradient[i] / lambda;
    freedom += 1;
  }
  return sum;
}

}  // namespace placegraph
