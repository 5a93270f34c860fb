#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/scene/map_keyframes.h>
#include <placegraph/pipeline/scene/nearby_views.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

constexpr std::ptrdiff_t kFarthest = 10;  // keyframes before or after
// Frames that are kept: those of a keyframe's views, with a margin of four. Chosen.
constexpr std::size_t kMostRead = 2 * kFarthest + 4;

}  // namespace

NearbyViews::NearbyViews(const Map& map, std::function<Frame(const Keyframe&)> frame_of,
                         const NearbyViewOptions& options)
    : map_(map),
      frame_of_(std::move(frame_of)),
      options_(options),
      connected_(connected_keyframes(map)) {
  options_.check();
}

const Frame& NearbyViews::frame(const Keyframe& keyframe) {
  for (const auto& [id, frame] : read_)
    if (id == keyframe.id) return frame;
  if (read_.size() >= kMostRead) read_.pop_front();
  return read_.emplace_back(keyframe.id, frame_of_(keyframe)).second;
}

std::vector<SweptView> NearbyViews::of(const Keyframe& keyframe) {
  std::vector<SweptView> views;
  const auto found = std::find_if(map_.keyframes.begin(), map_.keyframes.end(),
                                  [&](const Keyframe& other) { return other.id == keyframe.id; });
  const auto index = found - map_.keyframes.begin();
  const auto count = static_cast<std::ptrdiff_t>(map_.keyframes.size());
  require(index < count, "nearby views: the keyframe must be one of the map's");
  if (!connected_.count(keyframe.id)) return views;
  const SE3 T_map_cam = camera_pose(map_, keyframe.id);
  for (const int direction : {-1, 1}) {
    double wanted_m = options_.near_m;
    for (auto i = index + direction; i >= 0 && i < count && std::abs(i - index) <= kFarthest;
         i += direction) {
      const Keyframe& other = map_.keyframes[static_cast<std::size_t>(i)];
      if (!connected_.count(other.id)) break;
      const SE3 T_view_cam = camera_pose(map_, other.id).inverse() * T_map_cam;
      const double moved_m = T_view_cam.translation().norm();
      if (T_view_cam.rotation().log().norm() > deg_to_rad(options_.rotation_deg)) break;
      if (moved_m > 2 * options_.far_m) break;
      if (moved_m < wanted_m) continue;
      views.push_back({frame(other).image, T_view_cam});
      if (moved_m >= options_.far_m) break;
      wanted_m = options_.far_m;
    }
  }
  return views;
}

}  // namespace placegraph
