#pragma once
#include <placegraph/graph/core/outcome.h>

#include <Eigen/Dense>
#include <array>
#include <limits>
#include <optional>
#include <vector>

namespace placegraph {

/// Pixels of the same points in two views: px_ref[i] and px_cur[i] belong together.
struct PointMatches {
  std::vector<Eigen::Vector2d> px_ref, px_cur;
  int size() const { return static_cast<int>(px_ref.size()); }
};

/// What one match leaves of a homography, with noise of equal variance in both views: to first
/// order e = px_cur - H px_ref has the covariance S = I + J J^T per unit of that variance, J being
/// the derivative of the transfer (Hartley & Zisserman 2004, sec. 4.2.6: the Sampson error, the
/// first-order symmetric transfer error).
struct TransferError {
  Eigen::Vector2d residual;         ///< e [px]
  Eigen::Matrix2d unit_covariance;  ///< S
  double squared = 0;               ///< e^T S^-1 e [px^2]; infinite beyond the horizon
  double log_determinant = 0;       ///< log det S
};
TransferError transfer_error(const Eigen::Matrix3d& H_cur_ref, const Eigen::Vector2d& px_ref,
                             const Eigen::Vector2d& px_cur);

/// The noise of matches on a plane: equal in both views and of heavy tails, as detectors, matchers
/// and people leave it. The transfer error is bivariate Student t about zero with scale matrix
/// sigma^2 S and `freedom` degrees of freedom; normal for an infinite `freedom`.
struct TransferNoise {
  double sigma_px = 1;
  double freedom = std::numeric_limits<double>::infinity();
  /// -log of the density of the transfer error [nats].
  double cost(const TransferError& error) const;
  /// Weight of its square in reweighted least squares: one for the normal distribution.
  double weight(const TransferError& error) const;
  /// Expected information of one match over that of a normal one of the same sigma (Lange, Little &
  /// Taylor 1989, "Robust statistical modeling using the t distribution").
  double information() const;
};

/// The homography through four matches; nothing where three of them are (nearly) in a line in a
/// view or the four cannot lie in front of both cameras on one side of one plane (a triangle that
/// turns its sense).
std::optional<Eigen::Matrix3d> homography_through(const PointMatches& matches,
                                                  const std::array<int, 4>& which);

struct HomographyFit {
  Outcome outcome;
  Eigen::Matrix3d H_cur_ref = Eigen::Matrix3d::Identity();  ///< of Frobenius norm one, det > 0
  /// Covariance of the nine entries, row by row; of rank eight: it is zero along H itself.
  Eigen::Matrix<double, 9, 9> covariance = Eigen::Matrix<double, 9, 9>::Zero();
  double cost = 0;  ///< sum of the matches' costs by the noise [nats]
  int iterations = 0;
};

/// Refines `H_start` over the matches `which` by reweighted Gauss-Newton on the symmetric transfer
/// error, in the eight directions across H, pixels centred and scaled inside (Hartley 1997).
/// Outcomes: too few data (under four matches), degenerate (the matches do not fix a homography, or
/// lie beyond its horizon). Indices must be valid.
[[nodiscard]] HomographyFit refine_homography(const Eigen::Matrix3d& H_start,
                                              const PointMatches& matches,
                                              const std::vector<int>& which,
                                              const TransferNoise& noise, int max_iterations);

}  // namespace placegraph
