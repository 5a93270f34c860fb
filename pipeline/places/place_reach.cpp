#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/places/place_reach.h>

#include <algorithm>

namespace placegraph {

std::optional<PlaceId> earlier_place_in_reach(const KeyframeChain& chain,
                                              const PlacePartition& partition,
                                              const PlaceOptions& options, KeyframeId keyframe,
                                              const Sim3& S_map_here, double reach) {
  const PlacePartition::PlaceState& own = partition.state_of(keyframe);
  std::optional<PlaceId> nearest;
  double least = reach;
  for (const auto& [number, place] : partition.places()) {
    if (place.anchor_keyframe >= own.anchor_keyframe || place.component != own.component) continue;
    const double place_reach = place.reach * place.S_map_place.scale();
    const double distance = (place.S_map_place.translation() - S_map_here.translation()).norm();
    if (distance >= std::min(least, place_reach)) continue;
    const SO3 rotation = place.S_map_place.rotation().inverse() * S_map_here.rotation();
    if (rotation.log().norm() >= deg_to_rad(options.max_angle_deg)) continue;
    const auto path = chain.odometry(place.anchor_keyframe, keyframe);
    if (path && path->path_length * own.S_map_place.scale() < 2 * std::max(reach, place_reach))
      continue;
    least = distance;
    nearest = number;
  }
  return nearest;
}

bool in_reach_of_segment(const KeyframeChain& chain, const PlacePartition& partition,
                         const std::vector<Loop>& loops, const PlaceOptions& options,
                         KeyframeId keyframe, double median_depth) {
  const KeyframeId anchor = partition.segment_of(chain.at(keyframe).link->from);
  const Sim3 S_place_this =
      partition.segments().at(anchor).S_place_segment * Sim3(chain.T_a_b(anchor, keyframe));
  if (S_place_this.translation().norm() >=
          options.max_distance * median_depth * S_place_this.scale() ||
      S_place_this.rotation().log().norm() >= deg_to_rad(options.max_angle_deg))
    return false;
  if (loops.empty()) return true;
  const PlacePartition::PlaceState& place = partition.state_of(anchor);
  const double reach = place.reach * place.S_map_place.scale();
  const auto earlier_place = [&](const Sim3& S_map_here) {
    return earlier_place_in_reach(chain, partition, options, anchor, S_map_here, reach);
  };
  return earlier_place(place.S_map_place * S_place_this) ==
         earlier_place(partition.S_map_keyframe(chain, anchor));
}

}  // namespace placegraph
