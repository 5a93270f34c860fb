#include <placegraph/frontend/floor_plan/wall_finder.h>
#include <placegraph/frontend/floor_plan/wall_fit.h>
#include <placegraph/graph/core/angle.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace placegraph {
namespace {

/// Maximum standard deviation of a point that is used. Chosen.
constexpr double kMaxPointSigma_m = 0.12;
/// Maximum angle between the normals of a point and its wall. Chosen.
constexpr double kMaxNormalAngle_deg = 15;
/// Minimum observed height of a wall, in all its parts together. Chosen.
constexpr double kMinWallHeight_m = 0.8;
/// Minimum share of wall in the height that is observed or seen through. Chosen.
constexpr double kMinWallShare = 0.6;
/// Longest gap within a wall. Chosen; less than the width of a door.
constexpr double kMaxWallGap_m = 0.3;
/// Maximum offset between pieces of one wall, caused by drift of the poses (docs/floor_plan.md).
constexpr double kMaxWallStep_m = 0.07;
/// Minimum height of the upper end of short pieces: door leaves and furniture end below it. Chosen.
constexpr double kMinShortTop_m = 2.3;

// Sides of a cell along and across a wall. Chosen.
constexpr double kAlong_m = 0.1, kOffset_m = 0.02;
constexpr int kMostLayers = 64;

/// Points that face one side, over (along, offset): the layers of height that they cover.
class SideCoverage {
 public:
  SideCoverage(const std::vector<PlacedPoint>& points, const VoxelEvidence& voxels, int axis,
               int sign, const WallFinderOptions& options)
      : voxels_(voxels), options_(options), axis_(axis), sign_(sign) {
    along_low_ = voxels.low()[1 - axis], offset_low_ = voxels.low()[axis];
    const double cells[2] = {voxels.columns() * voxels.cell_m(), voxels.rows() * voxels.cell_m()};
    alongs_ = static_cast<int>(cells[1 - axis] / kAlong_m) + 1;
    offsets_ = static_cast<int>(cells[axis] / kOffset_m) + 1;
    const double least = std::cos(deg_to_rad(kMaxNormalAngle_deg));
    for (const PlacedPoint& p : points)
      if (sign * p.normal[axis] > least && p.sigma < kMaxPointSigma_m) points_.push_back(&p);
    layers_.assign(static_cast<std::size_t>(alongs_) * offsets_, 0);
    for (const PlacedPoint* p : points_)
      if (const auto cell = cell_of(*p)) layers_[*cell] |= layer_bit(p->point[2]);
    find_walls_of_columns();
  }

  /// Selects planes one by one, those with most wall first.
  std::vector<WallPiece> pieces() {
    std::vector<WallPiece> found;
    const int band = std::max(1, static_cast<int>(options_.band_m / kOffset_m));
    while (true) {
      int best = -1, most = 0;
      for (int o = 0; o < offsets_; ++o) {
        const int count = walls_at(o);
        if (count > most) most = count, best = o;
      }
      if (best < 0 || most * kAlong_m < kMinWallLength_m) break;
      take(best, band, found);
      for (int o = std::max(0, best - 2 * band); o <= std::min(offsets_ - 1, best + 2 * band); ++o)
        for (int a = 0; a < alongs_; ++a)
          if (used_[a]) wall_[static_cast<std::size_t>(o) * alongs_ + a] = 0;
      for (int a = 0; a < alongs_; ++a) wall_[static_cast<std::size_t>(best) * alongs_ + a] = 0;
    }
    join_walls(points_, tolerance(), found);
    // Pieces of less length must reach kMinShortTop_m. Chosen.
    constexpr double kShort_m = 1.3;
    std::erase_if(found, [&](const WallPiece& piece) {
      return piece.to_m - piece.from_m < kShort_m && piece.high_m < kMinShortTop_m;
    });
    return found;
  }

 private:
  WallTolerance tolerance() const {
    return {options_.band_m, kMaxNormalAngle_deg, kMaxWallGap_m, kMaxWallStep_m};
  }
  std::uint64_t layer_bit(double z) const {
    const int layer = voxels_.layer_of(z);
    return layer < 0 || layer >= std::min(kMostLayers, voxels_.layers()) ? 0 : 1ULL << layer;
  }
  std::optional<std::size_t> cell_of(const PlacedPoint& p) const {
    const int a = static_cast<int>((p.point[1 - axis_] - along_low_) / kAlong_m);
    const int o = static_cast<int>((p.point[axis_] - offset_low_) / kOffset_m);
    if (a < 0 || o < 0 || a >= alongs_ || o >= offsets_) return std::nullopt;
    return static_cast<std::size_t>(o) * alongs_ + a;
  }
  int walls_at(int o) const {
    const auto* row = wall_.data() + static_cast<std::size_t>(o) * alongs_;
    return static_cast<int>(std::count(row, row + alongs_, 1));
  }

  /// Layers in which a ray passed behind a position of the plane.
  std::uint64_t passed_behind(int along, int offset) const {
    double at[2];
    at[1 - axis_] = along_low_ + (along + 0.5) * kAlong_m;
    at[axis_] = offset_low_ + (offset + 0.5) * kOffset_m - sign_ * 0.07;
    const int c = voxels_.column_of(at[0]), r = voxels_.row_of(at[1]);
    std::uint64_t layers = 0;
    if (!voxels_.contains(c, r)) return 0;
    for (int l = 0; l < std::min(kMostLayers, voxels_.layers()); ++l)
      if (voxels_.passes(c, r, l) >= 2 && voxels_.passes(c, r, l) > 2 * voxels_.hits(c, r, l))
        layers |= 1ULL << l;
    return layers;
  }

  void find_walls_of_columns() {
    wall_.assign(layers_.size(), 0);
    const int band = std::max(1, static_cast<int>(options_.band_m / kOffset_m));
    const int least = static_cast<int>(std::ceil(kMinWallHeight_m / voxels_.layer_m()));
    for (int a = 0; a < alongs_; ++a)
      for (int o = 0; o < offsets_; ++o) {
        const std::size_t cell = static_cast<std::size_t>(o) * alongs_ + a;
        if (layers_[cell] == 0) continue;
        std::uint64_t covered = 0;
        for (int k = std::max(0, o - band); k <= std::min(offsets_ - 1, o + band); ++k)
          covered |= layers_[static_cast<std::size_t>(k) * alongs_ + a];
        const int height = std::popcount(covered);
        if (height < least) continue;
        const std::uint64_t through = passed_behind(a, o) & ~covered;
        const int top = 63 - std::countl_zero(covered);
        const std::uint64_t over = top >= 63 ? 0 : through >> (top + 1);
        if (std::popcount(over) >= 2) continue;
        if (height < kMinWallShare * (height + std::popcount(through))) continue;
        wall_[cell] = 1;
      }
  }

  /// Adds the stretches of wall around an offset; marks their columns in `used_`.
  void take(int offset, int band, std::vector<WallPiece>& found) {
    used_.assign(alongs_, 0);
    std::vector<char> here(alongs_, 0);
    for (int o = std::max(0, offset - band / 2); o <= std::min(offsets_ - 1, offset + band / 2);
         ++o)
      for (int a = 0; a < alongs_; ++a) here[a] |= wall_[static_cast<std::size_t>(o) * alongs_ + a];
    const int gap = static_cast<int>(kMaxWallGap_m / kAlong_m + 0.5);
    for (int a = 0; a < alongs_;) {
      if (!here[a]) {
        ++a;
        continue;
      }
      int end = a, last = a;
      while (end < alongs_ && end - last <= gap) {
        if (here[end]) last = end;
        ++end;
      }
      if ((last + 1 - a) * kAlong_m >= kMinWallLength_m - 1e-9) add_piece(offset, a, last, found);
      for (int k = a; k <= last; ++k) used_[k] = 1;
      a = last + 1;
    }
  }

  void add_piece(int offset, int first, int last, std::vector<WallPiece>& found) {
    WallPiece piece;
    piece.axis = axis_, piece.sign = sign_;
    piece.from_m = along_low_ + first * kAlong_m, piece.to_m = along_low_ + (last + 1) * kAlong_m;
    piece.offset_m = offset_low_ + (offset + 0.5) * kOffset_m;
    if (fit_wall(points_, tolerance(), piece)) found.push_back(piece);
  }

  const VoxelEvidence& voxels_;
  const WallFinderOptions& options_;
  int axis_, sign_, alongs_ = 0, offsets_ = 0;
  double along_low_ = 0, offset_low_ = 0;
  std::vector<const PlacedPoint*> points_;
  std::vector<std::uint64_t> layers_;
  std::vector<char> wall_, used_;
};

}  // namespace

std::vector<WallPiece> find_walls(const std::vector<PlacedPoint>& points,
                                  const VoxelEvidence& voxels, const WallFinderOptions& options) {
  options.check();
  std::vector<WallPiece> walls;
  for (int axis = 0; axis < 2; ++axis)
    for (const int sign : {-1, 1}) {
      const auto found = SideCoverage(points, voxels, axis, sign, options).pieces();
      walls.insert(walls.end(), found.begin(), found.end());
    }
  return walls;
}

std::vector<WallPiece> cut_at_path(const std::vector<WallPiece>& walls,
                                   const std::vector<Eigen::Vector3d>& path, double reach_m,
                                   double min_length_m) {
  std::vector<WallPiece> left;
  for (const WallPiece& wall : walls) {
    std::vector<std::pair<double, double>> stretches{{wall.from_m, wall.to_m}};
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Eigen::Vector3d &p = path[i - 1], &q = path[i];
      const double a = p[wall.axis] - wall.offset_at(p[1 - wall.axis]),
                   b = q[wall.axis] - wall.offset_at(q[1 - wall.axis]);
      constexpr double kBroken_m = 3;  // between two stretches of the path
      if ((a < 0) == (b < 0) || (q - p).norm() > kBroken_m) continue;
      const double at = (b * p[1 - wall.axis] - a * q[1 - wall.axis]) / (b - a);
      std::vector<std::pair<double, double>> rest;
      for (const auto& [from, to] : stretches) {
        if (at < from - reach_m || at > to + reach_m) {
          rest.emplace_back(from, to);
          continue;
        }
        if (at - reach_m - from > min_length_m) rest.emplace_back(from, at - reach_m);
        if (to - at - reach_m > min_length_m) rest.emplace_back(at + reach_m, to);
      }
      stretches.swap(rest);
    }
    for (const auto& [from, to] : stretches) {
      WallPiece piece = wall;
      piece.from_m = from, piece.to_m = to;
      piece.offset_m = wall.offset_at(0.5 * (from + to));
      left.push_back(piece);
    }
  }
  return left;
}

}  // namespace placegraph
