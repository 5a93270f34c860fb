#pragma once
#include <placegraph/frontend/align/gradient_alignment.h>

#include <optional>

namespace placegraph {

/// Covariance of an alignment and the noise that it was computed from.
struct AlignmentCovariance {
  Eigen::MatrixXd covariance;  ///< dof x dof, covariance of the warp's right tangent
  double sigma_grey = 0;       ///< standard deviation of the residuals [grey levels]
  double independent_share =
      1;  ///< share of independent samples: tr(sigma^2 H^-1) / tr(covariance)
};

/// Covariance of an alignment from its normal equations, with correlated residuals.
///
/// Residuals of neighbours are correlated (by the lens, the interpolation and model errors), so the
/// covariance is H^-1 M H^-1 with H = sum psi'(e_i) J_i J_i^T and M = sum c(i - j) J_i J_j^T over
/// samples up to four grid steps apart, where c is the measured covariance of psi(e) by lag (after
/// Conley 1999; Huber's sandwich for robust weights). It is never below a tenth of the covariance
/// for independent samples. J has the mean gradient of both images with gain and bias projected
/// out. Grey values are rounded, so residuals are at least a rounding error. Nothing if H is
/// singular. Precondition: samples in view.
std::optional<AlignmentCovariance> alignment_covariance(const PlanarTemplate& planar_template,
                                                        const Image& image, int level,
                                                        const PlanarWarp& warp,
                                                        const GradientAlignmentOptions& options);

/// Standard deviation of the most uncertain corner as predicted from the template alone.
///
/// In pixels of the current image, for independent residuals of `sigma_grey`; infinite if the
/// template has too little texture for the warp's degrees of freedom.
double promised_corner_sigma_px(const PlanarTemplate& planar_template, int level,
                                const PlanarWarp& warp, double sigma_grey);

/// Standard deviation of the most uncertain corner for a covariance [px of the current image].
double corner_sigma_px(const PlanarTemplate& planar_template, const PlanarWarp& warp,
                       const Eigen::MatrixXd& covariance);

}  // namespace placegraph
