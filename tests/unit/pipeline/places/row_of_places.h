#pragma once
#include <placegraph/pipeline/places/place_partition.h>

#include "tests/support/place_links.h"
#include "tests/support/scenes/poses.h"

namespace placegraph::test {

constexpr double kRounding = 1e-9;

/// Keyframes 0 (with 1), 2 (with 3) and 4, each an anchor 5 m after the last, in one component.
struct Row {
  KeyframeChain chain;
  PlacePartition partition;

  explicit Row(bool scale_known = true) {
    const SE3 T_map_0 = pose({0, 0.3, 0}, {1, 2, 3});
    chain.add(KeyframeId(0), std::nullopt, scale_known);
    partition.found(KeyframeId(0), Sim3(T_map_0), 0, 3);
    chain.add(KeyframeId(1), link(0, kShort));
    partition.join(KeyframeId(1), KeyframeId(0));
    chain.add(KeyframeId(2), link(1, kLong));
    partition.found(KeyframeId(2), Sim3(T_map_0 * kShort * kLong), 0, 3);
    chain.add(KeyframeId(3), link(2, kShort));
    partition.join(KeyframeId(3), KeyframeId(2));
    chain.add(KeyframeId(4), link(3, kLong));
    partition.found(KeyframeId(4), Sim3(T_map_0 * kShort * kLong * kShort * kLong), 0, 3);
  }
  Sim3 S_map(std::int64_t keyframe) const {
    return partition.S_map_keyframe(chain, KeyframeId(keyframe));
  }
};

}  // namespace placegraph::test
