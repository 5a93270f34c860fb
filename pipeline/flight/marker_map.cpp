#include <placegraph/pipeline/flight/marker_map.h>

namespace placegraph {

NodeId marker_node(int id) {
  // Above the numbers of keyframes, which are those of frames. Chosen.
  constexpr std::int64_t kFirst = 1'000'000'000;
  return NodeId(kFirst + id);
}

MarkerLayout MarkerMap::layout(const std::string& dictionary) const {
  MarkerLayout result;
  result.dictionary = dictionary;
  for (const MappedMarker& mapped : markers) result.markers.push_back(mapped.marker);
  return result;
}

}  // namespace placegraph
