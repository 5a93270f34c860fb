// A place looked up among the keyframes of a map.
#include <placegraph/graph/map.h>

namespace placegraph {
bool wrong(const Map& map, PlaceId place) { return map.find_keyframe(place) != nullptr; }
}  // namespace placegraph
