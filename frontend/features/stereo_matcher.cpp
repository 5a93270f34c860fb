#include <placegraph/frontend/features/stereo_matcher.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

struct Peak {
  double u = 0;
  float score = 0;
  bool interior = false;
};

/// Best place of the patch around (u, v) of `from` among centres [u_min, u_max] of the same row of
/// `to`, by ZNCC, to sub-pixels.
std::optional<Peak> search_row(const Image& from, const Image& to, int u, int v, int u_min,
                               int u_max, const StereoMatcherOptions& o) {
  const int w = o.half_width_px, h = o.half_height_px;
  u_min = std::max(u_min, w);
  u_max = std::min(u_max, to.cols - 1 - w);
  if (u < w || v < h || u + w >= from.cols || v + h >= from.rows || u_max - u_min < 2)
    return std::nullopt;
  const cv::Mat patch = from(cv::Rect(u - w, v - h, 2 * w + 1, 2 * h + 1));
  const cv::Mat strip = to(cv::Rect(u_min - w, v - h, u_max - u_min + 2 * w + 1, 2 * h + 1));
  cv::Mat scores;
  cv::matchTemplate(strip, patch, scores, cv::TM_CCOEFF_NORMED);
  const float* s = scores.ptr<float>();
  int best = 0;
  for (int i = 1; i < scores.cols; ++i)
    if (s[i] > s[best]) best = i;
  Peak peak{static_cast<double>(u_min + best), s[best], best > 0 && best + 1 < scores.cols};
  if (peak.interior) {
    const double curvature = s[best - 1] - 2.0 * s[best] + s[best + 1];
    if (curvature < -1e-6) peak.u += 0.5 * (s[best - 1] - s[best + 1]) / curvature;
  }
  return peak;
}

}  // namespace

void StereoMatcherOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, StereoMatcherOptions& o) {
  field("half_width_px", o.half_width_px, "half width of the compared patches", {2, 31});
  field("half_height_px", o.half_height_px, "half height of the compared patches", {1, 31});
  field("max_disparity_px", o.max_disparity_px, "greatest disparity looked for", {4, 1024});
  field("min_score", o.min_score, "ZNCC of an accepted match", {0, 1});
  field("max_left_right_px", o.max_left_right_px, "disagreement with the search back", {0.1, 20});
  field("sigma_disparity_px", o.sigma_disparity_px, "noise of the disparity", {0.01, 10});
}

std::vector<std::optional<double>> match_stereo(const Image& left, const Image& right,
                                                const std::vector<Eigen::Vector2f>& px_left,
                                                const StereoMatcherOptions& o) {
  require(left.type() == CV_8UC1 && right.type() == CV_8UC1 && left.size() == right.size(),
          "match_stereo: two grey images of one size needed");
  std::vector<std::optional<double>> disparities(px_left.size());
  const int reach = static_cast<int>(o.max_disparity_px);
  cv::parallel_for_(cv::Range(0, static_cast<int>(px_left.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      // The patch is cut at whole pixels; the fraction is taken back at the end.
      const int u = cvRound(px_left[i].x()), v = cvRound(px_left[i].y());
      const auto there = search_row(left, right, u, v, u - reach, u + 2, o);
      if (!there || !there->interior || there->score < o.min_score) continue;
      const int u_right = cvRound(there->u);
      const auto back = search_row(right, left, u_right, v, u_right - 2, u_right + reach, o);
      if (!back || std::abs(back->u - (u + u_right - there->u)) > o.max_left_right_px) continue;
      const double disparity = u - there->u;
      if (disparity > 0.1) disparities[i] = disparity;
    }
  });
  return disparities;
}

}  // namespace placegraph
