#include <placegraph/frontend/features/rectification.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector4d;

/// Derivative of a measured disparity with respect to scale, offset, by_x, by_y.
Vector4d row_of(const DisparitySample& s) { return {s.from_motion_px, 1, s.ray.x(), s.ray.y()}; }

/// Normal equations of a batch.
struct Batch {
  Matrix4d information = Matrix4d::Zero();
  Vector4d right = Vector4d::Zero();
};

/// Cauchy weights about `state`, relative to the scatter of the samples: their sigmas may be too
/// small.
Batch weigh(const std::vector<DisparitySample>& samples, const Vector4d& state) {
  // Width of the kernel [standard deviations]. Chosen.
  constexpr double kWidth = 2;
  std::vector<double> errors, magnitudes;
  for (const DisparitySample& s : samples) {
    errors.push_back((s.measured_px - row_of(s).dot(state)) / s.sigma_px);
    magnitudes.push_back(std::abs(errors.back()));
  }
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  const double spread = std::max(1.0, 1.4826 * *middle);
  Batch batch;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double sigma = spread * samples[i].sigma_px, scaled = errors[i] / (kWidth * spread);
    const double weight = 1 / (sigma * sigma * (1 + scaled * scaled));
    const Vector4d row = row_of(samples[i]);
    batch.information += weight * row * row.transpose();
    batch.right += weight * samples[i].measured_px * row;
  }
  return batch;
}

}  // namespace

RectificationEstimator::RectificationEstimator(const RectificationOptions& options)
    : options_(options), state_(1, 0, 0, 0) {
  options_.check();
  const double prior = options.prior_sigma_px * options.prior_sigma_px;
  covariance_ =
      Vector4d(options.scale_sigma * options.scale_sigma, prior, prior, prior).asDiagonal();
}

void RectificationEstimator::add(const std::vector<DisparitySample>& samples) {
  for (const DisparitySample& s : samples)
    require(s.sigma_px > 0 && std::isfinite(s.measured_px) && std::isfinite(s.from_motion_px),
            "RectificationEstimator::add: finite disparities with a positive sigma needed");
  if (samples.empty()) return;
  covariance_(0, 0) += options_.scale_drift * options_.scale_drift;
  const Matrix4d prior = covariance_.inverse();
  const Vector4d predicted = state_;
  // The error common to a batch increases its covariance: (information^-1 + common)^-1, of any
  // rank.
  const double variance = options_.batch_sigma_px * options_.batch_sigma_px;
  const Matrix4d common = Vector4d(0, variance, variance, variance).asDiagonal();
  // Iterations at most. Chosen.
  constexpr int kIterations = 10;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Batch batch = weigh(samples, state_);
    const Eigen::PartialPivLU<Matrix4d> widen(Matrix4d::Identity() + batch.information * common);
    covariance_ = (prior + widen.solve(batch.information)).inverse();
    const Vector4d next = covariance_ * (prior * predicted + widen.solve(batch.right));
    const double change = (next - state_).norm();
    state_ = next;
    if (change < 1e-7) break;
  }
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
}

}  // namespace placegraph
