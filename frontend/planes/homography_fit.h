#pragma once
#include <placegraph/graph/core/outcome.h>

#include <Eigen/Dense>
#include <array>
#include <limits>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Pixels of the same points in two views: px_ref[i] corresponds to px_cur[i].
struct PointMatches {
  std::vector<Eigen::Vector2d> px_ref, px_cur;
  int size() const { return static_cast<int>(px_ref.size()); }
};

/// Transfer error of one match under a homography.
///
/// The noise has equal variance in both views.
///
/// To first order e = px_cur - H px_ref has the covariance S = I + J J^T times that variance, J
/// being the derivative of the transfer (Hartley & Zisserman 2004, sec. 4.2.6: the Sampson error,
/// the first-order symmetric transfer error).
struct TransferError {
  Eigen::Vector2d residual;         ///< e [px]
  Eigen::Matrix2d unit_covariance;  ///< S
  double squared = 0;               ///< e^T S^-1 e [px^2]; infinite beyond the horizon
  double log_determinant = 0;       ///< log det S
};
/// Computes the transfer error of a match.
TransferError transfer_error(const Eigen::Matrix3d& H_cur_ref, const Eigen::Vector2d& px_ref,
                             const Eigen::Vector2d& px_cur);

/// Noise of matches on a plane: equal in both views, with heavy tails.
///
/// Such noise is typical of detectors, matchers and manual selection. The transfer error is
/// bivariate Student t about zero with scale matrix sigma^2 S and `freedom` degrees of freedom;
/// normal for an infinite `freedom`.
struct TransferNoise {
  double sigma_px = 1;
  double freedom = std::numeric_limits<double>::infinity();
  /// -log of the density of the transfer error [nats].
  double cost(const TransferError& error) const;
  /// Weight of its square in reweighted least squares: one for the normal distribution.
  double weight(const TransferError& error) const;
  /// Expected information of one match, as a share of that of a normal one with the same sigma
  /// (Lange, Little & Taylor 1989, "Robust statistical modeling using the t distribution").
  double information() const;
};

/// Homography through four matches.
///
/// No result if three of them are (nearly) collinear in a view or the four cannot be in front of
/// both cameras on one side of one plane (the orientation of a triangle changes).
std::optional<Eigen::Matrix3d> homography_through(const PointMatches& matches,
                                                  const std::array<int, 4>& which);

/// A homography with its uncertainty.
struct HomographyFit {
  Outcome outcome;
  /// Homography of Frobenius norm one, det > 0.
  Eigen::Matrix3d H_cur_ref = Eigen::Matrix3d::Identity();
  /// Covariance of the nine entries, row by row; of rank eight: it is zero along H itself.
  Eigen::Matrix<double, 9, 9> covariance = Eigen::Matrix<double, 9, 9>::Zero();
  double cost = 0;  ///< sum of the matches' costs under the noise [nats]
  int iterations = 0;
};

/// Refines `H_start` over the matches `which` on their symmetric transfer error.
///
/// Gauss-Newton, reweighted, in the eight directions orthogonal to H, with pixels centred and
/// scaled inside (Hartley 1997). Outcomes: too few data (under four matches), degenerate (the
/// matches do not determine a homography, or are beyond its horizon). Indices must be valid.
[[nodiscard]] HomographyFit refine_homography(const Eigen::Matrix3d& H_start,
                                              const PointMatches& matches,
                                              const std::vector<int>& which,
                                              const TransferNoise& noise, int max_iterations);

}  // namespace placegraph
