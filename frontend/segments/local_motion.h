#pragma once
#include <placegraph/frontend/features/wide_matcher.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <optional>
#include <vector>

namespace placegraph {

/// A segment of image a with a segment on its infinite line in image b.
struct SegmentPair {
  LineSegment a, b;
};

/// Motion of the surroundings of a segment between two images: px_b = A px_a + t.
struct LocalMotion {
  Eigen::Matrix2d A = Eigen::Matrix2d::Identity();
  Eigen::Vector2d t = Eigen::Vector2d::Zero();
  double rms_px = 0;       ///< weighted residual of the evidence
  double distance_px = 0;  ///< median distance of the evidence from the segment

  Eigen::Vector2d operator()(const Eigen::Vector2d& px_a) const { return A * px_a + t; }
};

/// Local motion around segments, from point pairs and matched segments.
///
/// An affine map fitted to the nearest evidence (px_b - A px_a - t = 0 for a point;
/// n_b^T (A px_a + t) = offset_b for both ends of a segment), robust (Cauchy), with a weak prior
/// from the scale and rotation of the point features.
class LocalMotionField {
 public:
  /// Takes the evidence; `nearest`: number of point or segment pairs used in one map.
  explicit LocalMotionField(std::vector<PointPair> points, std::vector<SegmentPair> segments = {},
                            int nearest = 14);

  /// The map around a segment of image a; nothing with fewer than three pairs.
  ///
  /// `without` is the index of a segment pair that is not used, or -1.
  std::optional<LocalMotion> around(const LineSegment& a, int without = -1) const;

 private:
  struct Evidence {
    double distance = 0;
    int index = 0;
    bool is_point = true;
  };
  std::vector<Evidence> nearest_to(const LineSegment& a, int without) const;

  std::vector<PointPair> points_;
  std::vector<SegmentPair> segments_;
  int nearest_;
};

}  // namespace placegraph
