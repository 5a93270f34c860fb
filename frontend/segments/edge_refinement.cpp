#include <placegraph/frontend/segments/edge_refinement.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Search distance for the edge on both sides of the segment. Chosen.
constexpr int kEdgeReach_px = 3;
/// Standard deviation of the blur before the gradient is taken. Chosen.
constexpr double kEdgeBlur_px = 1;
/// Minimum gradient of a point of the edge [grey levels / px]. Chosen.
constexpr double kMinGradient = 2;
/// Minimum share of the segment's samples at which the edge is found. Chosen: half.
constexpr double kMinEdgeSupport = 0.5;
/// Minimum standard deviation of a sample across the edge. Chosen.
constexpr double kMinEdgeSigma_px = 0.03;

// Two points determine a line; two more estimate its noise.
constexpr int kLeastPoints = 4;

/// The edge of one polarity nearest to the middle of a row of gradients across a segment: the
/// maximum of the parabola through the steepest three; nothing if none is steep enough.
struct Peak {
  double position = 0;  ///< from the beginning of the row [samples]
  double gradient = 0;
};
std::optional<Peak> nearest_peak(const std::vector<double>& gradient, int sign, double least) {
  const int n = static_cast<int>(gradient.size()), middle = n / 2;
  int best = -1;
  for (int k = 1; k + 1 < n; ++k) {
    const double g = sign * gradient[k];
    const bool peak = g >= least && g >= sign * gradient[k - 1] && g > sign * gradient[k + 1];
    if (peak && (best < 0 || std::abs(k - middle) < std::abs(best - middle))) best = k;
  }
  if (best < 0) return std::nullopt;
  const double before = gradient[best - 1], at = gradient[best], after = gradient[best + 1];
  const double bend = before - 2 * at + after;
  return Peak{best + (bend != 0 ? 0.5 * (before - after) / bend : 0), at};
}

double distance(const ImageLine& line, const Eigen::Vector2d& px) {
  return std::abs(line.normal().dot(px) - line.offset_px);
}

}  // namespace

EdgeRefiner::EdgeRefiner(const Image& image) {
  require(!image.empty() && image.type() == CV_8UC1, "EdgeRefiner: grey image needed");
  image.convertTo(smooth_, CV_32F);
  cv::GaussianBlur(smooth_, smooth_, cv::Size(), kEdgeBlur_px);
}

double EdgeRefiner::grey(const Eigen::Vector2d& px) const {
  const double u = std::clamp(px.x(), 0.0, smooth_.cols - 1.001);
  const double v = std::clamp(px.y(), 0.0, smooth_.rows - 1.001);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const double x = u - i, y = v - j;
  const float* top = smooth_.ptr<float>(j) + i;
  const float* bottom = smooth_.ptr<float>(std::min(j + 1, smooth_.rows - 1)) + i;
  return (1 - y) * ((1 - x) * top[0] + x * top[1]) + y * ((1 - x) * bottom[0] + x * bottom[1]);
}

/// The edge of the given polarity on every profile that has one.
std::vector<EdgePoint> EdgeRefiner::edge_points(const LineSegment& segment, int sign) const {
  const Eigen::Vector2d normal = segment.normal();
  const int reach = kEdgeReach_px, samples = static_cast<int>(segment.length());
  std::vector<EdgePoint> points;
  std::vector<double> profile(2 * reach + 3), gradient(2 * reach + 1);
  for (int s = 0; s < samples; ++s) {
    const double share = (s + 0.5) / samples;
    const Eigen::Vector2d p = segment.start + share * segment.vector();
    if (p.x() < 1 || p.y() < 1 || p.x() > smooth_.cols - 2 || p.y() > smooth_.rows - 2) continue;
    for (int k = 0; k < 2 * reach + 3; ++k) profile[k] = grey(p + (k - reach - 1) * normal);
    for (int k = 0; k < 2 * reach + 1; ++k) gradient[k] = 0.5 * (profile[k + 2] - profile[k]);
    if (const auto peak = nearest_peak(gradient, sign, kMinGradient))
      points.push_back(
          {p + (peak->position - reach) * normal, peak->gradient, share * segment.length()});
  }
  return points;
}

/// Line, contrast and support of the edge through the points; nothing with fewer than `least`
/// points or half as many inliers.
std::optional<EdgeSegment> EdgeRefiner::fit(const std::vector<EdgePoint>& points, int least) const {
  if (static_cast<int>(points.size()) < std::max(kLeastPoints, least)) return std::nullopt;
  std::vector<Eigen::Vector2d> kept;
  std::vector<double> gradients;
  for (const EdgePoint& point : points) {
    kept.push_back(point.px);
    gradients.push_back(std::abs(point.gradient));
  }
  std::optional<ImageLine> line = fit_line(kept, std::vector<double>(kept.size(), 1));
  // Chosen.
  constexpr int kRounds = 3;
  for (int round = 0; line && round < kRounds; ++round) {
    std::vector<double> distances;
    for (const EdgePoint& point : points) distances.push_back(distance(*line, point.px));
    const double sigma = std::max(kMinEdgeSigma_px, 1.4826 * median_of(distances));
    kept.clear();
    for (const EdgePoint& point : points)
      if (distance(*line, point.px) <= 2.5 * sigma) kept.push_back(point.px);
    if (static_cast<int>(kept.size()) < std::max(kLeastPoints, least / 2)) return std::nullopt;
    line = fit_line(kept, std::vector<double>(kept.size(), 1));
  }
  if (!line) return std::nullopt;
  double squared = 0;
  for (const Eigen::Vector2d& px : kept) squared += std::pow(distance(*line, px), 2);
  const double variance =
      std::max(kMinEdgeSigma_px * kMinEdgeSigma_px, squared / static_cast<double>(kept.size() - 2));
  line->covariance *= variance * std::max(1.0, 2 * std::sqrt(std::numbers::pi) * kEdgeBlur_px);
  return EdgeSegment{{}, *line, median_of(gradients), static_cast<int>(kept.size())};
}

std::optional<EdgeSegment> EdgeRefiner::refine(const LineSegment& given) const {
  const int samples = static_cast<int>(given.length());
  if (samples < kLeastPoints) return std::nullopt;
  std::vector<EdgePoint> points = edge_points(given, 1), dark = edge_points(given, -1);
  const auto strength = [](const std::vector<EdgePoint>& edge) {
    double sum = 0;
    for (const EdgePoint& point : edge) sum += std::abs(point.gradient);
    return sum;
  };
  const bool rotated = strength(dark) > strength(points);
  if (rotated) points = std::move(dark);
  auto edge = fit(points, static_cast<int>(std::ceil(kMinEdgeSupport * samples)));
  if (!edge) return std::nullopt;
  edge->segment = {edge->line.foot(given.start), edge->line.foot(given.end)};
  if (rotated) std::swap(edge->segment.start, edge->segment.end);
  return edge;
}

std::optional<EdgeSegment> EdgeRefiner::follow(const LineSegment& expected,
                                               const EdgeGrowth& growth) const {
  if (expected.length() < kLeastPoints) return std::nullopt;
  const Eigen::Vector2d beyond = growth.beyond_px * expected.direction();
  const LineSegment wide{expected.start - beyond, expected.end + beyond};
  const std::vector<EdgePoint> inside = edge_points(expected, 1);
  const auto core = fit(inside, static_cast<int>(kMinEdgeSupport * expected.length() / 2));
  if (!core) return std::nullopt;
  // Further points belong to the edge if they fit the line of the middle part.
  const double gate = std::max(0.5, 3 * std::sqrt(core->line.covariance(1, 1)));
  std::vector<EdgePoint> run, longest;
  for (const EdgePoint& point : edge_points(wide, 1)) {
    if (distance(core->line, point.px) > gate + 1) continue;
    if (!run.empty() && point.position - run.back().position > growth.max_gap_px) run.clear();
    run.push_back(point);
    if (run.size() > longest.size()) longest = run;
  }
  if (longest.size() < 2) return std::nullopt;
  const double length = longest.back().position - longest.front().position;
  auto edge = fit(longest, static_cast<int>(std::ceil(kMinEdgeSupport * length)));
  if (!edge) return std::nullopt;
  edge->segment = {edge->line.foot(longest.front().px), edge->line.foot(longest.back().px)};
  return edge;
}

}  // namespace placegraph
