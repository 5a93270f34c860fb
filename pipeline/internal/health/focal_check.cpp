#include <fmt/format.h>
#include <placegraph/backend/internal/window/window_state.h>
#include <placegraph/pipeline/internal/health/focal_check.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {

FocalCheck::FocalCheck(const Calibration& calibration)
    : camera_(calibration.camera), depths_measured_(calibration.depth.has_value()) {}

void FocalCheck::add(const WindowState& window) { add(focal_evidence(window, depths_measured_)); }

void FocalCheck::add(const FocalEvidence& evidence) {
  if (evidence.information(0, 0) > 0) windows_.push_back(evidence);
}

/// All windows, with the prior that images without distortion have a small k1.
FocalEvidence FocalCheck::sum() const {
  constexpr double kSigmaK1 = 0.05;
  FocalEvidence sum;
  sum.information(1, 1) = 1 / (kSigmaK1 * kSigmaK1);
  for (const FocalEvidence& window : windows_) {
    sum.gradient += window.gradient;
    sum.information += window.information;
  }
  return sum;
}

FocalCheck::Estimate FocalCheck::estimate() const {
  // Each window has an error of its own beside that of its noise: recordings showed 0.4 to 3 %.
  constexpr double kWindowError = 0.02;
  Estimate estimate{0, std::numeric_limits<double>::infinity()};
  if (windows_.empty()) return estimate;
  const FocalEvidence all = sum();
  const Eigen::Matrix2d covariance = all.information.inverse();
  const double k1 = -(covariance * all.gradient)[1];
  const double inflation = covariance(0, 0) * all.information(0, 0);  // by the unknown k1
  double weights = 0, errors = 0, squares = 0;
  for (const FocalEvidence& window : windows_) {
    const double information = window.information(0, 0);
    const double error = -(window.gradient[0] + window.information(0, 1) * k1) / information;
    const double weight = 1 / (inflation / information + kWindowError * kWindowError);
    weights += weight;
    errors += weight * error;
    squares += weight * error * error;
  }
  estimate.error = errors / weights;
  const double dispersion = squares - weights * estimate.error * estimate.error;
  const double freedom = std::max(1.0, static_cast<double>(windows_.size()) - 1);
  estimate.sigma = std::sqrt(std::max(1.0, dispersion / freedom) / weights);
  return estimate;
}

std::optional<DataNote> FocalCheck::note() const {
  // Tracks that slide along edges bias all windows in the same way, by about a per cent.
  constexpr double kSigmaBias = 0.01, kSigmas = 3.5;
  const Estimate found = estimate();
  const double error = found.error, sigma = std::hypot(found.sigma, kSigmaBias);
  if (!(std::abs(error) > kSigmas * sigma)) return std::nullopt;
  return DataNote{
      fmt::format("the points of {} stretches fit a focal length that is {:.1f} % +- {:.1f} % {} "
                  "than fx = {:g} px",
                  windows_.size(), 100 * std::abs(error), 100 * sigma,
                  error > 0 ? "longer" : "shorter", camera_.fx),
      true, NoteCause::kCalibration,
      "calibrate the camera; fx and fy must be those of images of this size"};
}

}  // namespace placegraph
