#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/local_map/lens_stretches.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Standard deviation of k1 of cameras that are taken for undistorted.
constexpr double kPriorSigma = 0.1;
/// Standard deviation of the error of a stretch, however many points it has, and the degrees of
/// freedom to which it is known. Recordings of rectified cameras showed 0.003 to 0.011.
constexpr double kStretchSigma = 0.008;
constexpr double kStretchFreedom = 3;
/// Standard deviation of the error that all stretches share, such as that of a camera that always
/// moves forward.
constexpr double kCommonSigma = 0.003;

double information_of_prior() { return 1 / (kPriorSigma * kPriorSigma); }

bool similar(const WindowMotion& a, const WindowMotion& b) {
  // Rotations within which two windows see the same with the same errors. Chosen.
  constexpr double kView_deg = 30, kMotion_deg = 45, kRotation_deg = 20;
  const auto within = [](const SO3& R_a, const SO3& R_b, double limit_deg) {
    return (R_a.inverse() * R_b).log().norm() < deg_to_rad(limit_deg);
  };
  return within(a.R_map_cam, b.R_map_cam, kView_deg) &&
         within(a.R_first_last, b.R_first_last, kRotation_deg) &&
         a.direction_cam.dot(b.direction_cam) > std::cos(deg_to_rad(kMotion_deg));
}

}  // namespace

void LensStretches::add(const DistortionEvidence& evidence, const WindowMotion& motion) {
  const auto stretch = std::ranges::find_if(stretches_, [&](const Stretch& s) {
    return s.motion && evidence.information > 0 && similar(*s.motion, motion);
  });
  if (stretch == stretches_.end()) {
    add(evidence);
    if (evidence.information > 0) stretches_.back().motion = motion;
    return;
  }
  stretch->evidence.gradient += evidence.gradient;
  stretch->evidence.information += evidence.information;
  stretch->evidence.residuals += evidence.residuals;
}

void LensStretches::add(const DistortionEvidence& evidence) {
  if (evidence.information > 0) stretches_.push_back({std::nullopt, evidence});
}

double LensStretches::linearization() const {
  double gradient = 0, information = information_of_prior();
  for (const auto& [motion, evidence] : stretches_) {
    gradient += evidence.gradient;
    information += evidence.information;
  }
  const double k1 = -gradient / information;
  return std::abs(k1) > std::max(2 / std::sqrt(information), kStretchSigma) ? k1 : 0;
}

double LensStretches::variance_between() const {
  double sum = 0, squares = 0, mean = 0;
  for (const auto& [motion, evidence] : stretches_) {
    sum += evidence.information;
    squares += evidence.information * evidence.information;
    mean -= evidence.gradient;
  }
  const double freedom = static_cast<double>(stretches_.size()) - 1;
  double dispersion = -freedom;
  for (const auto& [motion, evidence] : stretches_)
    dispersion +=
        evidence.information * std::pow(evidence.gradient / evidence.information + mean / sum, 2);
  const double spread = sum - squares / sum;
  const double seen = spread > 0 ? std::max(0.0, dispersion / spread) : 0;
  return (kStretchFreedom * kStretchSigma * kStretchSigma + freedom * seen) /
         (kStretchFreedom + freedom);
}

LensDistortion LensStretches::estimate() const {
  LensDistortion result;
  if (stretches_.empty()) return result;
  const double between = variance_between();
  double weights = 0, squares = 0, mean = 0, information = 0, residuals = 0;
  for (const auto& [motion, evidence] : stretches_) {
    const double weight = 1 / (1 / evidence.information + between);
    weights += weight;
    squares += weight * weight;
    mean -= weight * evidence.gradient / evidence.information;
    information += evidence.information;
    residuals += evidence.residuals;
  }
  result.k1 = mean / (weights + information_of_prior());
  result.effect = residuals > 0 ? std::abs(result.k1) * std::sqrt(information / residuals) : 0;
  // Stretches that saw little do not count as many.
  result.stretches = weights * weights / squares;
  // The variance of Student's distribution: that between the stretches is uncertain itself.
  const double freedom = kStretchFreedom + result.stretches - 1;
  result.sigma_k1 = std::hypot(
      std::sqrt(freedom / (freedom - 2) / (weights + information_of_prior())), kCommonSigma);
  return result;
}

}  // namespace placegraph
