#include <placegraph/frontend/flow/optical_flow.h>
#include <placegraph/frontend/flow/padded_pyramid.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace placegraph {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Kind = FlowVector::Kind;

/// Grey values and gradients of one image on all levels.
struct Gradients {
  PaddedPyramid grey;
  std::vector<Image> du, dv;  // CV_32FC1, Scharr's, per pixel
};

Gradients gradients_of(const Image& image, const LucasKanadeOptions& options) {
  Gradients all{padded_pyramid(image, options.levels, options.window_px), {}, {}};
  for (const Image& level : all.grey.levels) {
    Image du, dv;
    cv::Scharr(level, du, CV_32F, 1, 0, 1. / 32);
    cv::Scharr(level, dv, CV_32F, 0, 1, 1. / 32);
    all.du.push_back(du);
    all.dv.push_back(dv);
  }
  return all;
}

/// The columns and rows of a window that are on the image and not in its padding.
struct Part {
  int from_x = 0, to_x = 0, from_y = 0, to_y = 0;
  int count() const { return (to_x - from_x) * (to_y - from_y); }
};

/// Part of a window at (u, v) that is on an image with a padding of `pad` pixels; a pixel
/// interpolated from the padding is not part of it.
Part part_inside(const Image& image, int pad, int radius, double u, double v) {
  const auto clamped = [&](double value) {
    return std::clamp(static_cast<int>(value), 0, 2 * radius + 1);
  };
  Part part;
  part.from_x = clamped(pad - (std::floor(u) - radius));
  part.from_y = clamped(pad - (std::floor(v) - radius));
  part.to_x = std::max(part.from_x, clamped(image.cols - pad - (std::ceil(u) - radius)));
  part.to_y = std::max(part.from_y, clamped(image.rows - pad - (std::ceil(v) - radius)));
  return part;
}

/// A square window of an image around a point between its pixels.
class Window {
 public:
  Window(int radius) : radius_(radius), side_(2 * radius + 1), values_(side_ * side_) {}

  /// Samples bilinearly; false if the window leaves the padded image.
  bool read(const Image& image, double u, double v) {
    const int u0 = static_cast<int>(std::floor(u)), v0 = static_cast<int>(std::floor(v));
    if (u0 < radius_ || v0 < radius_ || u0 + radius_ + 1 >= image.cols ||
        v0 + radius_ + 1 >= image.rows)
      return false;
    const auto a = static_cast<float>(u - u0), b = static_cast<float>(v - v0);
    const float w00 = (1 - a) * (1 - b), w01 = a * (1 - b), w10 = (1 - a) * b, w11 = a * b;
    for (int y = 0; y < side_; ++y) {
      const float* top = image.ptr<float>(v0 - radius_ + y) + u0 - radius_;
      const float* bottom = image.ptr<float>(v0 - radius_ + y + 1) + u0 - radius_;
      float* out = values_.data() + y * side_;
      for (int x = 0; x < side_; ++x)
        out[x] = w00 * top[x] + w01 * top[x + 1] + w10 * bottom[x] + w11 * bottom[x + 1];
    }
    return true;
  }
  void set_difference(const Window& a, const Window& b) {
    for (int i = 0; i < size(); ++i) values_[i] = a.values_[i] - b.values_[i];
  }
  void clear_outside(const Part& part) {
    if (part.count() == size()) return;
    for (int y = 0; y < side_; ++y) {
      float* row = values_.data() + y * side_;
      const bool within = y >= part.from_y && y < part.to_y;
      std::fill(row, row + (within ? part.from_x : side_), 0.f);
      std::fill(row + (within ? part.to_x : side_), row + side_, 0.f);
    }
  }
  const float* data() const { return values_.data(); }
  int size() const { return side_ * side_; }

 private:
  int radius_, side_;
  std::vector<float> values_;
};

float dot(const float* a, const float* b, int n) {
  // Independent partial sums, so that vector instructions can be used.
  float sums[8] = {};
  int i = 0;
  for (; i + 8 <= n; i += 8)
    for (int k = 0; k < 8; ++k) sums[k] += a[i + k] * b[i + k];
  float sum = 0;
  for (; i < n; ++i) sum += a[i] * b[i];
  for (const float s : sums) sum += s;
  return sum;
}

/// Sums of (template - window) times itself and both gradients.
struct Mismatch {
  double square = 0;
  Vector2d along_gradient = Vector2d::Zero();
};

class Follower {
 public:
  explicit Follower(const LucasKanadeOptions& options)
      : options_(options),
        template_(options.window_px / 2),
        du_(options.window_px / 2),
        dv_(options.window_px / 2),
        window_(options.window_px / 2),
        difference_(options.window_px / 2) {}

  FlowVector follow(const Gradients& from, const Gradients& to, const Vector2d& px,
                    const Vector2d& guess) {
    FlowVector result;
    result.px = px;
    const int coarsest = static_cast<int>(from.grey.levels.size()) - 1;
    Vector2d flow = guess / std::ldexp(1.0, coarsest);
    for (int level = coarsest; level >= 0; --level) {
      result.kind = refine(from, to, level, px / std::ldexp(1.0, level), flow, result.covariance);
      if (level > 0) flow *= 2;
    }
    const Vector2d end = px + flow;
    if (!(end.minCoeff() >= 0 && end.x() <= from.grey.width - 1 && end.y() <= from.grey.height - 1))
      result.kind = Kind::kNone;
    if (result.kind == Kind::kNone) return result;
    if (result.kind == Kind::kNormal) flow = axis_ * axis_.dot(flow);
    result.flow = flow;
    return result;
  }

 private:
  Kind refine(const Gradients& from, const Gradients& to, int level, const Vector2d& px,
              Vector2d& flow, Matrix2d& covariance) {
    const double pad = from.grey.pad;
    const double u = px.x() + pad, v = px.y() + pad;
    if (!template_.read(from.grey.levels[level], u, v) || !du_.read(from.du[level], u, v) ||
        !dv_.read(from.dv[level], u, v))
      return Kind::kNone;
    inside_ = part_inside(from.grey.levels[level], from.grey.pad, options_.window_px / 2, u, v);
    du_.clear_outside(inside_);
    dv_.clear_outside(inside_);
    const int n = template_.size();
    Matrix2d gradient;
    gradient(0, 0) = dot(du_.data(), du_.data(), n);
    gradient(0, 1) = gradient(1, 0) = dot(du_.data(), dv_.data(), n);
    gradient(1, 1) = dot(dv_.data(), dv_.data(), n);
    const Eigen::SelfAdjointEigenSolver<Matrix2d> eigen(gradient);
    const double least = options_.min_eigenvalue * n * 255 * 255;
    if (!(eigen.eigenvalues()[1] >= least)) return Kind::kNone;
    const bool full = eigen.eigenvalues()[0] >= least;
    axis_ = eigen.eigenvectors().col(1);
    const Matrix2d inverse = full ? Matrix2d(gradient.inverse())
                                  : Matrix2d(axis_ * axis_.transpose() / eigen.eigenvalues()[1]);
    double square = 0;
    Vector2d last = Vector2d::Zero();
    for (int i = 0; i < options_.iterations; ++i) {
      const auto mismatch = compare(to.grey.levels[level], u + flow.x(), v + flow.y());
      if (!mismatch) return Kind::kNone;
      square = mismatch->square;
      const Vector2d step = inverse * mismatch->along_gradient;
      flow += step;
      if (step.norm() < options_.epsilon_px) break;
      if (i > 0 && (step + last).cwiseAbs().maxCoeff() < 0.01) {  // oscillation
        flow -= step / 2;
        break;
      }
      last = step;
    }
    // Smoothing and interpolation correlate neighbouring residuals: about one in four is
    // independent.
    constexpr double kPixelsPerSample = 4;
    covariance = inverse * (kPixelsPerSample * square / std::max(1, inside_.count() - 2));
    return full ? Kind::kFull : Kind::kNormal;
  }

  std::optional<Mismatch> compare(const Image& image, double u, double v) {
    if (!window_.read(image, u, v)) return std::nullopt;
    difference_.set_difference(template_, window_);
    difference_.clear_outside(inside_);
    const int n = difference_.size();
    return Mismatch{
        dot(difference_.data(), difference_.data(), n),
        {dot(difference_.data(), du_.data(), n), dot(difference_.data(), dv_.data(), n)}};
  }

  LucasKanadeOptions options_;
  Window template_, du_, dv_, window_, difference_;
  Part inside_;  // part of the template on the image: its mirrored rest moves differently
  Vector2d axis_ = Vector2d::UnitX();  // eigenvector of the larger eigenvalue, last level
};

}  // namespace

std::vector<FlowVector> lucas_kanade(const Image& from, const Image& to,
                                     const std::vector<Vector2d>& points,
                                     const LucasKanadeOptions& options) {
  options.check();
  require(from.size() == to.size(), "lucas_kanade: the images differ in size");
  const Gradients a = gradients_of(from, options), b = gradients_of(to, options);
  Follower follower(options);
  std::vector<FlowVector> flow;
  flow.reserve(points.size());
  for (const Vector2d& px : points) {
    FlowVector vector = follower.follow(a, b, px, Vector2d::Zero());
    if (vector.kind == Kind::kFull && options.max_return_error_px > 0) {
      const FlowVector back = follower.follow(b, a, px + vector.flow, -vector.flow);
      if (back.kind != Kind::kFull ||
          (back.flow + vector.flow).norm() > options.max_return_error_px)
        vector.kind = Kind::kNone;
    }
    flow.push_back(vector);
  }
  return flow;
}

}  // namespace placegraph
