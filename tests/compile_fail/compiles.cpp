// What the other sources of this folder do wrong, done right: so they fail for their mistakes
// alone.
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map.h>

namespace placegraph {

void take(KeyframeId) {}

bool right(FrameId frame, KeyframeId keyframe, LandmarkId landmark, const Map& map,
           SlidingWindow& window, PlaceId place, RelativePoseConstraint& edge, LineId line,
           PlaneId plane) {
  take(keyframe);
  FrameId other(3);
  other = FrameId(4);
  ++other;
  const std::int64_t number = keyframe.value();
  window.remove_observation(keyframe, landmark);
  edge.from = node_of_place(place);
  if (!map.place_graph.find(place_of_node(edge.from))) return false;
  if (!window.line(line) || !window.plane(plane)) return false;
  return other == frame && number + 1 > 0 && map.find_keyframe(keyframe) != nullptr;
}

}  // namespace placegraph
