#pragma once
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// An image at full size and halved again and again, smoothed enough for sampling [grey levels],
/// CV_32FC1.
class LineProfileImage {
 public:
  /// CV_8UC1, else ArgumentError.
  explicit LineProfileImage(const Image& image);
  /// Grey value for samples `step_px` apart, bilinear; the border goes on outside.
  float grey(const Eigen::Vector2d& px, int level) const;
  int level_of(double step_px) const;
  bool contains(const Eigen::Vector2d& px) const;

 private:
  std::vector<Image> levels_;
};

/// A parallelogram of samples around a piece of a line: row k is `across` * k beside it.
struct LineProfile {
  Eigen::Vector2d from, to;  ///< ends of the piece
  Eigen::Vector2d across;    ///< from one row to the next
};

/// How alike two strips are: zero-mean normalized cross-correlation of both sides together and of
/// each side alone with the edge itself; -1 where a side shows nothing or lies outside the image.
struct LineProfileSimilarity {
  double both = -1, left = -1, right = -1;
};
LineProfileSimilarity compare_strips(const LineProfileImage& a, const LineProfile& frame_a,
                                     const LineProfileImage& b, const LineProfile& frame_b,
                                     int half_width);

}  // namespace placegraph
