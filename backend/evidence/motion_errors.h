#pragma once
#include <placegraph/backend/evidence/nuisance_evidence.h>
#include <placegraph/backend/window/imaging_errors.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/se3.h>

namespace placegraph {

class SlidingWindow;

/// Errors of the motion between two keyframes of a window, in the right tangent of T_from_to, from
/// the images of the window without its prior.
struct MotionErrors {
  Matrix6d stated;   ///< covariance if the observations are independent and as noisy as stated
  Matrix6d scatter;  ///< the same by the residuals, which may be correlated along a track
  /// Derivative of the estimate's error by the imaging errors.
  Eigen::Matrix<double, 6, ImagingErrors::kParameters> by_imaging_errors;
};
/// `scatter` is the sandwich estimator with one cluster per landmark (White 1982; Liang and Zeger
/// 1986). Throws ArgumentError for keyframes that are not in the window, or the same.
MotionErrors motion_errors(const SlidingWindow& window, KeyframeId from, KeyframeId to);

/// `covariance` of the same motion, which was computed as `errors.stated` but with more
/// information, changed as `errors.scatter` differs from `errors.stated`. No direction is given
/// less than `least` of its variance.
Matrix6d rescaled_by_scatter(const Matrix6d& covariance, const MotionErrors& errors, double least);

/// Evidence of the imaging errors in a window.
NuisanceEvidence imaging_evidence(const SlidingWindow& window);

}  // namespace placegraph
