#include <placegraph/frontend/features/stereo_matcher.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

struct Peak {
  double u = 0;
  float score = 0;
  bool interior = false;
};

/// Zero-mean normalized cross-correlation of a patch with every position in a strip of its height;
/// 0 where the strip has no contrast. (The setup of a library's template matching takes longer than
/// these few hundred products.)
std::vector<float> zncc_along(const cv::Mat& patch, const cv::Mat& strip) {
  const int width = patch.cols, places = strip.cols - width + 1;
  const auto count = static_cast<float>(patch.total());
  const auto mean = static_cast<float>(cv::mean(patch)[0]);
  std::vector<float> products(places, 0.0f);
  std::vector<int> sums(strip.cols, 0), squares(strip.cols, 0);  // sums over the strip's columns
  float patch_square = 0;
  for (int y = 0; y < patch.rows; ++y) {
    const unsigned char* p = patch.ptr(y);
    const unsigned char* q = strip.ptr(y);
    for (int x = 0; x < strip.cols; ++x) {
      sums[x] += q[x];
      squares[x] += q[x] * q[x];
    }
    for (int x = 0; x < width; ++x) {
      const float value = static_cast<float>(p[x]) - mean;
      patch_square += value * value;
      for (int place = 0; place < places; ++place)
        products[place] += value * static_cast<float>(q[x + place]);
    }
  }
  int sum = std::accumulate(sums.begin(), sums.begin() + width, 0);
  int square = std::accumulate(squares.begin(), squares.begin() + width, 0);
  for (int place = 0; place < places; ++place) {
    const auto total = static_cast<float>(sum);
    const float spread = patch_square * (static_cast<float>(square) - total * total / count);
    products[place] = spread > 1e-3f ? products[place] / std::sqrt(spread) : 0.0f;
    if (place + 1 == places) break;
    sum += sums[place + width] - sums[place];
    square += squares[place + width] - squares[place];
  }
  return products;
}

/// Best sub-pixel position, by ZNCC, of the patch around (u, v) of `from` among the centres
/// [u_min, u_max] of the same row of `to`.
std::optional<Peak> search_row(const Image& from, const Image& to, int u, int v, int u_min,
                               int u_max, const StereoMatcherOptions& o) {
  const int w = o.half_width_px, h = o.half_height_px;
  u_min = std::max(u_min, w);
  u_max = std::min(u_max, to.cols - 1 - w);
  if (u < w || v < h || u + w >= from.cols || v + h >= from.rows || u_max - u_min < 2)
    return std::nullopt;
  const cv::Mat patch = from(cv::Rect(u - w, v - h, 2 * w + 1, 2 * h + 1));
  const cv::Mat strip = to(cv::Rect(u_min - w, v - h, u_max - u_min + 2 * w + 1, 2 * h + 1));
  const std::vector<float> s = zncc_along(patch, strip);
  const auto best = static_cast<std::size_t>(std::max_element(s.begin(), s.end()) - s.begin());
  Peak peak{u_min + static_cast<double>(best), s[best], best > 0 && best + 1 < s.size()};
  if (peak.interior) {
    const double curvature = s[best - 1] - 2.0 * s[best] + s[best + 1];
    if (curvature < -1e-6) peak.u += 0.5 * (s[best - 1] - s[best + 1]) / curvature;
  }
  return peak;
}

constexpr double kAboutExpected = 6, kAboutCoarse = 4;  // px of disparity on either side
constexpr double kLessAtHalfSize = 0.1;                 // reduction of the score: pixels mix depths

/// The disparity of a point between `d_min` and `d_max`, checked from right to left.
std::optional<double> match_within(const Image& left, const Image& right, const Eigen::Vector2f& px,
                                   double d_min, double d_max, const StereoMatcherOptions& o) {
  // The patch is taken at whole pixels; the fraction is subtracted at the end.
  const int u = cvRound(px.x()), v = cvRound(px.y());
  const int near = static_cast<int>(std::floor(d_min)), far = static_cast<int>(std::ceil(d_max));
  const auto there = search_row(left, right, u, v, u - far, u - near, o);
  if (!there || !there->interior || there->score < o.min_score) return std::nullopt;
  const int u_right = cvRound(there->u);
  const auto back = search_row(right, left, u_right, v, u_right + near, u_right + far, o);
  if (!back || std::abs(back->u - (u + u_right - there->u)) > o.max_left_right_px)
    return std::nullopt;
  const double disparity = u - there->u;
  return disparity > 0.1 ? std::optional(disparity) : std::nullopt;
}

}  // namespace

std::vector<std::optional<double>> match_stereo(
    const Image& left, const Image& right, const std::vector<Eigen::Vector2f>& px_left,
    const StereoMatcherOptions& o, const std::vector<std::optional<double>>& expected_px) {
  require(left.type() == CV_8UC1 && right.type() == CV_8UC1 && left.size() == right.size(),
          "match_stereo: two grey images of one size needed");
  require(expected_px.empty() || expected_px.size() == px_left.size(),
          "match_stereo: one expected disparity per point needed");
  std::vector<std::optional<double>> disparities(px_left.size());
  const double reach = o.max_disparity_px;
  // Wide ranges are searched at half the size with half the patch, then about the match found.
  Image half_left, half_right;
  cv::pyrDown(left, half_left);
  cv::pyrDown(right, half_right);
  StereoMatcherOptions half = o;
  half.half_width_px = (o.half_width_px + 1) / 2;
  half.half_height_px = (o.half_height_px + 1) / 2;
  half.min_score = o.min_score - kLessAtHalfSize;
  cv::parallel_for_(cv::Range(0, static_cast<int>(px_left.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      const Eigen::Vector2f& px = px_left[i];
      if (!expected_px.empty() && expected_px[i]) {
        const double d = std::min(*expected_px[i], reach);
        disparities[i] = match_within(left, right, px, std::max(-2.0, d - kAboutExpected),
                                      d + kAboutExpected, o);
      }
      if (disparities[i]) continue;
      const auto coarse = match_within(half_left, half_right, px / 2, -2, reach / 2, half);
      if (coarse)
        disparities[i] = match_within(left, right, px, std::max(-2.0, 2 * *coarse - kAboutCoarse),
                                      std::min(reach, 2 * *coarse + kAboutCoarse), o);
    }
  });
  return disparities;
}

}  // namespace placegraph
