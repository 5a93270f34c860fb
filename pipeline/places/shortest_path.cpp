#include <placegraph/pipeline/places/shortest_path.h>

#include <functional>
#include <limits>
#include <queue>
#include <set>

namespace placegraph {

std::map<PlaceId, std::vector<PlaceId>> place_neighbours(const KeyframeChain& chain,
                                                         const PlacePartition& partition,
                                                         const std::vector<Loop>& loops) {
  std::map<PlaceId, std::vector<PlaceId>> neighbours;
  const auto join = [&](PlaceId a, PlaceId b) {
    if (a == b) return;
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  };
  for (const auto& [anchor, segment] : partition.segments())
    if (const auto& link = chain.at(anchor).link)
      join(segment.place, partition.place_of(link->from));
  for (const Loop& loop : loops)
    join(partition.place_of(loop.match), partition.place_of(loop.query));
  return neighbours;
}

double shortest_path(const KeyframeChain& chain, const PlacePartition& partition,
                     const std::vector<Loop>& loops, PlaceId from, PlaceId to) {
  auto neighbours = place_neighbours(chain, partition, loops);
  const auto position = [&](PlaceId place) -> const Eigen::Vector3d& {
    return partition.places().at(place).S_map_place.translation();
  };
  using Reached = std::pair<double, PlaceId>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  std::set<PlaceId> done;
  open.emplace(0, from);
  while (!open.empty()) {
    const auto [length, place] = open.top();
    open.pop();
    if (place == to) return length;
    if (!done.insert(place).second) continue;
    for (const PlaceId next : neighbours[place])
      open.emplace(length + (position(next) - position(place)).norm(), next);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace placegraph
