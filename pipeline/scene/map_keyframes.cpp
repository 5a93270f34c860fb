#include <placegraph/pipeline/scene/map_keyframes.h>

namespace placegraph {
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
