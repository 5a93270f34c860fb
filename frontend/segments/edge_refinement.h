#pragma once
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/segments/segment_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/image/image.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Intersection of an edge with a profile.
struct EdgePoint {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  double gradient = 0;  ///< along the normal of the segment [grey levels / px]
  double position = 0;  ///< position of the profile along the segment, from its start [px]
};

/// Refines segments to the steepest change of grey value across them.
///
/// One point every pixel, sub-pixel by a parabola through three gradients, then a line by total
/// least squares without points beyond 2.5 robust deviations. The standard deviation of a point is
/// that of the residuals; as neighbouring points share the pixels of the blur, variances are those
/// of points 2 sqrt(pi) blur apart.
class EdgeRefiner {
 public:
  /// Prepares the gradient of an image (CV_8UC1, else ArgumentError).
  explicit EdgeRefiner(const Image& image);

  /// Refines a segment; its ends are the feet of the given ones on the line.
  ///
  /// Nothing if an edge of one polarity is found at less than half of the samples.
  std::optional<EdgeSegment> refine(const LineSegment& segment) const;
  /// Refines an edge from another image with its brighter side on the right of `expected`.
  ///
  /// Edges of the other polarity are ignored. The ends are those of the longest stretch of support,
  /// up to `growth.beyond_px` outside the expected ones.
  std::optional<EdgeSegment> follow(const LineSegment& expected, const EdgeGrowth& growth) const;

 private:
  std::vector<EdgePoint> edge_points(const LineSegment& segment, int sign) const;
  std::optional<EdgeSegment> fit(const std::vector<EdgePoint>& points, int least) const;
  double grey(const Eigen::Vector2d& px) const;

  Image smooth_;
};

}  // namespace placegraph
