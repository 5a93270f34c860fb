#include <placegraph/pipeline/places/place_components.h>
#include <placegraph/pipeline/places/shortest_path.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace placegraph {

void join_components(const KeyframeChain& chain, const std::vector<Loop>& loops,
                     PlacePartition& partition) {
  for (const Loop& loop : loops) {
    const int match = partition.state_of(loop.match).component,
              query = partition.state_of(loop.query).component;
    if (match == query) continue;
    const Sim3 S_map_match = partition.S_map_keyframe(chain, loop.match),
               S_map_query = partition.S_map_keyframe(chain, loop.query);
    const Sim3 S_new_old =
        query > match ? S_map_match * loop.S_match_query() * S_map_query.inverse()
                      : S_map_query * loop.S_match_query().inverse() * S_map_match.inverse();
    partition.move_component(std::max(match, query), std::min(match, query), S_new_old);
  }
}

void split_components(const KeyframeChain& chain, const std::vector<Loop>& loops,
                      PlacePartition& partition) {
  const auto neighbours = place_neighbours(chain, partition, loops);
  int unused = 0;
  for (const auto& [number, place] : partition.places())
    unused = std::max(unused, place.component + 1);
  std::set<PlaceId> reached;
  std::set<int> begun;  // components whose first place has been reached
  for (const auto& [number, place] : partition.places()) {
    if (reached.count(number)) continue;
    const int component = begun.insert(place.component).second ? place.component : unused++;
    std::vector<PlaceId> open = {number};
    while (!open.empty()) {
      const PlaceId at = open.back();
      open.pop_back();
      if (!reached.insert(at).second) continue;
      partition.set_component(at, component);
      if (const auto next = neighbours.find(at); next != neighbours.end())
        open.insert(open.end(), next->second.begin(), next->second.end());
    }
  }
}

void normalize_scales(const KeyframeChain& chain, PlacePartition& partition) {
  if (chain.all_scales_known()) {
    partition.drop_scales();
    return;
  }
  struct ComponentScale {
    Eigen::Vector3d centre;
    double sum_of_logs = 0;
    int known = 0;
    bool first_known = false;
  };
  std::map<int, ComponentScale> scales;
  for (const auto& [number, place] : partition.places()) {
    const bool known = chain.scale_known(place.anchor_keyframe);
    const auto [scale, first] =
        scales.try_emplace(place.component, ComponentScale{place.S_map_place.translation()});
    if (first) scale->second.first_known = known;
    // If the scale of the first place, which the optimizer fixes, is known, it alone determines the
    // scale.
    if (!known || (!first && scale->second.first_known)) continue;
    scale->second.sum_of_logs += std::log(place.S_map_place.scale());
    ++scale->second.known;
  }
  for (const auto& [number, place] : partition.places()) {
    const ComponentScale& scale = scales.at(place.component);
    if (scale.known == 0) continue;
    const double factor = std::exp(-scale.sum_of_logs / scale.known);
    const Sim3& S = place.S_map_place;
    const Eigen::Vector3d& centre = scale.centre;
    partition.set_pose(number, Sim3(S.rotation(), centre + factor * (S.translation() - centre),
                                    factor * S.scale()));
  }
}

}  // namespace placegraph
