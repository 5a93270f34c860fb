#pragma once
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace placegraph {

/// An image pyramid, smoothed for sampling along line profiles [grey levels], CV_32FC1.
class LineProfileImage {
 public:
  /// Builds the pyramid of an image (CV_8UC1, else ArgumentError).
  explicit LineProfileImage(const Image& image);
  /// Grey value on a level, bilinear; the border is replicated outside.
  float grey(const Eigen::Vector2d& px, int level) const;
  int level_of(double step_px) const;
  bool contains(const Eigen::Vector2d& px) const;

 private:
  std::vector<Image> levels_;
};

/// A parallelogram of samples around a piece of a line; row k is displaced by k * `across`.
struct LineProfile {
  Eigen::Vector2d from, to;  ///< ends of the piece
  Eigen::Vector2d across;    ///< from one row to the next
};

/// Similarity of two strips by zero-mean normalized cross-correlation.
///
/// For both sides together and for each side with the edge itself; -1 if a side has no contrast or
/// is outside the image.
struct LineProfileSimilarity {
  double both = -1, left = -1, right = -1;
};
LineProfileSimilarity compare_strips(const LineProfileImage& a, const LineProfile& frame_a,
                                     const LineProfileImage& b, const LineProfile& frame_b,
                                     int half_width);

}  // namespace placegraph
