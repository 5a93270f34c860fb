#include <placegraph/frontend/floor_plan/building_axes.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/scene/indoor_mapper.h>
#include <placegraph/pipeline/scene/map_keyframes.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <set>

namespace placegraph {
namespace {

/// Sights laid out in one frame, and what comes of it.
class Fusion {
 public:
  Fusion(const IndoorMapperOptions& options, const Map& map) : options_(options), map_(map) {}

  void lay_out(const std::vector<SurfaceSight>& sights) {
    const std::set<std::int64_t> connected = connected_keyframes(map_);
    for (const SurfaceSight& sight : sights) {
      if (!connected.count(sight.keyframe)) continue;
      const SE3 T_map_cam = camera_pose(map_, sight.keyframe);
      const Eigen::Matrix3f R = T_map_cam.rotation().matrix().cast<float>();
      const Eigen::Vector3f t = T_map_cam.translation().cast<float>();
      for (const SurfacePoint& p : sight.points)
        points_.push_back({R * p.point + t, R * p.normal, p.sigma});
      first_point_.push_back(points_.size());
      poses_.push_back(T_map_cam);
      keyframes_.push_back(sight.keyframe);
    }
  }

  IndoorMap fuse() {
    IndoorMap plan;
    if (points_.empty()) {
      plan.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no surface is seen");
      return plan;
    }
    Eigen::Vector3d up = Eigen::Vector3d::Zero();
    for (const SE3& T : poses_) up -= T.rotation().matrix().col(1);
    const BuildingAxes axes = find_building_axes(points_, up);
    plan.outcome = axes.outcome;
    if (!plan.outcome) return plan;
    T_walls_map_ = axes.T_walls_map;
    set_plan_frame(plan);
    place_points();
    const VoxelEvidence voxels = look();
    constexpr double kShoulder_m = 0.45;
    walls_ = cut_at_path(find_walls(placed_, voxels, options_.walls), path_, kShoulder_m,
                         options_.walls.min_length_m);
    if (walls_.empty()) {
      plan.outcome = Outcome::failure(Outcome::Code::kDegenerate, "no wall is seen");
      return plan;
    }
    doors_ = find_doors(walls_, placed_, voxels, path_, options_.doors);
    rooms_ = partition_rooms(voxels, walls_, doors_, path_, options_.rooms);
    tell_walls(plan);
    tell_rooms(voxels, plan);
    tell_doors(voxels, plan);
    tell_cells(voxels, plan);
    return plan;
  }

 private:
  /// The plan frame is the map's, turned as little as makes its y the building's vertical.
  void set_plan_frame(IndoorMap& plan) {
    const Eigen::Vector3d down = -T_walls_map_.rotation().matrix().row(2).transpose();
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(down, Eigen::Vector3d::UnitY());
    plan.R_plan_map = SO3(turn);
    R_plan_walls_ = turn.toRotationMatrix() * T_walls_map_.rotation().matrix().transpose();
    t_plan_walls_ = turn * T_walls_map_.inverse().translation();
    plan.floor_y = t_plan_walls_[1];
    plan.yaw_rad = std::atan2(R_plan_walls_(2, 0), R_plan_walls_(0, 0));
  }

  /// (x, z) of the plan of a point in the frame of the walls.
  Eigen::Vector2d plan_of(const Eigen::Vector2d& p) const {
    const Eigen::Vector3d q = R_plan_walls_ * Eigen::Vector3d(p[0], p[1], 0) + t_plan_walls_;
    return {q[0], q[2]};
  }
  static Eigen::Vector2d on(int axis, double offset, double along) {
    return axis == 0 ? Eigen::Vector2d(offset, along) : Eigen::Vector2d(along, offset);
  }

  void place_points() {
    const Eigen::Matrix3f R = T_walls_map_.rotation().matrix().cast<float>();
    const Eigen::Vector3f t = T_walls_map_.translation().cast<float>();
    std::size_t i = 0;
    for (std::size_t s = 0; s < first_point_.size(); ++s)
      for (; i < first_point_[s]; ++i)
        placed_.push_back({R * points_[i].point + t, R * points_[i].normal, points_[i].sigma,
                           static_cast<int>(s)});
    for (const SE3& T : poses_) path_.push_back(T_walls_map_ * T.translation());
  }

  VoxelEvidence look() const {
    Eigen::Vector3d low = path_.front(), high = path_.front();
    for (const PlacedPoint& p : placed_) {
      low = low.cwiseMin(p.point.cast<double>());
      high = high.cwiseMax(p.point.cast<double>());
    }
    constexpr double kHighest_m = 12;
    low[2] = 0, high[2] = std::min(high[2], kHighest_m);
    const Eigen::Vector3d rim(0.3, 0.3, 0);
    VoxelEvidence voxels(low - rim, high + rim, options_.cell_m, options_.layer_m);
    for (const PlacedPoint& p : placed_)
      voxels.add_ray(path_[p.sight], p.point.cast<double>(), 0.1 + 3 * p.sigma, true);
    return voxels;
  }

  void tell_walls(IndoorMap& plan) const {
    for (const WallPiece& piece : walls_) {
      IndoorWall wall;
      wall.a = plan_of(on(piece.axis, piece.offset_at(piece.from_m), piece.from_m));
      wall.b = plan_of(on(piece.axis, piece.offset_at(piece.to_m), piece.to_m));
      const Eigen::Vector2d along = (wall.b - wall.a).normalized();
      wall.normal = Eigen::Vector2d(-along[1], along[0]);
      const Eigen::Vector2d side = plan_of(on(piece.axis, piece.sign, 0)) - plan_of({0, 0});
      if (wall.normal.dot(side) < 0) wall.normal = -wall.normal;
      wall.sigma_m = piece.sigma_m, wall.low_m = piece.low_m, wall.high_m = piece.high_m;
      wall.sights = piece.count;
      const Keyframe* keyframe = map_.find_keyframe(keyframes_[piece.sight]);
      if (keyframe) wall.place = keyframe->place;
      plan.walls.push_back(wall);
    }
  }

  int room_at(const VoxelEvidence& voxels, const Eigen::Vector2d& p) const {
    const int c = voxels.column_of(p[0]), r = voxels.row_of(p[1]);
    return voxels.contains(c, r) ? rooms_.room_of_cell.at<int>(r, c) - 1 : -1;
  }

  void tell_rooms(const VoxelEvidence& voxels, IndoorMap& plan) const {
    const auto polygon = [&](const std::vector<Eigen::Vector2d>& points) {
      std::vector<Eigen::Vector2d> result;
      for (const Eigen::Vector2d& p : points) result.push_back(plan_of(p));
      return result;
    };
    int corridors = 0, others = 0;
    for (const RoomPartition::Room& told : rooms_.rooms) {
      IndoorRoom room;
      room.outline = polygon(told.outline);
      for (const auto& hole : told.holes) room.holes.push_back(polygon(hole));
      room.area_m2 = told.area_m2;
      // Several times as long as wide.
      const bool corridor = told.area_m2 > 5 * told.width_m * told.width_m && told.width_m < 4;
      room.label =
          corridor ? "corridor " + std::to_string(++corridors) : "room " + std::to_string(++others);
      plan.rooms.push_back(std::move(room));
    }
    for (const Eigen::Vector3d& p : path_)
      if (const int room = room_at(voxels, p.head<2>()); room >= 0) plan.rooms[room].entered = true;
    for (const Place& place : map_.place_graph.places) {
      const int room = room_at(voxels, (T_walls_map_ * place.T_map_place.translation()).head<2>());
      if (room >= 0) plan.rooms[room].places.push_back(place.id);
    }
    std::vector<std::vector<double>> ceilings(plan.rooms.size());
    for (const PlacedPoint& p : placed_) {
      if (p.normal[2] > -0.95F || p.point[2] < 1.8F) continue;
      const int room = room_at(voxels, p.point.head<2>().cast<double>());
      if (room >= 0) ceilings[room].push_back(p.point[2]);
    }
    for (std::size_t i = 0; i < ceilings.size(); ++i)
      if (ceilings[i].size() >= 20) plan.rooms[i].ceiling_m = median_of(ceilings[i]);
  }

  void tell_doors(const VoxelEvidence& voxels, IndoorMap& plan) const {
    for (const DoorPiece& piece : doors_) {
      IndoorDoor door;
      door.a = plan_of(on(piece.axis, piece.offset_m, piece.from_m));
      door.b = plan_of(on(piece.axis, piece.offset_m, piece.to_m));
      door.height_m = piece.head_m, door.closed = piece.closed;
      const double middle = 0.5 * (piece.from_m + piece.to_m);
      for (int side = 0; side < 2; ++side)
        for (const double way : {0.1, 0.2, 0.35, 0.5}) {
          const double at = piece.offset_m + piece.sign * (side ? -way - 0.1 : way);
          if (door.rooms[side] < 0) door.rooms[side] = room_at(voxels, on(piece.axis, at, middle));
        }
      plan.doors.push_back(door);
    }
  }

  /// What stands at any height, in cells of twice the size.
  void tell_cells(const VoxelEvidence& voxels, IndoorMap& plan) const {
    constexpr double kHit = 0.85, kPass = 0.4, kMost = 5;
    IndoorMap::Cells& cells = plan.cells;
    cells.size_m = 2 * voxels.cell_m();
    cells.low = voxels.low().head<2>();
    cells.columns = voxels.columns() / 2, cells.rows = voxels.rows() / 2;
    cells.log_odds.assign(static_cast<std::size_t>(cells.columns) * cells.rows, 0.0F);
    const int first = std::max(0, voxels.layer_of(0.2)), last = voxels.layer_of(2.0);
    for (int r = 0; r < 2 * cells.rows; ++r)
      for (int c = 0; c < 2 * cells.columns; ++c) {
        double sum = 0;
        for (int l = first; l <= std::min(last, voxels.layers() - 1); ++l)
          sum += kHit * voxels.hits(c, r, l) - kPass * voxels.passes(c, r, l);
        float& cell = cells.log_odds[static_cast<std::size_t>(r / 2) * cells.columns + c / 2];
        cell = static_cast<float>(std::clamp(cell + sum, -kMost, kMost));
      }
  }

  const IndoorMapperOptions& options_;
  const Map& map_;
  std::vector<SurfacePoint> points_;      // in the map's frame, by sight
  std::vector<std::size_t> first_point_;  // of the next sight
  std::vector<SE3> poses_;
  std::vector<std::int64_t> keyframes_;
  SE3 T_walls_map_;
  Eigen::Matrix3d R_plan_walls_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t_plan_walls_ = Eigen::Vector3d::Zero();
  std::vector<PlacedPoint> placed_;
  std::vector<Eigen::Vector3d> path_;
  std::vector<WallPiece> walls_;
  std::vector<DoorPiece> doors_;
  RoomPartition rooms_;
};

}  // namespace

void IndoorMapperOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, IndoorMapperOptions& o) {
  field.group("points", o.points, "surface points of a depth image");
  field.group("sweep", o.sweep, "depth from views of known motion");
  field.group("views", o.views, "that depth is swept from");
  field.group("floor", o.floor, "surfaces from one eye that has not moved");
  field.group("orientation", o.orientation, "orientation maps, for one eye");
  field("swept_radius_px", o.swept_radius_px, "points.radius_px for depth from images", {2, 50});
  field("swept_band_m", o.swept_band_m, "walls.band_m for depth from images", {0.02, 1});
  field("min_step_m", o.min_step_m, "keyframes nearer to the last one used tell nothing new",
        {0, 10});
  field("min_turn_deg", o.min_turn_deg, "unless they are turned by so much", {0, 180});
  field("cell_m", o.cell_m, "of the cells that walls and rooms are found from", {0.01, 1});
  field("layer_m", o.layer_m, "height of the cells", {0.05, 1});
  field.group("walls", o.walls, "upright surfaces up to the ceiling");
  field.group("doors", o.doors, "passages and leaves");
  field.group("rooms", o.rooms, "parts of the free space");
}

IndoorMapper::IndoorMapper(const IndoorMapperOptions& options, const Calibration& calibration)
    : options_(options), calibration_(calibration) {
  options_.check();
  calibration_.check();
}

std::vector<SurfacePoint> IndoorMapper::points_of_one_eye(const Image& image) const {
  const std::vector<LineSegment> segments = segments_of(detect_segments(image, {}));
  Random random(0);
  const SceneDirections scene = find_scene_directions(segments, calibration_.camera, {}, random);
  if (scene.frames.empty()) return {};
  const ManhattanFrame& frame = scene.frames[0];
  const OrientationMap map = compute_orientation_map(segments, frame.axis, calibration_.camera,
                                                     frame.R_cam_manhattan, options_.orientation);
  return surface_points_on_floor(map, segments, frame.axis, calibration_.camera,
                                 frame.R_cam_manhattan, *calibration_.camera_height_m,
                                 options_.floor);
}

std::vector<SurfacePoint> IndoorMapper::swept_points(const Image& image,
                                                     const std::vector<SweptView>& views) const {
  const SweptDepth swept = sweep_planes(image, calibration_.camera, views, options_.sweep);
  const Camera& camera = swept.camera;
  const int shrunk = calibration_.camera.width / camera.width;
  SurfacePointOptions points = options_.points;
  points.step_px = std::max(1, points.step_px / shrunk);
  points.radius_px = std::max(2, options_.swept_radius_px / shrunk);
  std::vector<SurfacePoint> seen =
      surface_points(swept.depth_m, swept.sigma_inverse, camera, SE3(), points);
  // What is no part of a plane may be a false match, whose ray would be seen to pass through walls.
  std::erase_if(seen, [&](const SurfacePoint& p) {
    if (p.normal.squaredNorm() > 0.5F) return false;
    const auto px = camera.project(p.point.cast<double>());
    return !px || !swept.certain.at<std::uint8_t>(cvRound((*px)[1]), cvRound((*px)[0]));
  });
  return seen;
}

std::vector<SurfacePoint> IndoorMapper::points_of(const Frame& frame,
                                                  std::vector<SweptView> views) const {
  if (calibration_.depth && !frame.depth.empty()) {
    const DepthCamera& depth = *calibration_.depth;
    // The patch tells its own noise; what a sensor's patches share is less than its pixels' noise.
    return surface_points(frame.depth, depth.camera, depth.T_cam_depth, 0.2 * depth.sigma_at_1m,
                          options_.points);
  }
  if (calibration_.baseline_m > 0 && !frame.right.empty())
    views.push_back({frame.right, SE3(SO3(), {-calibration_.baseline_m, 0, 0})});
  std::vector<SurfacePoint> swept;
  if (!views.empty()) swept = swept_points(frame.image, views);
  if (!swept.empty()) return swept;
  if (calibration_.camera_height_m) return points_of_one_eye(frame.image);
  return {};
}

void IndoorMapper::add(std::int64_t keyframe, const Frame& frame,
                       const std::vector<SweptView>& views) {
  add(SurfaceSight{keyframe, points_of(frame, views)});
}

void IndoorMapper::add(SurfaceSight sight) {
  const auto same = std::find_if(sights_.begin(), sights_.end(), [&](const SurfaceSight& other) {
    return other.keyframe == sight.keyframe;
  });
  if (same != sights_.end())
    *same = std::move(sight);
  else
    sights_.push_back(std::move(sight));
}

IndoorMap IndoorMapper::fuse(const Map& map) const {
  if (!map.metric) {
    IndoorMap none;
    none.outcome = Outcome::failure(Outcome::Code::kTooFewData, "the map's unit is not the metre");
    return none;
  }
  IndoorMapperOptions options = options_;
  if (!calibration_.depth) options.walls.band_m = options.swept_band_m;
  Fusion fusion(options, map);
  fusion.lay_out(sights_);
  return fusion.fuse();
}

void label_places(const IndoorMap& plan, PlaceGraph& places) {
  for (Place& place : places.places)
    for (const IndoorRoom& room : plan.rooms)
      if (std::count(room.places.begin(), room.places.end(), place.id) &&
          !std::count(place.labels.begin(), place.labels.end(), room.label))
        place.labels.push_back(room.label);
}

IndoorMap map_indoors(const Map& map, const Calibration& calibration,
                      const std::function<Frame(const Keyframe&)>& frame_of,
                      const IndoorMapperOptions& options) {
  IndoorMapper mapper(options, calibration);
  if (!map.metric) return mapper.fuse(map);  // says so
  NearbyViews nearby(map, frame_of, options.views);
  for (const Keyframe* keyframe :
       keyframes_apart(map, options.min_step_m, deg_to_rad(options.min_turn_deg))) {
    std::vector<SweptView> views;
    if (!calibration.depth) views = nearby.of(*keyframe);
    mapper.add(keyframe->id, nearby.frame(*keyframe), views);
  }
  return mapper.fuse(map);
}

}  // namespace placegraph
