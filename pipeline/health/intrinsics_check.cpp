#include <fmt/format.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/pipeline/health/intrinsics_check.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

using Evidence = IntrinsicsEvidence;
using Vector = IntrinsicsEvidence::Vector;
using Matrix = IntrinsicsEvidence::Matrix;

/// Standard deviations in the order of the parameters.
Vector sigmas(double focal, double aspect, double principal_x, double principal_y, double radial,
              double depth_offset_m) {
  Vector result;
  result << focal, aspect, principal_x, principal_y, radial, depth_offset_m;
  return result;
}

/// Expected errors of a calibration that nobody doubts; nearly none for the focal length.
Vector prior_sigmas() { return sigmas(0.2, 0.01, 0.03, 0.03, 0.1, 1); }
/// Each window has errors of its own beside those of its noise: recordings showed these.
Vector window_sigmas() { return sigmas(0.02, 0.02, 0.015, 0.02, 0.02, 0.05); }
/// What biases all windows in the same way: noise and tracks that slide along edges make the focal
/// length appear up to three per cent shorter.
Vector bias_sigmas() { return sigmas(0.015, 0.01, 0.005, 0.01, 0.01, 0.05); }

/// The evidence of a window whose own errors are marginalized.
Evidence with_own_errors(const Evidence& window) {
  const Vector own = window_sigmas().cwiseAbs2().cwiseInverse();
  Matrix sum = window.information;
  sum.diagonal() += own;
  const Matrix kept = Matrix::Identity() - window.information * sum.inverse();
  Evidence result;
  result.gradient = kept * window.gradient;
  result.information = kept * window.information;
  return result;
}

/// Squared difference of a window's estimate and q, in its covariance; directions of which the
/// window has no information are left out. Adds their number to `freedom`.
double difference2(const Evidence& window, const Vector& q, double& freedom) {
  constexpr double kNothing = 1e-6;  // share of the largest eigenvalue
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(window.information);
  const Vector gradient =
      eigen.eigenvectors().transpose() * (window.gradient + window.information * q);
  double sum = 0;
  for (Eigen::Index i = 0; i < gradient.size(); ++i) {
    const double lambda = eigen.eigenvalues()[i];
    if (!(lambda > kNothing * eigen.eigenvalues().maxCoeff())) continue;
    sum += gradient[i] * gradient[i] / lambda;
    freedom += 1;
  }
  return sum;
}

/// What the points fit instead of what is stated.
std::string fit_text(Eigen::Index parameter, double error, double sigma, const Camera& camera) {
  const auto amount = [&](double scale, const char* unit) {
    return fmt::format("{:.2g}{} +- {:.1g}{}", scale * std::abs(error), unit, scale * sigma, unit);
  };
  switch (parameter) {
    case Evidence::kFocal:
      return fmt::format("a focal length that is {} {} than the stated one", amount(100, " %"),
                         error > 0 ? "longer" : "shorter");
    case Evidence::kAspect:
      return fmt::format("a ratio of fx to fy that is {} {} than the stated one", amount(100, " %"),
                         error > 0 ? "larger" : "smaller");
    case Evidence::kPrincipalX:
      return fmt::format("a principal point {} {} of the stated one", amount(camera.fx, " px"),
                         error > 0 ? "right" : "left");
    case Evidence::kPrincipalY:
      return fmt::format("a principal point {} {} the stated one", amount(camera.fy, " px"),
                         error > 0 ? "below" : "above");
    case Evidence::kRadial:
      return fmt::format("a radial distortion k1 of {:.2g} +- {:.1g} that is not stated", error,
                         sigma);
    default:
      return fmt::format("depths that are {} too {}", amount(1, " m"),
                         error > 0 ? "large" : "small");
  }
}

}  // namespace

IntrinsicsCheck::IntrinsicsCheck(const Calibration& calibration)
    : camera_(calibration.camera), depths_measured_(calibration.depth.has_value()) {}

void IntrinsicsCheck::add(const WindowState& window) {
  add(intrinsics_evidence(window, depths_measured_));
}

void IntrinsicsCheck::add(const IntrinsicsEvidence& evidence) {
  if (evidence.information.trace() > 0) windows_.push_back(evidence);
}

IntrinsicsCheck::Estimate IntrinsicsCheck::estimate() const {
  Estimate estimate;
  estimate.errors.setZero();
  estimate.sigmas.setConstant(std::numeric_limits<double>::infinity());
  if (windows_.empty()) return estimate;
  std::vector<Evidence> windows;
  Evidence sum;
  sum.information.diagonal() = prior_sigmas().cwiseAbs2().cwiseInverse();
  for (const Evidence& window : windows_) {
    windows.push_back(with_own_errors(window));
    sum.gradient += windows.back().gradient;
    sum.information += windows.back().information;
  }
  const Matrix covariance = sum.information.inverse();
  estimate.errors = -covariance * sum.gradient;
  double dispersion = 0, freedom = -static_cast<double>(Evidence::kParameters);
  for (const Evidence& window : windows)
    dispersion += difference2(window, estimate.errors, freedom);
  estimate.dispersion = dispersion / std::max(1.0, freedom);
  estimate.sigmas =
      (std::max(1.0, estimate.dispersion) * covariance.diagonal() + bias_sigmas().cwiseAbs2())
          .cwiseSqrt();
  return estimate;
}

std::vector<DataNote> IntrinsicsCheck::notes() const {
  // Deviations that are reported (docs/datasets.md); windows that contradict each other by twice
  // theirs, whose squares are 4. Chosen by the faults of group "fixed" (tests/faults/README.md).
  constexpr double kSigmas = 2.8, kMostDispersion = 4;
  constexpr std::size_t kFewest = 3;  // windows that can contradict each other
  std::vector<DataNote> notes;
  const Estimate found = estimate();
  Eigen::Index worst = 0;
  if (found.errors.cwiseQuotient(found.sigmas).cwiseAbs().maxCoeff(&worst) > kSigmas) {
    const bool depths = worst == Evidence::kDepthOffset;
    notes.push_back(
        {fmt::format("the points of {} stretches fit {}", windows_.size(),
                     fit_text(worst, found.errors[worst], found.sigmas[worst], camera_)),
         true, depths ? NoteCause::kDepthUnit : NoteCause::kCalibration,
         depths ? "compare depths with distances that were measured otherwise"
                : "calibrate the camera; its intrinsics must be those of images of this size"});
  }
  if (windows_.size() >= kFewest && found.dispersion > kMostDispersion)
    notes.push_back(
        {fmt::format("{} stretches of the motion fit intrinsics that differ by {:.1f} times their "
                     "deviations: a rolling shutter, or points that move",
                     windows_.size(), std::sqrt(found.dispersion)),
         false, NoteCause::kDrift, "look for what moves or covers the view; --mask leaves it out"});
  return notes;
}

}  // namespace placegraph
