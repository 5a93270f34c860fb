#include <placegraph/pipeline/internal/local_map/lens_estimator.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {

void LensEstimator::observe(const SlidingWindow& window) {
  const auto keyframes = window.keyframes();
  if (keyframes.empty() || keyframes.front() <= newest_) return;
  newest_ = keyframes.back();
  add(lens_evidence(window.state()));
}

void LensEstimator::add(const DistortionEvidence& evidence) {
  if (evidence.information > 0) windows_.push_back(evidence);
}

double LensEstimator::k1() const {
  double gradient = 0, information = 0;
  for (const DistortionEvidence& window : windows_) {
    gradient += window.gradient;
    information += window.information;
  }
  return information > 0 ? -gradient / information : 0;
}

double LensEstimator::sigma_k1() const {
  constexpr double kWindows = 4;
  const double mean = k1();
  double information = 0, squares = 0, dispersion = 0;
  for (const DistortionEvidence& window : windows_) {
    const double off = -window.gradient / window.information - mean;
    information += window.information;
    squares += window.information * window.information;
    dispersion += window.information * off * off;
  }
  // A few windows with much information, such as curves between straight roads, do not count as
  // many.
  const double windows = windows_.empty() ? 0 : information * information / squares;
  if (windows < kWindows) return std::numeric_limits<double>::infinity();
  return std::sqrt(std::max(1.0, dispersion / (windows - 1)) / information);
}

double LensEstimator::effect() const {
  double information = 0, residuals = 0;
  for (const DistortionEvidence& window : windows_) {
    information += window.information;
    residuals += window.residuals;
  }
  return residuals > 0 ? std::abs(k1()) * std::sqrt(information / residuals) : 0;
}

}  // namespace placegraph
