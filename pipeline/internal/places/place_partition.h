#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/place_graph.h>
#include <placegraph/graph/place_history.h>
#include <placegraph/pipeline/internal/places/keyframe_chain.h>

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace placegraph {

/// Which keyframes are one place. A stretch of keyframes within reach of its first one, the anchor,
/// is a part; a place is the part that founded it, and those of places that were merged into it.
/// Every keyframe belongs to one part, every part to one place.
///
/// Functions throw std::out_of_range for an unknown keyframe, part or place.
class PlacePartition {
 public:
  struct Segment {  // named after its anchor
    PlaceId place;
    Sim3 S_place_segment;                         ///< identity if it founded the place
    Matrix7d covariance = Matrix7d::Zero();       ///< of that, in its right tangent
    std::optional<Matrix6d> motion_covariance{};  ///< of the motion from the previous anchor
  };
  struct PlaceState {
    KeyframeId anchor_keyframe;
    Sim3 S_map_place;
    int component = 0;
    double reach = 0;  ///< in the place's scale
    KeyframeId last_keyframe;
  };

  PlacePartition() = default;
  /// The partition of a saved map. Throws ArgumentError if the two contradict each other.
  PlacePartition(const std::vector<Place>& places, const PlaceHistory& history);

  /// A new keyframe founds a place, of which it is the anchor. Places are numbered in this order;
  /// the numbers of those that are gone are not given again.
  void found(KeyframeId keyframe, const Sim3& S_map_place, int component, double reach);
  /// A new keyframe belongs to the part of `anchor`.
  void join(KeyframeId keyframe, KeyframeId anchor);
  void set_motion_covariance(KeyframeId anchor, const Matrix6d& covariance);

  /// The parts of place `younger` become parts of `older`, where the map has them now;
  /// `covariance` is that of S_older_younger in its right tangent. Returns the first anchor that
  /// has changed its place. Throws ArgumentError if the two are one.
  KeyframeId merge(PlaceId older, PlaceId younger, const Matrix7d& covariance);
  /// Undoes entry `number` of merged(): its parts are a place again, where they stand in the map.
  /// Returns as merge().
  KeyframeId separate(std::size_t number);
  /// Whether the two places hold parts whose merger was undone.
  bool were_separated(PlaceId one, PlaceId other) const;

  void set_pose(PlaceId place, const Sim3& S_map_place);
  /// The places of component `from` move by `S_new_old` and join component `to`.
  void move_component(int from, int to, const Sim3& S_new_old);
  /// All scales become 1: those of places, and those of parts in their place.
  void drop_scales();
  /// Follows KeyframeChain::rescale of the run that begins with keyframe `first`, before or after
  /// it. A component of this run alone grows about that keyframe; where there are others, the
  /// places stay where they are and their scales shrink.
  void rescale(const KeyframeChain& chain, KeyframeId first, double factor);

  const std::map<KeyframeId, Segment>& segments() const { return segments_; }
  const std::map<PlaceId, PlaceState>& places() const { return places_; }
  const std::vector<PlaceHistory::Merged>& merged() const { return merged_; }
  KeyframeId segment_of(KeyframeId keyframe) const { return segment_of_.at(keyframe); }
  PlaceId place_of(KeyframeId keyframe) const { return segments_.at(segment_of(keyframe)).place; }
  const PlaceState& state_of(KeyframeId keyframe) const { return places_.at(place_of(keyframe)); }
  bool is_anchor(KeyframeId keyframe) const { return segments_.count(keyframe) != 0; }
  /// The anchor before `anchor` in its run of tracking; nothing if `anchor` is none or the first.
  std::optional<KeyframeId> previous_anchor(const KeyframeChain& chain, KeyframeId anchor) const;

  SE3 T_segment_keyframe(const KeyframeChain& chain, KeyframeId keyframe) const;
  Sim3 S_place_keyframe(const KeyframeChain& chain, KeyframeId keyframe) const;
  Sim3 S_map_keyframe(const KeyframeChain& chain, KeyframeId keyframe) const;
  /// The places with their members, as a place graph lists them.
  std::vector<Place> graph_places(const KeyframeChain& chain) const;
  /// Fills in what `history` says of parts and places, all but its keyframes.
  void save(PlaceHistory& history) const;

 private:
  std::map<KeyframeId, KeyframeId> segment_of_;  // of every keyframe
  std::map<KeyframeId, Segment> segments_;
  std::map<PlaceId, PlaceState> places_;
  std::vector<PlaceHistory::Merged> merged_;
  std::set<std::pair<KeyframeId, KeyframeId>> separated_;  // anchors that are not one place
  std::int64_t founded_ = 0;                               // places so far
};

}  // namespace placegraph
