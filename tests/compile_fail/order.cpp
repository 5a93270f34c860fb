// Ids of two kinds put into an order.
#include <placegraph/graph/core/ids.h>

namespace placegraph {
bool wrong(PlaceId place, KeyframeId keyframe) { return place < keyframe; }
}  // namespace placegraph
