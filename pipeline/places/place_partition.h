#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/place_graph.h>
#include <placegraph/graph/place_history.h>
#include <placegraph/pipeline/places/keyframe_chain.h>

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace placegraph {

/// Partition of the keyframes into places. A sequence of keyframes within reach of its first one,
/// the anchor, is a segment; a place consists of the segment that founded it and those of places
/// that were merged into it. Every keyframe belongs to one segment, every segment to one place.
///
/// Functions throw std::out_of_range for an unknown keyframe, segment or place.
class PlacePartition {
 public:
  struct Segment {  // identified by its anchor
    PlaceId place;
    Sim3 S_place_segment;                    ///< identity if the segment founded the place
    Matrix7d covariance = Matrix7d::Zero();  ///< covariance of S_place_segment in its right tangent
    /// Covariance of the motion from the previous anchor.
    std::optional<Matrix6d> motion_covariance{};
  };
  struct PlaceState {
    KeyframeId anchor_keyframe;
    Sim3 S_map_place;
    int component = 0;
    double reach = 0;  ///< radius in the place's scale
    KeyframeId last_keyframe;
  };

  PlacePartition() = default;
  /// The partition of a saved map. Throws ArgumentError if places and history are inconsistent.
  PlacePartition(const std::vector<Place>& places, const PlaceHistory& history);

  /// Founds a place with a new keyframe as its anchor. Places are numbered in this order; the
  /// numbers of places that no longer exist are not reused.
  void found(KeyframeId keyframe, const Sim3& S_map_place, int component, double reach);
  /// Adds a new keyframe to the segment of `anchor`.
  void join(KeyframeId keyframe, KeyframeId anchor);
  void set_motion_covariance(KeyframeId anchor, const Matrix6d& covariance);

  /// Makes the segments of place `younger` segments of `older`, at their current poses in the map;
  /// `covariance` is that of S_older_younger in its right tangent. Returns the first anchor that
  /// has changed its place. Throws ArgumentError if the two places are the same.
  KeyframeId merge(PlaceId older, PlaceId younger, const Matrix7d& covariance);
  /// Undoes entry `number` of merged(): its segments become a place again, at their current poses
  /// in the map. `for_good`: the two must not be merged again. Returns as merge().
  KeyframeId separate(std::size_t number, bool for_good = true);
  /// Whether the two places contain segments whose merger was undone.
  bool were_separated(PlaceId one, PlaceId other) const;

  void set_pose(PlaceId place, const Sim3& S_map_place);
  void set_component(PlaceId place, int component);
  /// Moves the places of component `from` by `S_new_old` and joins them to component `to`.
  void move_component(int from, int to, const Sim3& S_new_old);
  /// Sets all scales to 1: those of places, and those of segments in their places.
  void drop_scales();
  /// Follows KeyframeChain::rescale of the track segment that begins with keyframe `first`, before
  /// or after that call. A component that consists of this track segment is scaled about that
  /// keyframe; otherwise the places keep their positions and their scales are reduced.
  void rescale(const KeyframeChain& chain, KeyframeId first, double factor);

  const std::map<KeyframeId, Segment>& segments() const { return segments_; }
  const std::map<PlaceId, PlaceState>& places() const { return places_; }
  const std::vector<PlaceHistory::Merged>& merged() const { return merged_; }
  KeyframeId segment_of(KeyframeId keyframe) const { return segment_of_.at(keyframe); }
  PlaceId place_of(KeyframeId keyframe) const { return segments_.at(segment_of(keyframe)).place; }
  const PlaceState& state_of(KeyframeId keyframe) const { return places_.at(place_of(keyframe)); }
  bool is_anchor(KeyframeId keyframe) const { return segments_.count(keyframe) != 0; }
  /// The previous anchor in the track segment of `anchor`; nothing if `anchor` is none or the
  /// first.
  std::optional<KeyframeId> previous_anchor(const KeyframeChain& chain, KeyframeId anchor) const;

  SE3 T_segment_keyframe(const KeyframeChain& chain, KeyframeId keyframe) const;
  Sim3 S_place_keyframe(const KeyframeChain& chain, KeyframeId keyframe) const;
  Sim3 S_map_keyframe(const KeyframeChain& chain, KeyframeId keyframe) const;
  /// Places with their keyframes, in the form of a place graph.
  std::vector<Place> graph_places(const KeyframeChain& chain) const;
  /// Fills in the segments and places of `history`, everything except its keyframes.
  void save(PlaceHistory& history) const;

 private:
  std::map<KeyframeId, KeyframeId> segment_of_;  // segment of every keyframe
  std::map<KeyframeId, Segment> segments_;
  std::map<PlaceId, PlaceState> places_;
  std::vector<PlaceHistory::Merged> merged_;
  // Pairs of anchors that must not be merged.
  std::set<std::pair<KeyframeId, KeyframeId>> separated_;
  std::int64_t founded_ = 0;  // number of places founded so far
};

}  // namespace placegraph
