#pragma once
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/image/image.h>

#include <optional>
#include <vector>

namespace placegraph {

/// A segment measured on the gradient, brighter side on the right.
struct EdgeSegment {
  LineSegment segment;
  ImageLine line;       ///< the infinite line, with the covariance of its support
  double contrast = 0;  ///< median gradient across, grey levels / px
  int support = 0;      ///< points that shaped the line
};

/// A place where an edge crosses a profile.
struct EdgePoint {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();
  double gradient = 0;  ///< along the normal of the segment, grey levels / px
  double position = 0;  ///< of the profile along the segment, from its start [px]
};

/// Fits segments anew to the place of the steepest grey value across them: one point every pixel,
/// sub-pixel by a parabola through three gradients, then a line by total least squares, points
/// farther than 2.5 robust deviations left out. The deviation of a point is that of the residuals;
/// as neighbouring points share the pixels of the blur, variances are those of points
/// 2 sqrt(pi) blur apart.
class EdgeRefiner {
 public:
  /// CV_8UC1, else ArgumentError.
  EdgeRefiner(const Image& image, const EdgeRefinementOptions& options);

  /// Nothing if fewer than `min_support` of the samples see an edge of one polarity. The ends are
  /// the feet of the given ones on the line.
  std::optional<EdgeSegment> refine(const LineSegment& segment) const;
  /// The same for an edge known from another image, its brighter side on the right of `expected`:
  /// edges of the other polarity are passed over, and the ends are where the longest run of support
  /// begins and ends, up to `growth.beyond_px` outside those expected.
  std::optional<EdgeSegment> follow(const LineSegment& expected, const EdgeGrowth& growth) const;

 private:
  std::vector<EdgePoint> edge_points(const LineSegment& segment, int sign) const;
  std::optional<EdgeSegment> fit(const std::vector<EdgePoint>& points, int least) const;
  double grey(const Eigen::Vector2d& px) const;

  EdgeRefinementOptions options_;
  Image smooth_;
};

}  // namespace placegraph
