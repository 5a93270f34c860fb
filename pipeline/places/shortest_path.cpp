#include <placegraph/pipeline/places/shortest_path.h>

#include <functional>
#include <limits>
#include <queue>
#include <set>

namespace placegraph {

double shortest_path(const KeyframeChain& chain, const PlacePartition& partition,
                     const std::vector<Loop>& loops, std::int64_t from, std::int64_t to) {
  std::map<std::int64_t, std::vector<std::int64_t>> neighbours;
  const auto join = [&](std::int64_t a, std::int64_t b) {
    if (a == b) return;
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  };
  for (const auto& [anchor, part] : partition.parts())
    if (const auto& link = chain.at(anchor).link) join(part.place, partition.place_of(link->from));
  for (const Loop& loop : loops)
    join(partition.place_of(loop.match), partition.place_of(loop.query));

  const auto position = [&](std::int64_t place) -> const Eigen::Vector3d& {
    return partition.places().at(place).S_map_place.translation();
  };
  using Reached = std::pair<double, std::int64_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  std::set<std::int64_t> done;
  open.emplace(0, from);
  while (!open.empty()) {
    const auto [length, place] = open.top();
    open.pop();
    if (place == to) return length;
    if (!done.insert(place).second) continue;
    for (const std::int64_t next : neighbours[place])
      open.emplace(length + (position(next) - position(place)).norm(), next);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace placegraph
