#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/landmark.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <map>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A keyframe of a place, with its pose relative to it: moving the place moves the keyframe.
struct PlaceMember {
  KeyframeId keyframe;   ///< the keyframe
  SE3 T_place_keyframe;  ///< of its camera, in the place's unit of length
  /// Length at the place of one unit of length at the keyframe, in which its landmarks and the
  /// poses of its frames are given.
  double scale = 1;

  /// Maps points in the keyframe's frame and unit to those of the place.
  Sim3 S_place_keyframe() const {
    return {T_place_keyframe.rotation(), T_place_keyframe.translation(), scale};
  }
};

/// The appearance of a place as a bag of visual words.
struct Appearance {
  /// (word, tf-idf weight) by ascending word; the weights sum to 1.
  std::vector<std::pair<std::uint32_t, float>> words;
};

/// A topological place: an anchor keyframe, whose camera frame it has, and others near it.
/// Where nothing measures lengths (a monocular camera), every place has a unit of length of its
/// own; `scale` converts it to the map's.
struct Place {
  PlaceId id;                  ///< also of the node of the place graph
  KeyframeId anchor_keyframe;  ///< the keyframe whose camera frame the place has
  SE3 T_map_place;             ///< pose of the anchor keyframe's camera
  int component = 0;           ///< sub-map; a new one begins after a loss that nothing bridged
  std::vector<PlaceMember> members;  ///< the anchor is the first, at identity
  Appearance appearance;             ///< of the anchor's image
  std::vector<std::string> labels;   ///< free text; "environment:street" says its environment
  double scale = 1;                  ///< length in the map of one unit of length at the place

  /// Maps points in the place's frame and unit to those of the map.
  Sim3 S_map_place() const { return {T_map_place.rotation(), T_map_place.translation(), scale}; }
};

/// The node that stands for a place in a place graph's constraints; both have one number.
inline NodeId node_of_place(PlaceId place) { return NodeId(place.value()); }
/// The place that a node of a place graph stands for; both have one number.
inline PlaceId place_of_node(NodeId node) { return PlaceId(node.value()); }

/// Places and the constraints between them.
/// The nodes of constraints have the numbers of the places. Constraints are over SE(3) or, where
/// scales are to be estimated too, all over Sim(3).
struct PlaceGraph {
  std::vector<Place> places;                        ///< the nodes
  std::vector<RelativePoseConstraint> constraints;  ///< between places, by odometry, loops, sensors

  /// The place of an id; nullptr if there is none.
  const Place* find(PlaceId id) const;
  /// For every place the number of its connected component.
  /// Places of one `component` and places that a constraint joins belong together. Numbers count
  /// from 0 in the order of `places`. Throws ArgumentError for a constraint on an unknown place.
  std::vector<int> joined_components() const;
  /// The same as a pose graph over SE(3), or Sim(3) if the constraints are.
  /// The first place of every connected component is fixed. Throws as joined_components.
  PoseGraph pose_graph() const;
  /// Takes over the node poses, and over Sim(3) the scales, of an optimized `pose_graph()`.
  /// Throws ArgumentError if a place is missing there or the graph is over SE(2).
  void set_poses(const PoseGraph& optimized);
};

}  // namespace placegraph
