#include <placegraph/frontend/lines/line_stereo.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Minimum sine of a segment's angle to the rows, 10 degrees; below: no depth. Chosen.
constexpr double kMinSine = 0.17;
/// Points along a segment whose disparities start the search. Chosen.
constexpr int kLineSamples = 7;
/// Maximum distance of an inlier from the common line. Chosen.
constexpr double kMaxDisparityMiss_px = 1.5;

/// A disparity at a position along a segment (0 to 1).
struct Sample {
  double share = 0, disparity = 0;
};

/// Disparities of both ends from the line through two samples with most inliers.
std::optional<std::pair<double, double>> consensus(const std::vector<Sample>& samples,
                                                   double gate_px) {
  const int n = static_cast<int>(samples.size());
  std::vector<Sample> best;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const double slope =
          (samples[j].disparity - samples[i].disparity) / (samples[j].share - samples[i].share);
      std::vector<Sample> agree;
      for (const Sample& s : samples)
        if (std::abs(samples[i].disparity + slope * (s.share - samples[i].share) - s.disparity) <
            gate_px)
          agree.push_back(s);
      if (agree.size() > best.size()) best = agree;
    }
  // Two samples determine a line, the third one tests it.
  constexpr std::size_t kLeast = 3;
  if (best.size() < kLeast) return std::nullopt;
  double x = 0, d = 0, xx = 0, xd = 0;
  const double count = static_cast<double>(best.size());
  for (const Sample& s : best) x += s.share / count, d += s.disparity / count;
  for (const Sample& s : best)
    xx += (s.share - x) * (s.share - x), xd += (s.share - x) * (s.disparity - d);
  const double slope = xd / xx;
  const double from = d - slope * x, to = d + slope * (1 - x);
  if (!(from > 0) || !(to > 0)) return std::nullopt;
  return std::pair(from, to);
}

}  // namespace

std::vector<std::optional<EdgeSegment>> match_stereo_segments(
    const Image& left, const Image& right, const std::vector<LineSegment>& segments_left,
    const StereoMatcherOptions& points, const LineStereoOptions& options) {
  options.check();
  require(left.size() == right.size() && left.type() == CV_8UC1 && right.type() == CV_8UC1,
          "match_stereo_segments: two grey images of one size needed");
  const auto useful = [&](const LineSegment& s) {
    return s.length() > 4 && std::abs(s.direction().y()) >= kMinSine;
  };
  std::vector<Eigen::Vector2f> px;
  for (const LineSegment& segment : segments_left)
    for (int k = 0; useful(segment) && k < kLineSamples; ++k)
      px.push_back((segment.start + (k + 0.5) / kLineSamples * segment.vector()).cast<float>());
  const auto disparities = match_stereo(left, right, px, points);
  const LineProfileImage strips_left(left), strips_right(right);
  const EdgeRefiner refiner(right);

  std::vector<std::optional<EdgeSegment>> result(segments_left.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < segments_left.size(); ++i) {
    const LineSegment& segment = segments_left[i];
    if (!useful(segment)) continue;
    std::vector<Sample> samples;
    for (int k = 0; k < kLineSamples; ++k, ++next)
      if (disparities[next]) samples.push_back({(k + 0.5) / kLineSamples, *disparities[next]});
    const auto ends = consensus(samples, kMaxDisparityMiss_px);
    if (!ends) continue;
    const LineSegment expected{segment.start - Eigen::Vector2d(ends->first, 0),
                               segment.end - Eigen::Vector2d(ends->second, 0)};
    const auto flow = follow_segment(strips_left, segment, strips_right, expected, 1);
    if (!flow || std::abs(flow->shift_px) > 2 * kMaxDisparityMiss_px) continue;
    const double similar =
        std::max(flow->similar.both, std::max(flow->similar.left, flow->similar.right) - 0.1);
    if (similar < options.min_similarity) continue;
    const auto edge = refiner.follow(flow->segment, {0, 10});
    if (!edge || edge->segment.length() < 0.4 * segment.length()) continue;
    // At the rows of the left ends, the disparity of the right line must be positive.
    const Eigen::Vector2d n = edge->line.normal();
    const auto disparity = [&](const Eigen::Vector2d& p) {
      return p.x() - (edge->line.offset_px - n.y() * p.y()) / n.x();
    };
    if (std::abs(n.x()) < kMinSine || disparity(segment.start) <= 0 || disparity(segment.end) <= 0)
      continue;
    result[i] = edge;
  }
  return result;
}

}  // namespace placegraph
