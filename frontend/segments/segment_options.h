#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Extension of a tracked edge beyond its predicted ends.
struct EdgeGrowth {
  double beyond_px = 6;    ///< maximum growth at either end
  double max_gap_px = 10;  ///< maximum gap without support inside an edge
};

/// Detection of straight edges.
struct SegmentDetectorOptions {
  double min_length_px = 15;  ///< minimum length of an edge
  double border_px = 3;       ///< edges along the image border within this distance are left out
  void check() const;
};
void visit(OptionVisitor& field, SegmentDetectorOptions& options);

}  // namespace placegraph
