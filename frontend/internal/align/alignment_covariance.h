#pragma once
#include <placegraph/frontend/internal/align/gradient_alignment.h>

#include <optional>

namespace placegraph {

struct AlignmentCovariance {
  Eigen::MatrixXd covariance;    ///< dof x dof, of the warp's right tangent
  double sigma_grey = 0;         ///< of the residuals
  double independent_share = 1;  ///< of the samples: sigma^2 H^-1 over the covariance, by trace
};

/// Covariance of an alignment from its normal equations, where the residuals of neighbours are
/// correlated (by the lens, the interpolation, whatever the model leaves out): H^-1 M H^-1 with
/// H = sum psi'(e_i) J_i J_i^T and M = sum c(i - j) J_i J_j^T over samples up to four grid steps
/// apart, c the measured covariance of psi(e) by lag (after Conley 1999; Huber's sandwich for
/// robust weights), never below a tenth of what independent samples would give. J has the mean
/// gradient of both images with gain and bias projected out. Grey values are rounded, so residuals
/// count as no smaller than a rounding error. Nothing where H is singular. Precondition: samples in
/// view.
std::optional<AlignmentCovariance> alignment_covariance(const PlanarTemplate& planar_template,
                                                        const Image& image, int level,
                                                        const PlanarWarp& warp,
                                                        const GradientAlignmentOptions& options);

/// What the template alone promises: the standard deviation [px of the current image] of its most
/// uncertain corner if residuals of `sigma_grey` were independent; infinite where it has too little
/// texture for the warp's degrees of freedom.
double promised_corner_sigma_px(const PlanarTemplate& planar_template, int level,
                                const PlanarWarp& warp, double sigma_grey);

/// The same for a covariance.
double corner_sigma_px(const PlanarTemplate& planar_template, const PlanarWarp& warp,
                       const Eigen::MatrixXd& covariance);

}  // namespace placegraph
