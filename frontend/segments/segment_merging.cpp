#include <placegraph/frontend/segments/segment_merging.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/disjoint_sets.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace placegraph {
namespace {

/// Maximum angle between pieces of one edge. Chosen.
constexpr double kMaxPieceAngle_deg = 2;
/// Maximum gap between pieces, along the line. Chosen; as for tracked edges.
constexpr double kMaxPieceGap_px = 10;

/// A piece with quantities by which most pairs are rejected quickly.
struct Piece {
  LineSegment segment;
  Eigen::Vector2d direction = Eigen::Vector2d::Zero(), middle = Eigen::Vector2d::Zero();
  double half_length = 0;
};

bool joined(const Piece& a, const Piece& b, double least_cosine) {
  if (a.direction.dot(b.direction) < least_cosine) return false;
  const double reach = a.half_length + b.half_length + kMaxPieceGap_px + kMaxEdgeDistance_px;
  if ((a.middle - b.middle).squaredNorm() > reach * reach) return false;
  const Collinearity lie = collinearity(a.segment, b.segment);
  return lie.gap_px <= kMaxPieceGap_px && lie.distance_px <= kMaxEdgeDistance_px &&
         lie.angle_rad <= deg_to_rad(kMaxPieceAngle_deg);
}

/// One segment over all pieces; nothing if an end is too far from the common line.
std::optional<LineSegment> common(const std::vector<LineSegment>& pieces, double max_distance_px) {
  std::vector<Eigen::Vector2d> ends;
  std::vector<double> sigmas;
  for (const LineSegment& piece : pieces)
    for (const Eigen::Vector2d& end : {piece.start, piece.end}) {
      ends.push_back(end);
      sigmas.push_back(1 / std::sqrt(piece.length()));
    }
  const std::optional<ImageLine> line = fit_line(ends, sigmas);
  if (!line) return std::nullopt;
  const Eigen::Vector2d n = line->normal();
  Eigen::Vector2d along(-n.y(), n.x());
  if (along.dot(pieces.front().vector()) < 0) along = -along;
  double from = 0, to = 0;
  for (const Eigen::Vector2d& end : ends) {
    if (std::abs(n.dot(end) - line->offset_px) > max_distance_px) return std::nullopt;
    const double position = along.dot(end - line->anchor);
    from = std::min(from, position), to = std::max(to, position);
  }
  return LineSegment{line->anchor + from * along, line->anchor + to * along};
}

}  // namespace

std::vector<LineSegment> merge_segments(const std::vector<LineSegment>& pieces) {
  const int n = static_cast<int>(pieces.size());
  std::vector<Piece> known;
  for (const LineSegment& piece : pieces)
    known.push_back({piece, piece.direction(), piece.middle(), 0.5 * piece.length()});
  const double least_cosine = std::cos(deg_to_rad(kMaxPieceAngle_deg)) - 1e-9;
  DisjointSets sets(pieces.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      if (joined(known[i], known[j], least_cosine)) sets.join(i, j);
  const std::vector<int> number = sets.numbers();
  std::vector<std::vector<LineSegment>> edges;
  for (int i = 0; i < n; ++i) {
    if (number[i] == static_cast<int>(edges.size())) edges.emplace_back();
    edges[number[i]].push_back(pieces[i]);
  }
  std::vector<LineSegment> merged;
  for (const std::vector<LineSegment>& edge : edges) {
    const auto whole =
        edge.size() > 1 ? common(edge, kMaxEdgeDistance_px) : std::optional<LineSegment>();
    if (whole)
      merged.push_back(*whole);
    else
      merged.insert(merged.end(), edge.begin(), edge.end());
  }
  return merged;
}

}  // namespace placegraph
