#include <placegraph/eval/drawing/covered_cells.h>
#include <placegraph/eval/drawing/line_thinning.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace placegraph {
namespace {

using Eigen::Vector2d;

/// Shares of the tolerance: of points that fall together, of straight stretches, and of segments
/// beside others.
constexpr double kTogether = 0.2, kStraight = 0.2, kBeside = 0.6;

/// A point and the level of the segment that begins there.
struct Vertex {
  Vector2d at;
  int level = 0;
};
using Run = std::vector<Vertex>;

std::vector<Run> runs_of(const PixelLine& line) {
  std::vector<Run> runs;
  bool open = false;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const auto& point = line.points[i];
    if (!point || !point->allFinite()) {
      open = false;
      continue;
    }
    if (!open) runs.emplace_back();
    open = true;
    runs.back().push_back({*point, line.levels.empty() ? 0 : line.levels[i]});
  }
  return runs;
}

bool is_function_of_x(const Run& run) {
  const auto x = [](const Vertex& vertex) { return vertex.at[0]; };
  return std::ranges::is_sorted(run, {}, x) || std::ranges::is_sorted(run, std::greater(), x);
}

/// The least and the greatest value of every column, and both ends.
Run extremes_of_columns(const Run& run, double column_px) {
  Run kept;
  const auto column = [&](std::size_t i) { return std::floor(run[i].at[0] / column_px); };
  for (std::size_t begin = 0, end = 0; begin < run.size(); begin = end) {
    std::size_t least = begin, greatest = begin;
    for (end = begin; end < run.size() && column(end) == column(begin); ++end) {
      if (run[end].at[1] < run[least].at[1]) least = end;
      if (run[end].at[1] > run[greatest].at[1]) greatest = end;
    }
    std::set<std::size_t> chosen = {least, greatest};
    if (begin == 0) chosen.insert(0);
    if (end == run.size()) chosen.insert(end - 1);
    for (const std::size_t i : chosen) kept.push_back(run[i]);
  }
  return kept;
}

/// One point, of the highest level, for those that follow it within the radius; and the last one.
Run joined_neighbours(const Run& run, double radius_px) {
  Run kept = {run.front()};
  for (const Vertex& vertex : run) {
    if ((vertex.at - kept.back().at).norm() <= radius_px)
      kept.back().level = std::max(kept.back().level, vertex.level);
    else
      kept.push_back(vertex);
  }
  if (kept.back().at != run.back().at) kept.push_back(run.back());
  return kept;
}

/// Whether a straight stretch from a point may end at later ones: it stays within a tolerance of
/// all points between.
class StraightStretch {
 public:
  StraightStretch(const Vector2d& begin, double tolerance_px)
      : begin_(begin),
        aside_px_(0.5 * std::numbers::sqrt3 * tolerance_px),
        back_px_(0.5 * tolerance_px) {}

  /// Takes a point if the stretch may end there: it passes the points before at no more than
  /// aside_px_, and ends at most back_px_ before the farthest of them.
  bool take(const Vector2d& point) {
    const Vector2d away = point - begin_;
    const double distance = away.norm();
    if (distance < farthest_px_ - back_px_) return false;
    farthest_px_ = std::max(farthest_px_, distance);
    if (towards_.isZero()) {
      if (distance <= aside_px_) return true;
      towards_ = away;
    }
    const double angle = angle_of(away);
    if (angle < low_ || angle > high_) return false;
    if (distance <= aside_px_) return true;
    const double half = std::asin(aside_px_ / distance);
    low_ = std::max(low_, angle - half);
    high_ = std::min(high_, angle + half);
    return true;
  }

 private:
  static constexpr double kHalfTurn = std::numbers::pi;
  double angle_of(const Vector2d& away) const {
    return std::atan2(towards_[0] * away[1] - towards_[1] * away[0], towards_.dot(away));
  }

  Vector2d begin_, towards_ = Vector2d::Zero();  ///< angles are relative to towards_
  double aside_px_, back_px_, farthest_px_ = 0, low_ = -kHalfTurn, high_ = kHalfTurn;
};

/// The ends of straight stretches of one level; a point where the level changes is one of them.
Run straightened(const Run& run, double tolerance_px) {
  Run kept = {run.front()};
  StraightStretch stretch(run.front().at, tolerance_px);
  for (std::size_t i = 1; i < run.size(); ++i) {
    if (run[i - 1].level == kept.back().level && stretch.take(run[i].at)) continue;
    kept.push_back(run[i - 1]);
    stretch = StraightStretch(run[i - 1].at, tolerance_px);
    stretch.take(run[i].at);
  }
  kept.push_back(run.back());
  return kept;
}

/// What is kept of a run. A single point is a short stroke.
Run thinned_run(const Run& run, bool levels, double tolerance_px) {
  const double together_px = kTogether * tolerance_px;
  Run kept = straightened(!levels && is_function_of_x(run) ? extremes_of_columns(run, together_px)
                                                           : joined_neighbours(run, together_px),
                          kStraight * tolerance_px);
  if (kept.size() == 2 && kept[0].at == kept[1].at) kept[1].at[0] += 0.5;
  return kept;
}

/// The part of an area in which runs lie.
PixelArea area_of(const std::vector<Run>& runs, const PixelArea& area) {
  const Vector2d end = area.corner + area.size;
  Vector2d low = end, high = area.corner;
  for (const Run& run : runs)
    for (const Vertex& vertex : run) {
      low = low.cwiseMin(vertex.at);
      high = high.cwiseMax(vertex.at);
    }
  low = low.cwiseMax(area.corner);
  return {low, (high.cwiseMin(end) - low).cwiseMax(0)};
}

/// Collects the segments of one level that cover what no other one covers.
class Level {
 public:
  Level(int level, const PixelArea& area, double tolerance_px)
      : line_{level, {}}, covered_(area, kBeside * tolerance_px) {}

  /// Adds a segment, which continues the last one if that was the one before it.
  /// Returns how many points it adds.
  std::size_t add(const Vector2d& a, const Vector2d& b, bool continues) {
    const bool joined = std::exchange(kept_, covered_.cover(a, b)) && continues;
    if (!kept_) return 0;
    if (!joined) line_.stretches.push_back({a});
    line_.stretches.back().push_back(b);
    return joined ? 1 : 2;
  }
  ThinnedLine finish() { return std::move(line_); }

 private:
  ThinnedLine line_;
  CoveredCells covered_;
  bool kept_ = false;  ///< whether the last segment was
};

}  // namespace

std::optional<std::vector<ThinnedLine>> thin_line(const PixelLine& line, double tolerance_px,
                                                  const PixelArea& area, std::size_t most_points) {
  require(tolerance_px > 0, "thin_line: the tolerance is not positive");
  std::map<int, std::vector<Run>> by_level;
  for (const Run& run : runs_of(line)) {
    const Run kept = thinned_run(run, !line.levels.empty(), tolerance_px);
    for (std::size_t i = 0; i + 1 < kept.size();) {
      Run part = {kept[i]};
      const int level = kept[i].level;
      while (i + 1 < kept.size() && kept[i].level == level) part.push_back(kept[++i]);
      by_level[level].push_back(std::move(part));
    }
  }
  std::vector<ThinnedLine> thinned;
  std::size_t points = 0;
  for (const auto& [number, parts] : by_level) {
    Level level(number, area_of(parts, area), tolerance_px);
    for (const Run& part : parts)
      for (std::size_t i = 1; i < part.size(); ++i) {
        points += level.add(part[i - 1].at, part[i].at, i > 1);
        if (points > most_points) return std::nullopt;
      }
    thinned.push_back(level.finish());
  }
  std::erase_if(thinned, [](const ThinnedLine& each) { return each.stretches.empty(); });
  return thinned;
}

std::vector<Vector2d> thin_points(const std::vector<Vector2d>& points_px, double tolerance_px) {
  require(tolerance_px > 0, "thin_points: the tolerance is not positive");
  const double cell_px = tolerance_px / std::numbers::sqrt2;
  std::set<std::pair<double, double>> taken;
  std::vector<Vector2d> kept;
  for (const Vector2d& point : points_px)
    if (point.allFinite() &&
        taken.emplace(std::floor(point[0] / cell_px), std::floor(point[1] / cell_px)).second)
      kept.push_back(point);
  return kept;
}

}  // namespace placegraph
