#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/map/map_occupancy.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace placegraph {
namespace {

/// Evidence of one ray, log odds.
constexpr float kRayEnds = 0.85F, kRayPasses = -0.4F, kMostEvidence = 4, kCameraPassed = -4,
                kWallStands = 4;

/// The mean of the cameras' up directions in the map.
Eigen::Vector3d mean_up(const std::vector<PosedKeyframe>& keyframes) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const PosedKeyframe& posed : keyframes) up -= posed.T_map_cam.rotation().matrix().col(1);
  return up.norm() > 1e-6 ? Eigen::Vector3d(up.normalized()) : Eigen::Vector3d(0, -1, 0);
}

/// Rotation from the map to a level frame, x forward, y left, z up.
SO3 level_rotation(const Eigen::Vector3d& up) {
  Eigen::Vector3d forward = Eigen::Vector3d::UnitZ() - up[2] * up;
  if (forward.norm() < 0.5) forward = Eigen::Vector3d::UnitX() - up[0] * up;
  forward.normalize();
  Eigen::Matrix3d R;
  R << forward.transpose(), up.cross(forward).transpose(), up.transpose();
  return SO3::from_matrix(R);
}

/// A ray from a camera to a landmark, in the level frame.
struct LevelRay {
  Eigen::Vector3d from, to;
  double sigma = 0;  ///< standard deviation of its end
};

std::vector<LevelRay> level_rays(const MapGeometry& geometry, const SO3& R_grid_map,
                                 double max_sigma_m) {
  std::unordered_map<LandmarkId, const PlacedLandmark*> landmarks;
  for (const PlacedLandmark& landmark : geometry.landmarks)
    if (landmark.sigma && *landmark.sigma <= max_sigma_m) landmarks.emplace(landmark.id, &landmark);
  std::vector<LevelRay> rays;
  for (const PosedKeyframe& posed : geometry.keyframes)
    for (const LandmarkObservation& seen : posed.keyframe->observations)
      if (const auto found = landmarks.find(seen.landmark); found != landmarks.end())
        rays.push_back({R_grid_map * posed.T_map_cam.translation(),
                        R_grid_map * found->second->p_map, *found->second->sigma});
  return rays;
}

/// The evidence on each cell.
class EvidenceGrid {
 public:
  EvidenceGrid(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double cell_m)
      : cell_m_(cell_m) {
    // 400 MB of log odds. Chosen.
    constexpr double kMostCells = 1e8;
    const Eigen::Array2d first = (low.array() / cell_m).floor();
    const Eigen::Array2d size = (high.array() / cell_m).floor() - first + 1;
    require(size.prod() <= kMostCells,
            fmt::format("occupancy grid: {:.0f} x {:.0f} cells of {} m are too many", size[0],
                        size[1], cell_m));
    low_ = first * cell_m;
    columns_ = static_cast<int>(size[0]);
    rows_ = static_cast<int>(size[1]);
    log_odds_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0F);
  }

  /// The cell of a point; -1 outside.
  std::ptrdiff_t cell(const Eigen::Vector2d& p) const {
    const auto column = static_cast<int>(std::floor((p[0] - low_[0]) / cell_m_));
    const auto row = static_cast<int>(std::floor((p[1] - low_[1]) / cell_m_));
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return -1;
    return std::ptrdiff_t{row} * columns_ + column;
  }
  void add(const Eigen::Vector2d& p, float evidence) {
    if (const std::ptrdiff_t at = cell(p); at >= 0) add_to(at, evidence);
  }
  /// Adds evidence to every cell between two points once, as far as steps of half a cell enter it.
  void add_line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, float evidence) {
    const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / (0.5 * cell_m_))));
    std::ptrdiff_t before = -1;
    for (int i = 0; i <= steps; ++i) {
      const std::ptrdiff_t at = cell(a + (b - a) * (static_cast<double>(i) / steps));
      if (at >= 0 && at != before) add_to(at, evidence);
      before = at;
    }
  }
  /// Adds evidence to the cells whose centres are within a disc.
  void add_disc(const Eigen::Vector2d& centre, double radius, float evidence) {
    const int reach = static_cast<int>(std::ceil(radius / cell_m_));
    for (int row = -reach; row <= reach; ++row)
      for (int column = -reach; column <= reach; ++column) {
        const Eigen::Vector2d offset = cell_m_ * Eigen::Vector2d(column, row);
        if (offset.norm() <= radius) add(centre + offset, evidence);
      }
  }

  OccupancyGrid grid() const {
    // Log odds of a probability of 0.57. Chosen.
    constexpr float kCertain = 0.3F;
    OccupancyGrid grid;
    grid.cell_m = cell_m_;
    grid.low = low_;
    grid.columns = columns_;
    grid.rows = rows_;
    grid.cells.reserve(log_odds_.size());
    for (const float log_odds : log_odds_)
      grid.cells.push_back(log_odds > kCertain    ? CellState::kOccupied
                           : log_odds < -kCertain ? CellState::kFree
                                                  : CellState::kUnknown);
    return grid;
  }

 private:
  void add_to(std::ptrdiff_t at, float evidence) {
    float& log_odds = log_odds_[static_cast<std::size_t>(at)];
    log_odds = std::clamp(log_odds + evidence, -kMostEvidence, kMostEvidence);
  }

  double cell_m_;
  Eigen::Vector2d low_;
  int columns_ = 0, rows_ = 0;
  std::vector<float> log_odds_;
};

/// The part of a ray that is within the band of heights and the range, as shares of its length.
double share_in_band(const LevelRay& ray, const MapOccupancyOptions& options) {
  const Eigen::Vector3d d = ray.to - ray.from;
  double share = 1;
  if (d[2] > options.above_m) share = options.above_m / d[2];
  if (d[2] < -options.below_m) share = -options.below_m / d[2];
  const double length = d.norm();
  return length > options.range_m ? std::min(share, options.range_m / length) : share;
}

/// The ends of a wall on the floor of the level frame.
using LevelWall = std::array<Eigen::Vector2d, 2>;

/// The walls of a floor plan; none without one.
std::vector<LevelWall> level_walls(const FloorPlan* plan, const SO3& R_grid_map) {
  std::vector<LevelWall> walls;
  if (!plan) return walls;
  const SO3 R_grid_plan = R_grid_map * plan->R_plan_map.inverse();
  const auto on_floor = [&](const Eigen::Vector2d& p) {
    return Eigen::Vector2d((R_grid_plan * Eigen::Vector3d(p[0], 0, p[1])).head<2>());
  };
  for (const PlanWall& wall : plan->walls) walls.push_back({on_floor(wall.a), on_floor(wall.b)});
  return walls;
}

/// Positions of the camera, with nothing where a frame is lost.
std::vector<std::optional<Eigen::Vector2d>> level_path(const Map& map, int component,
                                                       const SO3& R_grid_map) {
  std::vector<std::optional<Eigen::Vector2d>> path;
  for (const StampedPose& pose : map.trajectory_optimized(component).poses) {
    path.emplace_back();
    if (pose.T_world_body)
      path.back() = (R_grid_map * Eigen::Vector3d(pose.T_world_body->translation())).head<2>();
  }
  return path;
}

void add_path(const std::vector<std::optional<Eigen::Vector2d>>& path, double radius_m,
              double cell_m, EvidenceGrid& evidence) {
  std::optional<Eigen::Vector2d> before;
  for (const auto& position : path) {
    if (position) {
      const Eigen::Vector2d from = before.value_or(*position);
      const int steps =
          std::max(1, static_cast<int>(std::ceil((*position - from).norm() / cell_m)));
      for (int i = 0; i <= steps; ++i)
        evidence.add_disc(from + (*position - from) * (static_cast<double>(i) / steps), radius_m,
                          kCameraPassed);
    }
    before = position;
  }
}

}  // namespace

MapOccupancy occupancy_of(const Map& map, int component, const MapOccupancyOptions& options,
                          const FloorPlan* plan) {
  require(std::isfinite(options.cell_m) && options.cell_m > 0,
          "occupancy grid: the side of a cell is not positive");
  MapOccupancy result;
  const MapGeometry geometry = geometry_of(map, component);
  if (!map.metric || geometry.keyframes.empty()) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                      map.metric ? "nothing has a pose" : "the map is not metric");
    return result;
  }
  const SO3 R_grid_map = level_rotation(
      plan ? plan->R_plan_map.inverse() * Eigen::Vector3d(0, -1, 0) : mean_up(geometry.keyframes));
  const std::vector<LevelRay> rays = level_rays(geometry, R_grid_map, options.max_sigma_m);
  const auto path = level_path(map, component, R_grid_map);

  const double rim = options.radius_m + options.cell_m;
  Eigen::Vector2d low = (R_grid_map * geometry.keyframes[0].T_map_cam.translation()).head<2>();
  Eigen::Vector2d high = low;
  const auto include = [&](const Eigen::Vector2d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  };
  for (const auto& position : path)
    if (position) include(*position);
  const std::vector<LevelWall> walls = level_walls(plan, R_grid_map);
  for (const LevelWall& wall : walls)
    for (const Eigen::Vector2d& end : wall) include(end);
  for (const LevelRay& ray : rays)
    include((ray.from + share_in_band(ray, options) * (ray.to - ray.from)).head<2>());

  EvidenceGrid evidence(low - Eigen::Vector2d(rim, rim), high + Eigen::Vector2d(rim, rim),
                        options.cell_m);
  for (const LevelRay& ray : rays) {
    const Eigen::Vector3d d = ray.to - ray.from;
    const double share = share_in_band(ray, options);
    const double before = std::max(options.cell_m, 2 * ray.sigma) / std::max(d.norm(), 1e-9);
    const double clear = std::min(share, 1 - before);
    if (clear > 0)
      evidence.add_line(ray.from.head<2>(), (ray.from + clear * d).head<2>(), kRayPasses);
    if (share == 1) evidence.add(ray.to.head<2>(), kRayEnds);
  }
  for (const LevelWall& wall : walls) evidence.add_line(wall[0], wall[1], kWallStands);
  add_path(path, options.radius_m, options.cell_m, evidence);
  result.grid = evidence.grid();
  result.grid.R_grid_map = R_grid_map;
  result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
