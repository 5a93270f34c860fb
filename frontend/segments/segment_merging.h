#pragma once
#include <placegraph/graph/geometry/line_segment.h>

#include <vector>

namespace placegraph {

/// Maximum distance of the ends of one edge's pieces from their common line. Chosen.
inline constexpr double kMaxEdgeDistance_px = 1.2;

/// Joins pieces of edges that a detector has split.
///
/// Pieces have the same direction (polarity) and are on one line with a small gap. A bent chain,
/// whose ends are not all near one line, stays in pieces. The result is in the order of each edge's
/// first piece.
std::vector<LineSegment> merge_segments(const std::vector<LineSegment>& pieces);

}  // namespace placegraph
