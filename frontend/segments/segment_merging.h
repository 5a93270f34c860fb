#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <vector>

namespace placegraph {

struct SegmentMergingOptions {
  double max_angle_deg = 2;
  double max_distance_px = 1.2;  ///< of the ends of the pieces from the common line
  double max_gap_px = 10;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, SegmentMergingOptions& options);

/// Joins the pieces of edges that a detector broke: segments of the same sense (polarity) that lie
/// on one line with a small gap. A chain of pieces that bends, so that no one line holds all ends,
/// stays in pieces. The result is in the order of each edge's first piece.
std::vector<LineSegment> merge_segments(const std::vector<LineSegment>& pieces,
                                        const SegmentMergingOptions& options);

}  // namespace placegraph
