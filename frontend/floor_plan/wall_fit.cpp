#include <placegraph/frontend/floor_plan/wall_fit.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

namespace placegraph {
namespace {

/// Sets the properties of a piece from its points, except for its line.
void set_properties(const std::vector<const PlacedPoint*>& near, WallPiece& piece) {
  std::vector<double> deviations, heights, alongs;
  std::map<int, int> votes;
  for (const PlacedPoint* p : near) {
    const double s = p->point[1 - piece.axis];
    deviations.push_back(std::abs(p->point[piece.axis] - piece.offset_at(s)));
    heights.push_back(p->point[2]), alongs.push_back(s);
    ++votes[p->observation];
  }
  // Points of one observation share its pose's error: observations count, not points.
  piece.sigma_m = std::hypot(
      0.003, 1.4826 * median_of(deviations) / std::sqrt(static_cast<double>(votes.size())));
  std::sort(heights.begin(), heights.end());
  piece.low_m = std::max(0.0, heights[heights.size() / 50]);
  piece.high_m = heights[heights.size() - 1 - heights.size() / 50];
  const double offset_from = piece.offset_at(0);
  piece.from_m = std::max(piece.from_m, *std::min_element(alongs.begin(), alongs.end()));
  piece.to_m = std::min(piece.to_m, *std::max_element(alongs.begin(), alongs.end()));
  piece.offset_m = offset_from + piece.slope * 0.5 * (piece.from_m + piece.to_m);
  piece.count = static_cast<int>(near.size());
  piece.observation =
      std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
        return a.second < b.second;
      })->first;
}

/// Whether two pieces are one wall with an offset by drift between visits.
bool one_wall(const WallPiece& a, const WallPiece& b, const WallTolerance& tolerance) {
  const double gap = std::max(a.from_m, b.from_m) - std::min(a.to_m, b.to_m);
  if (gap > tolerance.max_gap_m) return false;
  const double at = 0.5 * (std::max(a.from_m, b.from_m) + std::min(a.to_m, b.to_m));
  return std::abs(a.offset_at(at) - b.offset_at(at)) < tolerance.max_step_m;
}

}  // namespace

bool fit_wall(const std::vector<const PlacedPoint*>& points, const WallTolerance& tolerance,
              WallPiece& piece) {
  std::vector<const PlacedPoint*> near;
  for (const PlacedPoint* p : points) {
    const double s = p->point[1 - piece.axis];
    if (s < piece.from_m || s > piece.to_m) continue;
    if (std::abs(p->point[piece.axis] - piece.offset_at(s)) <
        tolerance.band_m + tolerance.max_step_m)
      near.push_back(p);
  }
  if (near.size() < 8) return false;
  const double middle = 0.5 * (piece.from_m + piece.to_m);
  const bool sloping = piece.to_m - piece.from_m > 1.5;
  for (int round = 0; round < 8; ++round) {
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (const PlacedPoint* p : near) {
      const double s = p->point[1 - piece.axis] - middle;
      const double r = (p->point[piece.axis] - piece.offset_at(s + middle)) / 0.02;
      const double w = 1 / (1 + r * r) / (1e-4 + p->sigma * p->sigma);
      const Eigen::Vector2d row(1, sloping ? s : 0);
      A += w * row * row.transpose();
      b += w * row * p->point[piece.axis];
    }
    if (!sloping) A(1, 1) = 1;
    const Eigen::Vector2d x = A.inverse() * b;
    piece.offset_m = x[0], piece.slope = x[1];
  }
  set_properties(near, piece);
  return std::abs(piece.slope) < std::tan(deg_to_rad(tolerance.max_rotation_deg));
}

void join_walls(const std::vector<const PlacedPoint*>& points, const WallTolerance& tolerance,
                std::vector<WallPiece>& pieces) {
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t j = i + 1; j < pieces.size(); ++j) {
      if (!one_wall(pieces[i], pieces[j], tolerance)) continue;
      const WallPiece& longer =
          pieces[i].to_m - pieces[i].from_m > pieces[j].to_m - pieces[j].from_m ? pieces[i]
                                                                                : pieces[j];
      WallPiece whole = longer;
      whole.from_m = std::min(pieces[i].from_m, pieces[j].from_m);
      whole.to_m = std::max(pieces[i].to_m, pieces[j].to_m);
      whole.offset_m = longer.offset_at(0.5 * (whole.from_m + whole.to_m));
      if (!fit_wall(points, tolerance, whole)) continue;
      pieces[i] = whole;
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
      j = i;
    }
}

}  // namespace placegraph
