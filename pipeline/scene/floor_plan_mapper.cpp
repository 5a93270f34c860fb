#include <placegraph/frontend/floor_plan/building_axes.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/scene/floor_plan.h>
#include <placegraph/pipeline/scene/floor_plan_mapper.h>
#include <placegraph/pipeline/scene/map_keyframes.h>
#include <placegraph/pipeline/scene/plan_parts.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <set>

namespace placegraph {
namespace {

// Depth from images is less certain than that of a depth camera: replace points.radius_px and
// walls.band_m for it. Chosen.
constexpr int kSweptRadius_px = 16;
constexpr double kSweptBand_m = 0.1;

/// Observations in the map's frame, with the poses of the map.
struct ObservationsInMap {
  std::vector<KeyframeId> keyframes;     // keyframe of each observation
  std::vector<SE3> T_map_cam;            // camera pose of each observation
  std::vector<SurfacePoint> points;      // points of all observations
  std::vector<std::size_t> first_point;  // first point of the next observation
};

ObservationsInMap lay_out(const std::vector<KeyframeSurfacePoints>& observations, const Map& map) {
  ObservationsInMap result;
  const std::set<KeyframeId> connected = connected_keyframes(map);
  for (const KeyframeSurfacePoints& observation : observations) {
    if (!connected.count(observation.keyframe)) continue;
    const SE3 T_map_cam = camera_pose(map, observation.keyframe);
    const Eigen::Matrix3f R = T_map_cam.rotation().matrix().cast<float>();
    const Eigen::Vector3f t = T_map_cam.translation().cast<float>();
    for (const SurfacePoint& p : observation.points)
      result.points.push_back({R * p.point + t, R * p.normal, p.sigma});
    result.first_point.push_back(result.points.size());
    result.T_map_cam.push_back(T_map_cam);
    result.keyframes.push_back(observation.keyframe);
  }
  return result;
}

/// The mean of the cameras' up directions, not normalized.
Eigen::Vector3d up_of(const std::vector<SE3>& T_map_cam) {
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const SE3& T : T_map_cam) up -= T.rotation().matrix().col(1);
  return up;
}

PlacedObservations to_walls(const ObservationsInMap& observations, const SE3& T_walls_map) {
  PlacedObservations placed;
  placed.keyframes = observations.keyframes;
  const Eigen::Matrix3f R = T_walls_map.rotation().matrix().cast<float>();
  const Eigen::Vector3f t = T_walls_map.translation().cast<float>();
  std::size_t i = 0;
  for (std::size_t s = 0; s < observations.first_point.size(); ++s)
    for (; i < observations.first_point[s]; ++i) {
      const SurfacePoint& p = observations.points[i];
      placed.points.push_back({R * p.point + t, R * p.normal, p.sigma, static_cast<int>(s)});
    }
  for (const SE3& T : observations.T_map_cam) placed.path.push_back(T_walls_map * T.translation());
  return placed;
}

VoxelEvidence evidence_of(const PlacedObservations& observations, double cell_m, double layer_m) {
  Eigen::Vector3d low = observations.path.front(), high = observations.path.front();
  for (const PlacedPoint& p : observations.points) {
    low = low.cwiseMin(p.point.cast<double>());
    high = high.cwiseMax(p.point.cast<double>());
  }
  // Points above are no part of a storey. Chosen.
  constexpr double kHighest_m = 12;
  low[2] = 0, high[2] = std::min(high[2], kHighest_m);
  const Eigen::Vector3d rim(0.3, 0.3, 0);
  VoxelEvidence voxels(low - rim, high + rim, cell_m, layer_m);
  for (const PlacedPoint& p : observations.points)
    voxels.add_ray(observations.path[p.observation], p.point.cast<double>(), 0.1 + 3 * p.sigma,
                   true);
  return voxels;
}

FloorPlan fuse_observations(const std::vector<KeyframeSurfacePoints>& all, const Map& map,
                            const FloorPlanMapperOptions& options) {
  FloorPlan plan;
  const ObservationsInMap in_map = lay_out(all, map);
  if (in_map.points.empty()) {
    plan.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no surface is seen");
    return plan;
  }
  const BuildingAxes axes = find_building_axes(in_map.points, up_of(in_map.T_map_cam));
  plan.outcome = axes.outcome;
  if (!plan.outcome) return plan;
  const PlanFrame frame(axes.T_walls_map);
  plan.R_plan_map = frame.R_plan_map();
  plan.floor_y = frame.floor_y();
  plan.yaw_rad = frame.yaw_rad();

  const PlacedObservations observations = to_walls(in_map, axes.T_walls_map);
  const VoxelEvidence voxels = evidence_of(observations, options.cell_m, options.layer_m);
  // No wall is nearer to the path of the camera. Chosen.
  constexpr double kShoulder_m = 0.45;
  const std::vector<WallPiece> walls =
      cut_at_path(find_walls(observations.points, voxels, options.walls), observations.path,
                  kShoulder_m, kMinWallLength_m);
  if (walls.empty()) {
    plan.outcome = Outcome::failure(Outcome::Code::kDegenerate, "no wall is seen");
    return plan;
  }
  const std::vector<DoorPiece> doors =
      find_doors(walls, observations.points, voxels, observations.path, options.doors);
  const RoomPartition rooms =
      partition_rooms(voxels, walls, doors, observations.path, options.rooms);
  plan.walls = plan_walls(walls, frame, observations, map);
  plan.rooms = plan_rooms(rooms, voxels, frame, observations, map);
  plan.doors = plan_doors(doors, rooms, voxels, frame);
  plan.cells = plan_cells(voxels);
  return plan;
}

}  // namespace

FloorPlanMapper::FloorPlanMapper(const FloorPlanMapperOptions& options,
                                 const Calibration& calibration)
    : options_(options), calibration_(calibration) {
  options_.check();
  calibration_.check();
}

std::vector<SurfacePoint> FloorPlanMapper::points_of_monocular(const Image& image) const {
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

std::vector<SurfacePoint> FloorPlanMapper::swept_points(const Image& image,
                                                        const std::vector<SweptView>& views) const {
  const SweptDepth swept = sweep_planes(image, calibration_.camera, views, options_.sweep);
  const Camera& camera = swept.camera;
  const int shrunk = calibration_.camera.width / camera.width;
  SurfacePointOptions points = options_.points;
  points.step_px = std::max(1, points.step_px / shrunk);
  points.radius_px = std::max(2, kSweptRadius_px / shrunk);
  std::vector<SurfacePoint> seen =
      surface_points(swept.depth_m, swept.sigma_inverse, camera, SE3(), points);
  // Points outside planes may be false matches, whose rays would seem to pass through walls.
  std::erase_if(seen, [&](const SurfacePoint& p) {
    if (p.normal.squaredNorm() > 0.5F) return false;
    const auto px = camera.project(p.point.cast<double>());
    return !px || !swept.certain.at<std::uint8_t>(cvRound((*px)[1]), cvRound((*px)[0]));
  });
  return seen;
}

std::vector<SurfacePoint> FloorPlanMapper::points_of(const Frame& frame,
                                                     std::vector<SweptView> views) const {
  if (calibration_.depth && !frame.depth.empty()) {
    const DepthCamera& depth = *calibration_.depth;
    // A patch estimates its own noise; the common error of a sensor's patches is less than its
    // pixels' noise.
    return surface_points(frame.depth, depth.camera, depth.T_cam_depth, 0.2 * depth.sigma_at_1m,
                          options_.points);
  }
  if (calibration_.baseline_m > 0 && !frame.right.empty())
    views.push_back({frame.right, SE3(SO3(), {-calibration_.baseline_m, 0, 0})});
  std::vector<SurfacePoint> swept;
  if (!views.empty()) swept = swept_points(frame.image, views);
  if (!swept.empty()) return swept;
  if (calibration_.camera_height_m) return points_of_monocular(frame.image);
  return {};
}

void FloorPlanMapper::add(KeyframeId keyframe, const Frame& frame,
                          const std::vector<SweptView>& views) {
  add(KeyframeSurfacePoints{keyframe, points_of(frame, views)});
}

void FloorPlanMapper::add(KeyframeSurfacePoints observation) {
  const auto same = std::find_if(
      observations_.begin(), observations_.end(),
      [&](const KeyframeSurfacePoints& other) { return other.keyframe == observation.keyframe; });
  if (same != observations_.end())
    *same = std::move(observation);
  else
    observations_.push_back(std::move(observation));
}

FloorPlan FloorPlanMapper::fuse(const Map& map) const {
  if (!map.metric) {
    FloorPlan none;
    none.outcome = Outcome::failure(Outcome::Code::kTooFewData, "the map is not metric");
    return none;
  }
  FloorPlanMapperOptions options = options_;
  if (!calibration_.depth) options.walls.band_m = kSweptBand_m;
  return fuse_observations(observations_, map, options);
}

FloorPlan map_floor_plan(const Map& map, const Calibration& calibration,
                         const std::function<Frame(const Keyframe&)>& frame_of,
                         const FloorPlanMapperOptions& options) {
  FloorPlanMapper mapper(options, calibration);
  if (!map.metric) return mapper.fuse(map);  // with an outcome that gives the reason
  NearbyViews nearby(map, frame_of, options.views);
  for (const Keyframe* keyframe :
       keyframes_apart(map, options.min_step_m, deg_to_rad(options.min_rotation_deg))) {
    std::vector<SweptView> views;
    if (!calibration.depth) views = nearby.of(*keyframe);
    mapper.add(keyframe->id, nearby.frame(*keyframe), views);
  }
  return mapper.fuse(map);
}

}  // namespace placegraph
