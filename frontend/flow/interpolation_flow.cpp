#include <placegraph/frontend/flow/interpolation_flow.h>
#include <placegraph/frontend/flow/optical_flow.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {

using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;

/// The linear system of one patch: differences of the copies shifted along u, along v and rotated,
/// and the grey values for the gain; all without their weighted mean, so that the offset is free.
struct InterpolationFlow::Patch {
  explicit Patch(Eigen::Index n) : grey(n), columns(n, 4), weighted(n, 4) {}
  Eigen::VectorXf grey;                                       ///< grey values of the first image
  Eigen::Matrix<float, Eigen::Dynamic, 4> columns, weighted;  ///< the latter times Psi, sums 0
  Matrix4d normal = Matrix4d::Identity();
};

InterpolationFlow::InterpolationFlow(const InterpolationFlowOptions& options) : options_(options) {
  options_.check();
  const int radius = options_.radius_px;
  const double sigma = options_.fwhm_px / 2.3548;
  weights_.resize((2 * radius + 1) * (2 * radius + 1));
  double sum = 0;
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      const double weight = std::exp(-(x * x + y * y) / (2 * sigma * sigma));
      weights_[(y + radius) * (2 * radius + 1) + x + radius] = static_cast<float>(weight);
      sum += weight;
      for (const int sign : {1, -1}) {
        const double c = std::cos(options_.rotation_rad),
                     s = sign * std::sin(options_.rotation_rad);
        const double u = c * x - s * y, v = s * x + c * y;
        const double u0 = std::floor(u), v0 = std::floor(v), a = u - u0, b = v - v0;
        (sign > 0 ? rotated_ : returned_)
            .push_back({static_cast<int>(v0), static_cast<int>(u0),
                        static_cast<float>((1 - a) * (1 - b)), static_cast<float>(a * (1 - b)),
                        static_cast<float>((1 - a) * b), static_cast<float>(a * b)});
      }
    }
  }
  weights_ /= static_cast<float>(sum);
}

PaddedPyramid InterpolationFlow::pyramid(const Image& grey) const {
  const int pad = static_cast<int>(std::ceil(1.5 * options_.radius_px)) + options_.shift_px + 2;
  return padded_pyramid(grey, options_.levels, pad);
}

void InterpolationFlow::reference(const Image& image, int u, int v, bool rotates,
                                  Patch& patch) const {
  const int radius = options_.radius_px, side = 2 * radius + 1, shift = options_.shift_px;
  const auto across = static_cast<float>(0.5 / shift);
  float *along_u = patch.columns.col(0).data(), *along_v = patch.columns.col(1).data();
  for (int y = 0; y < side; ++y) {
    const float* row = image.ptr<float>(v - radius + y) + u - radius;
    const float* above = image.ptr<float>(v - radius + y - shift) + u - radius;
    const float* below = image.ptr<float>(v - radius + y + shift) + u - radius;
    for (int x = 0; x < side; ++x) {
      const int i = y * side + x;
      patch.grey[i] = row[x];
      along_u[i] = across * (row[x - shift] - row[x + shift]);
      along_v[i] = across * (above[x] - below[x]);
    }
  }
  if (rotates) {
    const auto around = static_cast<float>(0.5 / options_.rotation_rad);
    const auto step = static_cast<std::ptrdiff_t>(image.step1());
    const float* centre = image.ptr<float>(v) + u;
    const auto at = [&](const Pixel& pixel) {
      const float* p = centre + pixel.row * step + pixel.column;
      return pixel.w00 * p[0] + pixel.w01 * p[1] + pixel.w10 * p[step] + pixel.w11 * p[step + 1];
    };
    // A copy rotated by +angle has at x the value of the patch at x rotated by -angle.
    for (int i = 0; i < side * side; ++i)
      patch.columns(i, 2) = around * (at(returned_[i]) - at(rotated_[i]));
  } else {
    patch.columns.col(2).setZero();
  }
  patch.columns.col(3) = patch.grey;
  const Eigen::RowVector4f means = weights_.transpose() * patch.columns;
  patch.columns.rowwise() -= means;
  patch.weighted = patch.columns.array().colwise() * weights_.array();
  patch.normal = (patch.columns.transpose() * patch.weighted).cast<double>();
  if (!rotates) patch.normal(2, 2) = 1;
}

/// Samples the rotated patch around `centre`; false if it leaves the padded image.
bool InterpolationFlow::sample(const Image& image, const Vector2d& centre, double rotation,
                               Eigen::VectorXf& values) const {
  const int radius = options_.radius_px;
  const double reach = radius * (std::abs(std::cos(rotation)) + std::abs(std::sin(rotation)));
  if (!(centre.x() >= reach && centre.y() >= reach && centre.x() + reach + 1 < image.cols &&
        centre.y() + reach + 1 < image.rows))
    return false;
  const auto c = static_cast<float>(std::cos(rotation)), s = static_cast<float>(std::sin(rotation));
  const int side = 2 * radius + 1;
  if (rotation == 0) {
    const int u0 = static_cast<int>(centre.x()), v0 = static_cast<int>(centre.y());
    const auto a = static_cast<float>(centre.x() - u0), b = static_cast<float>(centre.y() - v0);
    const float w00 = (1 - a) * (1 - b), w01 = a * (1 - b), w10 = (1 - a) * b, w11 = a * b;
    for (int y = 0; y < side; ++y) {
      const float* top = image.ptr<float>(v0 - radius + y) + u0 - radius;
      const float* bottom = image.ptr<float>(v0 - radius + y + 1) + u0 - radius;
      for (int x = 0; x < side; ++x)
        values[y * side + x] =
            w00 * top[x] + w01 * top[x + 1] + w10 * bottom[x] + w11 * bottom[x + 1];
    }
    return true;
  }
  const auto step = static_cast<std::ptrdiff_t>(image.step1());
  const auto u = static_cast<float>(centre.x()), v = static_cast<float>(centre.y());
  for (int y = -radius; y <= radius; ++y) {
    for (int x = -radius; x <= radius; ++x) {
      const float pu = u + c * static_cast<float>(x) - s * static_cast<float>(y);
      const float pv = v + s * static_cast<float>(x) + c * static_cast<float>(y);
      const int u0 = static_cast<int>(pu), v0 = static_cast<int>(pv);
      const float a = pu - static_cast<float>(u0), b = pv - static_cast<float>(v0);
      const float* p = image.ptr<float>(v0) + u0;
      values[(y + radius) * side + x + radius] =
          (1 - b) * ((1 - a) * p[0] + a * p[1]) + b * ((1 - a) * p[step] + a * p[step + 1]);
    }
  }
  return true;
}

/// Corrects the motion of a patch by one level's images until a step is shorter than `epsilon_px`;
/// false where the patch leaves the padded image.
bool InterpolationFlow::follow(const Patch& patch, const Image& image, const Vector2d& centre,
                               bool rotates, double epsilon_px, PatchMotion& motion) const {
  thread_local Eigen::VectorXf seen;
  if (seen.size() != weights_.size()) seen.resize(weights_.size());
  const Eigen::LDLT<Matrix4d> solver(patch.normal);
  for (int i = 0; i < options_.iterations; ++i) {
    // The copies represent so small a rotation; the pixels need not be sampled again.
    constexpr double kHardlyRotated = 0.01;
    const double angle = std::abs(motion.rotation) < kHardlyRotated ? 0 : motion.rotation;
    if (!sample(image, centre + motion.shift, angle, seen)) return false;
    seen -= patch.grey;
    const Vector4d b = (patch.weighted.transpose() * seen).cast<double>();
    const float mean = weights_.dot(seen);
    const double square = weights_.dot(seen.cwiseAbs2()) - mean * mean;
    const Vector4d step = solver.solve(b);
    motion.gain = 1 + step[3];
    motion.residual = std::sqrt(std::max(0.0, square - step.dot(b)));
    const double c = std::cos(angle), s = std::sin(angle);
    motion.shift += Vector2d(c * step[0] - s * step[1], s * step[0] + c * step[1]);
    if (rotates) motion.rotation = angle + step[2];
    if (step.head<2>().norm() < epsilon_px) break;
  }
  return true;
}

std::optional<PatchMotion> InterpolationFlow::measure(const PaddedPyramid& from,
                                                      const PaddedPyramid& to,
                                                      const Vector2d& px) const {
  thread_local Patch patch(0);
  if (patch.grey.size() != weights_.size()) patch = Patch(weights_.size());
  constexpr double kCoarseEnough_px = 0.1;  // on coarse levels, for the next
  PatchMotion motion;
  for (int level = static_cast<int>(from.levels.size()) - 1; level >= 0; --level) {
    const double scale = std::ldexp(1.0, -level);
    const int u = static_cast<int>(std::lround(px.x() * scale));
    const int v = static_cast<int>(std::lround(px.y() * scale));
    if (u < 0 || v < 0 || u >= from.width_at(level) || v >= from.height_at(level))
      return std::nullopt;
    const bool rotates = options_.rotates && level == 0;
    reference(from.levels[level], u + from.pad, v + from.pad, rotates, patch);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(
        Eigen::Matrix2d(patch.normal.topLeftCorner<2, 2>()), Eigen::EigenvaluesOnly);
    if (!(eigen.eigenvalues()[0] >= options_.min_eigenvalue * 255 * 255)) {
      if (level == 0) return std::nullopt;
      motion.shift *= 2;
      continue;
    }
    if (!follow(patch, to.levels[level], Vector2d(u + from.pad, v + from.pad), rotates,
                level > 0 ? kCoarseEnough_px : options_.epsilon_px, motion))
      return std::nullopt;
    if (level > 0) motion.shift *= 2;
  }
  // Beyond the range of the references on all levels, interpolation is invalid.
  const bool bracketed =
      std::abs(motion.rotation) <= 3 * options_.rotation_rad && std::abs(motion.gain - 1) < 0.7;
  if (!bracketed || !(motion.residual <= options_.max_residual * 255)) return std::nullopt;
  const Vector2d end = px + motion.shift;
  if (!(end.minCoeff() >= 0 && end.x() <= to.width - 1 && end.y() <= to.height - 1))
    return std::nullopt;
  // The Gaussian weights halve the effective number of pixels; neighbours are correlated: about one
  // in four is independent.
  constexpr double kPixelsPerSample = 4;
  const double sigma = options_.fwhm_px / 2.3548, samples = 4 * 3.14159265 * sigma * sigma;
  motion.covariance =
      (patch.normal.inverse() * (kPixelsPerSample / samples * motion.residual * motion.residual))
          .topLeftCorner<3, 3>();
  if (!options_.rotates) motion.covariance.row(2).setZero(), motion.covariance.col(2).setZero();
  return motion;
}

std::vector<FlowVector> interpolation_flow(const Image& from, const Image& to,
                                           const std::vector<Vector2d>& points,
                                           const InterpolationFlowOptions& options) {
  const InterpolationFlow method(options);
  require(from.size() == to.size(), "interpolation_flow: the images differ in size");
  const PaddedPyramid a = method.pyramid(from), b = method.pyramid(to);
  std::vector<FlowVector> flow;
  flow.reserve(points.size());
  for (const Vector2d& point : points) {
    FlowVector vector;
    vector.px = point.array().round();
    if (const auto motion = method.measure(a, b, vector.px)) {
      vector.kind = FlowVector::Kind::kFull;
      vector.flow = motion->shift;
      vector.covariance = motion->covariance.topLeftCorner<2, 2>();
    }
    flow.push_back(vector);
  }
  return flow;
}

}  // namespace placegraph
