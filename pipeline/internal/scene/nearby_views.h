#pragma once
#include <placegraph/frontend/internal/floor_plan/plane_sweep.h>
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

/// Images of keyframes that stand near one: a nearer and a farther one before it, and after it.
class NearbyViews {
 public:
  /// Reads frames by `frame_of`; the map must outlive the views.
  NearbyViews(const Map& map, std::function<Frame(const Keyframe&)> frame_of,
              const NearbyViewOptions& options);

  /// A keyframe's own frame. The reference holds until the next call.
  const Frame& frame(const Keyframe& keyframe);
  /// Views from about a keyframe of the map, by the poses of the map: those before it, nearest
  /// first, then those after it; none where the camera has not moved. Throws ArgumentError for a
  /// keyframe that is not the map's.
  std::vector<SweptView> of(const Keyframe& keyframe);

 private:
  const Map& map_;
  std::function<Frame(const Keyframe&)> frame_of_;
  NearbyViewOptions options_;
  std::set<KeyframeId> connected_;
  std::deque<std::pair<KeyframeId, Frame>> read_;  ///< the last ones
};

}  // namespace placegraph
