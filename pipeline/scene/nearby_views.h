#pragma once
#include <placegraph/frontend/floor_plan/plane_sweep.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/scene/scene_map_options.h>

#include <deque>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace placegraph {

/// Images of keyframes near a given one: a nearer and a farther one before it, and after it.
class NearbyViews {
 public:
  /// Reads frames with `frame_of`; the map must outlive the object.
  NearbyViews(const Map& map, std::function<Frame(const Keyframe&)> frame_of,
              const NearbyViewOptions& options);

  /// Frame of a keyframe. The reference is valid until the next call.
  const Frame& frame(const Keyframe& keyframe);
  /// Views near a keyframe of the map, with the poses of the map: those before it, nearest first,
  /// then those after it; none if the camera has not moved. Throws ArgumentError for a keyframe
  /// that is not in the map.
  std::vector<SweptView> of(const Keyframe& keyframe);

 private:
  const Map& map_;
  std::function<Frame(const Keyframe&)> frame_of_;
  NearbyViewOptions options_;
  std::set<KeyframeId> connected_;
  std::deque<std::pair<KeyframeId, Frame>> read_;  ///< last frames that were read
};

}  // namespace placegraph
