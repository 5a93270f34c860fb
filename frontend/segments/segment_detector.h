#pragma once
#include <placegraph/frontend/segments/segment_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/image/image.h>

#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A segment measured on the gradient, brighter side on the right.
struct EdgeSegment {
  LineSegment segment;
  ImageLine line;       ///< the infinite line, with the covariance of its support
  double contrast = 0;  ///< median gradient across [grey levels / px]
  int support = 0;      ///< number of points used in the line
};

/// Detects straight edges of a grey image (CV_8UC1, else ArgumentError), longest first.
///
/// LSD (von Gioi et al. 2010, by OpenCV), pieces of one edge merged, each refined on the gradient
/// to sub-pixel accuracy. The direction encodes the polarity: the brighter side is on the right.
std::vector<EdgeSegment> detect_segments(const Image& image, const SegmentDetectorOptions& options);

/// The segments of edges, in order.
std::vector<LineSegment> segments_of(const std::vector<EdgeSegment>& edges);

}  // namespace placegraph
