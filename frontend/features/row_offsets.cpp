#include <placegraph/frontend/features/matcher.h>
#include <placegraph/frontend/features/row_offsets.h>
#include <placegraph/graph/core/ransac.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

Vector5d terms(const Eigen::Vector2d& ray) {
  return {1, ray.x(), ray.y(), ray.x() * ray.y(), ray.y() * ray.y()};
}

// Distance of an inlier from its row. Chosen.
constexpr double kInlierPx = 2;

/// Constant, x and y terms through three samples.
std::vector<Vector5d> through(const std::vector<RowSample>& samples,
                              const std::vector<int>& sample) {
  Eigen::Matrix3d A;
  Eigen::Vector3d b;
  for (int k = 0; k < 3; ++k) {
    const RowSample& s = samples[static_cast<std::size_t>(sample[static_cast<std::size_t>(k)])];
    A.row(k) << 1, s.ray.x(), s.ray.y();
    b[k] = s.rows;
  }
  const Eigen::ColPivHouseholderQR<Eigen::Matrix3d> qr(A);
  if (qr.rank() < 3) return {};
  Vector5d model = Vector5d::Zero();
  model.head<3>() = qr.solve(b);
  return {model};
}

/// Least squares over some samples with Cauchy weights about `about`; the prior standard deviation
/// of every coefficient is about ten pixels.
Vector5d weighed_fit(const std::vector<RowSample>& samples, const std::vector<int>& some,
                     const Vector5d& about) {
  // A weak prior that no offset contradicts. Chosen.
  constexpr double kPriorSigmaPx = 10;
  Matrix5d information = Matrix5d::Identity() / (kPriorSigmaPx * kPriorSigmaPx);
  Vector5d right = Vector5d::Zero();
  for (const int i : some) {
    const RowSample& s = samples[static_cast<std::size_t>(i)];
    const Vector5d t = terms(s.ray);
    const double error = (s.rows - t.dot(about)) / s.sigma_px;
    const double weight = 1 / (s.sigma_px * s.sigma_px * (1 + error * error));
    information += weight * t * t.transpose();
    right += weight * s.rows * t;
  }
  return information.ldlt().solve(right);
}

}  // namespace

std::vector<RowSample> row_samples(const Camera& camera, const std::vector<Feature>& left,
                                   const std::vector<Feature>& right, double band_px) {
  // Noise of a feature on the finest level, and its growth by level. Chosen; the latter is that of
  // the detector.
  constexpr double kSigmaPx = 0.7, kScaleOfOctave = 1.3;
  std::vector<RowSample> samples;
  for (const double side : {1.0, -1.0}) {
    const SE3 T_left_right(SO3(), Eigen::Vector3d(side, 0, 0));
    for (const FeatureMatch& match :
         match_epipolar(camera, left, right, T_left_right, band_px, {})) {
      const Feature& a = left[static_cast<std::size_t>(match.a)];
      const Feature& b = right[static_cast<std::size_t>(match.b)];
      const Eigen::Vector2d px = a.px.cast<double>();
      const auto ray = camera.unproject(px);
      if (!ray) continue;
      samples.push_back({ray->head<2>(), b.px.y() - px.y(), px.x() - b.px.x(),
                         kSigmaPx * std::pow(kScaleOfOctave, std::max(a.octave, b.octave))});
    }
  }
  return samples;
}

RowOffsets fit_row_offsets(const std::vector<RowSample>& samples, Random& random) {
  RowOffsets result;
  result.matches = static_cast<int>(samples.size());
  const auto error = [&](const Vector5d& model, int i) {
    const RowSample& s = samples[static_cast<std::size_t>(i)];
    return (s.rows - terms(s.ray).dot(model)) / s.sigma_px;
  };
  const RansacOptions options{.max_iterations = 500, .confidence = 0.999, .min_inliers = 30};
  const auto found = ransac<Vector5d>(
      result.matches, 3, kInlierPx * kInlierPx, options, random,
      [&](const std::vector<int>& sample) { return through(samples, sample); },
      [&](const Vector5d& model, int i) { return error(model, i) * error(model, i); },
      [&](const Vector5d& model, const std::vector<int>& inliers) {
        return weighed_fit(samples, inliers, model);
      });
  result.outcome = found.outcome;
  result.inliers = static_cast<int>(found.inliers.size());
  if (!result.outcome) return result;
  std::copy_n(found.model.data(), result.rows.size(), result.rows.begin());
  double squared = 0;
  for (const int i : found.inliers) {
    const RowSample& s = samples[static_cast<std::size_t>(i)];
    squared += result.at(s.ray) * result.at(s.ray);
    result.behind += s.disparity_px < -kInlierPx;
  }
  result.rms_px = std::sqrt(squared / result.inliers);
  return result;
}

}  // namespace placegraph
