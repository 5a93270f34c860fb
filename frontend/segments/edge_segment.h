#pragma once
#include <placegraph/graph/geometry/line_segment.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A segment measured on the gradient, brighter side on the right.
struct EdgeSegment {
  LineSegment segment;
  ImageLine line;       ///< the infinite line, with the covariance of its support
  double contrast = 0;  ///< median gradient across [grey levels / px]
  int support = 0;      ///< number of points used in the line
};

}  // namespace placegraph
