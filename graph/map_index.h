#pragma once
#include <placegraph/graph/map.h>

#include <optional>
#include <unordered_map>

namespace [[gnu::visibility("default")]] placegraph {

/// Keyframes and places of a map by their ids, for those who look up many.
/// Map searches its places. The map must outlive it and not change.
class MapIndex {
 public:
  explicit MapIndex(const Map& map);

  /// A keyframe with its place and the number of its component, as in joined_components.
  struct Location {
    const Keyframe* keyframe = nullptr;
    const Place* place = nullptr;
    int component = 0;
    /// As Map::S_map_keyframe.
    Sim3 S_map_keyframe() const;
  };
  /// Nothing if the keyframe or its place is not in the map.
  std::optional<Location> find(KeyframeId id) const;
  /// The keyframe of a posed frame; throws ArgumentError as Map::trajectory_optimized.
  Location of(const FrameRecord& record) const;

 private:
  struct Entry {
    const Place* place = nullptr;
    int component = 0;
  };
  std::unordered_map<PlaceId, Entry> places_;
  std::unordered_map<KeyframeId, const Keyframe*> keyframes_;
};

}  // namespace placegraph
