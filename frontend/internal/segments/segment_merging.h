#pragma once
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/line_segment.h>

#include <vector>

namespace placegraph {

/// Joins the pieces of edges that a detector broke: segments of the same sense (polarity) that lie
/// on one line with a small gap. A chain of pieces that bends, so that no one line holds all ends,
/// stays in pieces. The result is in the order of each edge's first piece.
std::vector<LineSegment> merge_segments(const std::vector<LineSegment>& pieces,
                                        const SegmentMergingOptions& options);

}  // namespace placegraph
