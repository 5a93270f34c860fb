#include <placegraph/pipeline/scene/map_keyframes.h>

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

SE3 camera_pose(const Map& map, KeyframeId keyframe) {
  const Sim3 S = map.S_map_keyframe(keyframe);
  return {S.rotation(), S.translation()};
}

std::set<KeyframeId> connected_keyframes(const Map& map) {
  const std::vector<int> components = map.place_graph.joined_components();
  const int main = map.main_component();
  std::set<PlaceId> places;
  std::set<KeyframeId> keyframes;
  for (std::size_t i = 0; i < components.size(); ++i)
    if (components[i] == main) places.insert(map.place_graph.places[i].id);
  for (const Keyframe& keyframe : map.keyframes)
    if (places.count(keyframe.place)) keyframes.insert(keyframe.id);
  return keyframes;
}

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

std::vector<const Keyframe*> keyframes_apart(const Map& map, double step_m, double rotation_rad) {
  std::vector<const Keyframe*> chosen;
  std::optional<SE3> last;
  for (const Keyframe& keyframe : map.keyframes) {
    const SE3 T_map_cam = camera_pose(map, keyframe.id);
    if (last) {
      const SE3 step = last->inverse() * T_map_cam;
      if (step.translation().norm() < step_m && step.rotation().log().norm() < rotation_rad)
        continue;
    }
    last = T_map_cam;
    chosen.push_back(&keyframe);
  }
  return chosen;
}

}  // namespace placegraph
