#include <placegraph/frontend/vanishing/manhattan_fit.h>
#include <placegraph/frontend/vanishing/vanishing_model.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Normal equations of the lines of one axis, in the two directions across it.
struct AxisEquations {
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();         ///< reweighted
  Eigen::Matrix2d expected = Eigen::Matrix2d::Zero();  ///< without the weights of the sample
  Eigen::Vector2d g = Eigen::Vector2d::Zero();         ///< negative gradient
  Eigen::Matrix<double, 2, 3> D;  ///< derivative of the axis by a rotation on the right
};

std::array<AxisEquations, 3> equations(const VanishingEvidence& evidence, const SO3& R,
                                       const std::vector<int>& axis) {
  const Eigen::Matrix3d M = R.matrix();
  std::array<AxisEquations, 3> result;
  std::array<TangentBasis, 3> basis;
  for (int a = 0; a < 3; ++a) {
    const std::size_t k = static_cast<std::size_t>(a);
    basis[k] << M.col((a + 1) % 3), M.col((a + 2) % 3);
    // R exp(w) e_a = R e_a - R hat(e_a) w
    result[k].D = -basis[k].transpose() * M * hat(Eigen::Vector3d::Unit(a));
  }
  for (int i = 0; i < evidence.size(); ++i) {
    const int a = axis[static_cast<std::size_t>(i)];
    if (a < 0) continue;
    AxisEquations& of = result[static_cast<std::size_t>(a)];
    const PointingError e = evidence.error(i, M.col(a));
    const Eigen::RowVector2d J = e.J_sine_v * basis[static_cast<std::size_t>(a)];
    const double w = evidence.robust_weight(e);
    const Eigen::Matrix2d JJ = J.transpose() * J / e.variance;
    of.H += w * JJ;
    of.expected += evidence.information_share() * JJ;
    of.g -= (w * e.sine / e.variance) * J.transpose();
  }
  return result;
}

/// Normal equations of the rotation, with the axes' own offsets of variance s2 integrated out.
void reduce(const std::array<AxisEquations, 3>& axes, double s2, Eigen::Matrix3d& A,
            Eigen::Vector3d& b) {
  A.setZero();
  b.setZero();
  for (const AxisEquations& axis : axes) {
    const Eigen::Matrix2d held = (Eigen::Matrix2d::Identity() + s2 * axis.H).inverse();
    A += axis.D.transpose() * (held * axis.H) * axis.D;
    b += axis.D.transpose() * (held * axis.g);
  }
}

/// Restricted log-likelihood of the offsets' variance, at its optimal rotation.
double offset_likelihood(const std::array<AxisEquations, 3>& axes, double s2) {
  Eigen::Matrix3d A;
  Eigen::Vector3d b;
  reduce(axes, s2, A, b);
  const Eigen::Vector3d rotation = (A + 1e-6 * Eigen::Matrix3d::Identity()).ldlt().solve(b);
  double value = -0.5 * std::log((A + Eigen::Matrix3d::Identity()).determinant());
  for (const AxisEquations& axis : axes) {
    const Eigen::Matrix2d H = axis.H;
    const Eigen::Vector2d g = axis.g - H * axis.D * rotation;
    const Eigen::Matrix2d held = Eigen::Matrix2d::Identity() + s2 * H;
    const Eigen::Vector2d moved = axis.D * rotation;
    value += 0.5 * s2 * g.dot(held.inverse() * g) - 0.5 * std::log(held.determinant());
    value += axis.g.dot(moved) - 0.5 * moved.dot(H * moved);
  }
  return value;
}

/// Rotation in the directions that the normal equations determine; the others do not change.
Eigen::Vector3d observed_rotation(const Eigen::Matrix3d& A, const Eigen::Vector3d& b) {
  constexpr double kLeast = 30;  // a deviation of 10 degrees
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(A);
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    if (eigen.eigenvalues()[k] > kLeast)
      rotation += eigen.eigenvectors().col(k) *
                  (eigen.eigenvectors().col(k).dot(b) / eigen.eigenvalues()[k]);
  // Longest step [rad]. Chosen.
  constexpr double kMaxRotation = 0.2;
  const double norm = rotation.norm();
  return norm > kMaxRotation ? Eigen::Vector3d(rotation * (kMaxRotation / norm)) : rotation;
}

/// Assigns lines to the axes with the current shares; evidence and cost by the lines' log-ratios.
void assign(const VanishingEvidence& evidence, double widen_rad, ManhattanFit& fit) {
  const std::size_t n = static_cast<std::size_t>(evidence.size());
  const Eigen::Matrix3d M = fit.R_cam_axes.matrix();
  std::vector<std::array<double, 3>> ratios(n);
  for (std::size_t i = 0; i < n; ++i)
    for (int a = 0; a < 3; ++a)
      ratios[i][static_cast<std::size_t>(a)] =
          evidence.log_ratio(static_cast<int>(i), M.col(a), widen_rad);
  const double total = std::max(evidence.total_weight(), 1e-9);
  std::array<double, 4> share{0.4, 0.2, 0.2, 0.2};  // none, then the axes
  for (double& part : share) part *= total;
  // Chosen.
  constexpr int kRounds = 2;
  for (int round = 0; round <= kRounds; ++round) {
    std::array<double, 3> bonus{}, gain{};
    for (std::size_t a = 0; a < 3; ++a) bonus[a] = std::log((share[a + 1] + 1) / (share[0] + 1));
    share = {};
    fit.lines = {};
    fit.axis.assign(n, -1);
    for (std::size_t i = 0; i < n; ++i) {
      double best = 0;
      int which = -1;
      for (std::size_t a = 0; a < 3; ++a)
        if (ratios[i][a] + bonus[a] > best)
          best = ratios[i][a] + bonus[a], which = static_cast<int>(a);
      const double weight = evidence.weight(static_cast<int>(i));
      fit.axis[i] = which;
      share[static_cast<std::size_t>(which + 1)] += weight;
      if (which < 0) continue;
      ++fit.lines[static_cast<std::size_t>(which)];
      gain[static_cast<std::size_t>(which)] += weight * ratios[i][static_cast<std::size_t>(which)];
    }
    fit.cost = 0;
    for (const double part : share) fit.cost += entropy_term(part, total);
    for (std::size_t a = 0; a < 3; ++a) {
      fit.cost -= gain[a];
      // Cost of the shares if the lines of the axis had no direction.
      const double merged = entropy_term(share[0] + share[a + 1], total);
      fit.evidence[a] =
          gain[a] - (entropy_term(share[0], total) + entropy_term(share[a + 1], total) - merged);
    }
  }
}

}  // namespace

ManhattanFit fit_manhattan(const VanishingEvidence& evidence, const SO3& R_cam_axes,
                           double orthogonality_rad, double widen_rad, int rounds) {
  ManhattanFit fit;
  fit.R_cam_axes = R_cam_axes;
  Eigen::Matrix3d A;
  Eigen::Vector3d b;
  constexpr double kMultiples[] = {0, 0.5, 0.7, 1, 1.4, 2};
  for (int round = 0; round < rounds; ++round) {
    assign(evidence, std::hypot(widen_rad / (1 << (2 * round)), fit.orthogonality_rad), fit);
    for (int iteration = 0; iteration < 2; ++iteration) {
      const auto axes = equations(evidence, fit.R_cam_axes, fit.axis);
      double best = -std::numeric_limits<double>::infinity();
      for (const double multiple : kMultiples) {
        const double s = multiple * orthogonality_rad, value = offset_likelihood(axes, s * s);
        if (value > best) best = value, fit.orthogonality_rad = s;
      }
      reduce(axes, fit.orthogonality_rad * fit.orthogonality_rad, A, b);
      fit.R_cam_axes = fit.R_cam_axes.plus(observed_rotation(A, b));
    }
  }
  assign(evidence, fit.orthogonality_rad, fit);
  auto axes = equations(evidence, fit.R_cam_axes, fit.axis);
  for (AxisEquations& axis : axes) axis.H = axis.expected;
  reduce(axes, fit.orthogonality_rad * fit.orthogonality_rad, A, b);
  fit.information = 0.5 * (A + A.transpose());
  fit.cost += 0.5 * std::log((A + Eigen::Matrix3d::Identity()).determinant());
  return fit;
}

AxisOffset own_direction(const VanishingEvidence& evidence, const ManhattanFit& fit, int axis) {
  std::vector<int> lines;
  for (int i = 0; i < evidence.size(); ++i)
    if (fit.axis[static_cast<std::size_t>(i)] == axis) lines.push_back(i);
  const FittedDirection own = fit_direction(evidence, fit.R_cam_axes.matrix().col(axis), lines, 3);
  return {own.ok, own.v, own.covariance};
}

}  // namespace placegraph
