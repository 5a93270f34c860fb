#include <placegraph/frontend/floor_plan/plan_surfaces.h>
#include <placegraph/frontend/scene/moving_classes.h>
#include <placegraph/frontend/scene/street_labelling.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/scene/map_keyframes.h>
#include <placegraph/pipeline/scene/street_mapper.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace placegraph {
namespace {

KeyframePoses fetched(std::map<KeyframeId, SE3> poses) {
  return [poses = std::move(poses)](KeyframeId keyframe) -> std::optional<SE3> {
    const auto found = poses.find(keyframe);
    if (found == poses.end()) return std::nullopt;
    return found->second;
  };
}

}  // namespace

KeyframePoses poses_of(const Map& map) {
  std::map<KeyframeId, SE3> poses;
  for (const KeyframeId keyframe : connected_keyframes(map))
    poses.emplace(keyframe, camera_pose(map, keyframe));
  return fetched(std::move(poses));
}

KeyframePoses online_poses_of(const Map& map) {
  std::map<std::int64_t, SE3> by_stamp;
  std::map<KeyframeId, SE3> poses;
  for (const StampedPose& pose : map.trajectory_online.poses)
    if (pose.T_world_body) by_stamp.emplace(pose.stamp_ns, SE3(*pose.T_world_body));
  for (const Keyframe& keyframe : map.keyframes)
    if (const auto found = by_stamp.find(keyframe.stamp_ns); found != by_stamp.end())
      poses.emplace(keyframe.id, found->second);
  return fetched(std::move(poses));
}

StreetMapper::StreetMapper(const StreetMapperOptions& options, const Calibration& calibration,
                           SceneModel urban, SceneModel surfaces)
    : options_(options),
      calibration_(calibration),
      urban_(std::move(urban)),
      surfaces_(std::move(surfaces)) {
  options_.check();
  calibration_.check();
  require(urban_.kind == SceneModel::Kind::kUrban && surfaces_.kind == SceneModel::Kind::kSurfaces,
          "urban mapper: a model of urban classes and one of surfaces are needed");
  check(options_, urban_);
}

void StreetMapper::check(const StreetMapperOptions& options, const SceneModel& urban) {
  options.check();
  (void)moving_classes(options.labelling.moving, urban);
}

void StreetMapper::add(KeyframeId keyframe, const Frame& frame, const SE3& T_map_cam) {
  if (calibration_.baseline_m <= 0 || frame.right.empty()) return;
  const Camera& camera = calibration_.camera;
  const Image depth =
      dense_stereo(frame.image, frame.right, camera.fx, calibration_.baseline_m, options_.stereo);
  KeyframeStreetPoints observation =
      see_street(frame.colour.empty() ? frame.image : frame.colour, depth, camera,
                 calibration_.baseline_m, calibration_.camera_height_m.value_or(0), urban_,
                 surfaces_, options_.labelling)
          .observation;
  observation.keyframe = keyframe;
  if (options_.residuals) drop_seen_through(observation, depth, T_map_cam);
  last_ = Last{keyframe, depth, T_map_cam};
  add(std::move(observation));
}

/// Drops points that moved between two keyframes: points of either that the other sees through.
void StreetMapper::drop_seen_through(KeyframeStreetPoints& observation, const Image& depth_m,
                                     const SE3& T_map_cam) {
  if (!last_) return;
  const SE3 T_last_cam = last_->T_map_cam.inverse() * T_map_cam;
  const auto drop = [&](std::vector<StreetPoint>& points, const Image& other,
                        const SE3& T_other_cam) {
    const std::vector<bool> gone =
        seen_through(points, T_other_cam, other, calibration_.camera, calibration_.baseline_m);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!gone[i]) points[kept++] = points[i];
    points.resize(kept);
  };
  drop(observation.points, last_->depth_m, T_last_cam);
  for (KeyframeStreetPoints& other : observations_)
    if (other.keyframe == last_->keyframe) drop(other.points, depth_m, T_last_cam.inverse());
}

void StreetMapper::add(KeyframeStreetPoints observation) {
  const auto same = std::find_if(
      observations_.begin(), observations_.end(),
      [&](const KeyframeStreetPoints& other) { return other.keyframe == observation.keyframe; });
  if (same != observations_.end())
    *same = std::move(observation);
  else
    observations_.push_back(std::move(observation));
}

StreetMap StreetMapper::fuse(const Map& map) const {
  if (!map.metric) {
    StreetMap none;
    none.outcome = Outcome::failure(Outcome::Code::kTooFewData, "the map is not metric");
    return none;
  }
  return fuse(poses_of(map));
}

StreetMap StreetMapper::fuse(const KeyframePoses& T_map_cam, const Eigen::Vector3d& down) const {
  StreetMap none;
  none.classes = urban_.classes;
  if (calibration_.baseline_m <= 0) {
    none.outcome = Outcome::failure(Outcome::Code::kTooFewData, "a stereo camera is required");
    return none;
  }
  std::vector<std::pair<const KeyframeStreetPoints*, SE3>> placed;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const KeyframeStreetPoints& observation : observations_)
    if (const std::optional<SE3> T = T_map_cam(observation.keyframe)) {
      placed.emplace_back(&observation, *T);
      sum += T->rotation().matrix() * observation.down.cast<double>();
    }
  if (!down.isZero()) sum = down;
  if (placed.empty() || sum.norm() < 1e-6) {
    none.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no keyframe has a pose");
    return none;
  }
  // x is level and as close as possible to its previous direction.
  const Eigen::Vector3d y = sum.normalized();
  Eigen::Vector3d x = Eigen::Vector3d::UnitX() - y[0] * y;
  if (x.norm() < 0.1) x = Eigen::Vector3d::UnitZ().cross(y);
  x.normalize();
  Eigen::Matrix3d R_plan_map;
  R_plan_map << x.transpose(), y.transpose(), x.cross(y).transpose();
  StreetGrid grid(options_.grid, urban_.classes, SO3(Eigen::Quaterniond(R_plan_map)));
  for (const auto& [observation, T] : placed) grid.add(*observation, T);
  return grid.map();
}

void add_keyframes(StreetMapper& mapper, const Map& map, const StreetMapperOptions& options,
                   const std::function<Frame(const Keyframe&)>& frame_of,
                   const std::function<void(std::size_t, std::size_t)>& progress) {
  const auto chosen =
      keyframes_apart(map, options.min_step_m, deg_to_rad(options.min_rotation_deg));
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const KeyframeId id = chosen[i]->id;
    mapper.add(id, frame_of(*chosen[i]), camera_pose(map, id));
    if (progress) progress(i + 1, chosen.size());
  }
}

std::vector<std::vector<float>> class_shares(const StreetMapper& mapper, const Map& map) {
  const std::size_t n = mapper.classes().size();
  std::map<PlaceId, std::vector<float>> by_place;
  for (const KeyframeStreetPoints& observation : mapper.observations()) {
    const Keyframe* keyframe = map.find_keyframe(observation.keyframe);
    if (!keyframe) continue;
    std::vector<float>& sum = by_place[keyframe->place];
    sum.resize(n, 0);
    for (const StreetPoint& point : observation.points)
      for (std::size_t c = 0; c < n; ++c) sum[c] += observation.shares[point.region * n + c];
  }
  std::vector<std::vector<float>> shares;
  for (const Place& place : map.place_graph.places) {
    std::vector<float> of = by_place[place.id];
    float all = 0;
    for (const float share : of) all += share;
    if (!(all > 0)) of.clear();
    for (float& share : of) share /= all;
    shares.push_back(std::move(of));
  }
  return shares;
}

}  // namespace placegraph
