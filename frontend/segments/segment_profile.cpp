#include <placegraph/frontend/segments/segment_profile.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Running sums of a correlation.
struct Correlation {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  void add(double x, double y) { ++n, a += x, b += y, aa += x * x, bb += y * y, ab += x * y; }
  void add(const Correlation& c) {
    n += c.n, a += c.a, b += c.b, aa += c.aa, bb += c.bb, ab += c.ab;
  }
  double value() const {
    constexpr double kLeastVariance = 1;  // grey levels squared: below this there is only noise
    if (n < 8) return -1;
    const double var_a = aa / n - a * a / (n * n), var_b = bb / n - b * b / (n * n);
    if (var_a < kLeastVariance || var_b < kLeastVariance) return -1;
    return (ab / n - a * b / (n * n)) / std::sqrt(var_a * var_b);
  }
};

}  // namespace

LineProfileImage::LineProfileImage(const Image& image) {
  require(!image.empty() && image.type() == CV_8UC1, "LineProfileImage: grey image needed");
  constexpr int kLevels = 4;
  Image level;
  image.convertTo(level, CV_32F);
  for (int i = 0; i < kLevels && std::min(level.rows, level.cols) > 8; ++i) {
    Image smooth;
    cv::GaussianBlur(level, smooth, cv::Size(), 0.8);
    levels_.push_back(smooth);
    cv::Mat half;
    cv::resize(smooth, half, cv::Size((level.cols + 1) / 2, (level.rows + 1) / 2), 0, 0,
               cv::INTER_AREA);
    level = half;
  }
  require(!levels_.empty(), "LineProfileImage: image too small");
}

int LineProfileImage::level_of(double step_px) const {
  const int level = static_cast<int>(std::floor(std::log2(std::max(1.0, step_px)) + 0.25));
  return std::clamp(level, 0, static_cast<int>(levels_.size()) - 1);
}

bool LineProfileImage::contains(const Eigen::Vector2d& px) const {
  return px.x() >= 0 && px.y() >= 0 && px.x() <= levels_[0].cols - 1 &&
         px.y() <= levels_[0].rows - 1;
}

float LineProfileImage::grey(const Eigen::Vector2d& px, int level) const {
  const Image& image = levels_[level];
  const double shrink = 1.0 / (1 << level);
  // Pixel centres at integers: (u + 1/2) shrinks, not u.
  const double u = std::clamp((px.x() + 0.5) * shrink - 0.5, 0.0, image.cols - 1.001);
  const double v = std::clamp((px.y() + 0.5) * shrink - 0.5, 0.0, image.rows - 1.001);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const auto x = static_cast<float>(u - i), y = static_cast<float>(v - j);
  const float* top = image.ptr<float>(j) + i;
  const float* bottom = image.ptr<float>(j + 1) + i;
  return (1 - y) * ((1 - x) * top[0] + x * top[1]) + y * ((1 - x) * bottom[0] + x * bottom[1]);
}

LineProfileSimilarity compare_strips(const LineProfileImage& a, const LineProfile& frame_a,
                                     const LineProfileImage& b, const LineProfile& frame_b,
                                     int half_width) {
  constexpr int kEdge = 1;  // rows within this distance belong to the edge itself and to both sides
  const double step_a = frame_a.across.norm(), step_b = frame_b.across.norm();
  const double length = std::max((frame_a.to - frame_a.from).norm() / step_a,
                                 (frame_b.to - frame_b.from).norm() / step_b);
  const int columns = std::clamp(static_cast<int>(length), 6, 60);
  const int level_a = a.level_of(step_a), level_b = b.level_of(step_b);
  Correlation left, edge, right;
  for (int k = -half_width; k <= half_width; ++k) {
    Correlation& part = k < -kEdge ? left : k > kEdge ? right : edge;
    for (int i = 0; i < columns; ++i) {
      const double s = (i + 0.5) / columns;
      const Eigen::Vector2d p = frame_a.from + s * (frame_a.to - frame_a.from) + k * frame_a.across;
      const Eigen::Vector2d q = frame_b.from + s * (frame_b.to - frame_b.from) + k * frame_b.across;
      if (a.contains(p) && b.contains(q)) part.add(a.grey(p, level_a), b.grey(q, level_b));
    }
  }
  Correlation all = left, left_edge = left, right_edge = right;
  all.add(edge), all.add(right), left_edge.add(edge), right_edge.add(edge);
  LineProfileSimilarity result;
  const double least = 0.5 * columns * (half_width - kEdge);
  if (left.n >= least && right.n >= least) result.both = all.value();
  if (left.n >= least) result.left = left_edge.value();
  if (right.n >= least) result.right = right_edge.value();
  return result;
}

}  // namespace placegraph
