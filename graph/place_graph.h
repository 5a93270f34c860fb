#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/landmark.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <map>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A keyframe hangs on its place: moving the place moves the keyframe. Lengths that the keyframe
/// measured (landmarks, the way to other frames) grow by `scale` to the place's unit.
struct PlaceMember {
  KeyframeId keyframe;
  SE3 T_place_keyframe;
  double scale = 1;

  Sim3 S_place_keyframe() const {
    return {T_place_keyframe.rotation(), T_place_keyframe.translation(), scale};
  }
};

/// How a place looks: tf-idf weights of visual words, L1-normalized, by ascending word.
struct Appearance {
  std::vector<std::pair<std::uint32_t, float>> words;
};

/// A topological place: the frame of its anchor keyframe, and what was seen from there. Where
/// nothing measures lengths (a single eye), every place has a unit of its own; `scale` makes it the
/// map's.
struct Place {
  PlaceId id;
  KeyframeId anchor_keyframe;
  SE3 T_map_place;    ///< pose of the anchor keyframe's camera
  int component = 0;  ///< sub-map; a new one begins after a loss that nothing bridged
  std::vector<PlaceMember> members;  ///< the anchor is the first, at identity
  Appearance appearance;
  std::vector<std::string> labels;
  double scale = 1;  ///< length in the map of one unit of length at the place

  Sim3 S_map_place() const { return {T_map_place.rotation(), T_map_place.translation(), scale}; }
};

/// A place graph's constraints name places as the nodes of the graph: both have one number.
inline NodeId node_of_place(PlaceId place) { return NodeId(place.value()); }
inline PlaceId place_of_node(NodeId node) { return PlaceId(node.value()); }

/// Places and the constraints between them; ids of constraint nodes are place ids. Constraints are
/// over SE(3), or, where scales are to be estimated too, all over Sim(3).
struct PlaceGraph {
  std::vector<Place> places;
  std::vector<RelativePoseConstraint> constraints;

  const Place* find(PlaceId id) const;
  /// For every place the number of its component after joining: places of one `component` and
  /// places that a constraint joins belong together. Numbers count from 0 in the order of `places`.
  std::vector<int> joined_components() const;
  /// The same as a pose graph over SE(3), or Sim(3) if the constraints are; the first place of
  /// every joined component is fixed.
  PoseGraph pose_graph() const;
  /// Takes over the node poses of an optimized `pose_graph()`.
  void set_poses(const PoseGraph& optimized);
};

}  // namespace placegraph
