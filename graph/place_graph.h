#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/measurements/landmark.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <map>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A keyframe of a place, with its pose relative to the place and so moving with the place.
struct PlaceMember {
  KeyframeId keyframe;   ///< the keyframe
  SE3 T_place_keyframe;  ///< pose of its camera, at the place's scale
  /// Scale: lengths at the place over lengths at the keyframe. The keyframe's landmarks and the
  /// poses of its frames are stored at the keyframe's scale.
  double scale = 1;

  /// Maps points from the frame and scale of the keyframe to those of the place.
  Sim3 S_place_keyframe() const {
    return {T_place_keyframe.rotation(), T_place_keyframe.translation(), scale};
  }
};

/// The appearance of a place as a bag of visual words.
struct Appearance {
  /// (word, tf-idf weight) by ascending word; the weights sum to 1.
  std::vector<std::pair<std::uint32_t, float>> words;
};

/// A topological place: an anchor keyframe, which defines its frame, and keyframes near it.
/// If the scale is unobservable (a monocular camera), every place has its own scale; `scale`
/// converts its lengths to the map's.
struct Place {
  PlaceId id;                  ///< id of the place and of its node in the place graph
  KeyframeId anchor_keyframe;  ///< the keyframe whose camera frame the place has
  SE3 T_map_place;             ///< pose of the anchor keyframe's camera
  int component = 0;  ///< number of its component; a new one begins after a loss of tracking that
                      ///< no link bridges
  std::vector<PlaceMember> members;  ///< keyframes; the anchor keyframe is the first, at identity
  Appearance appearance;             ///< appearance of the anchor keyframe's image
  /// Free text; "environment:street" is the label of an environment.
  std::vector<std::string> labels;
  double scale = 1;  ///< scale: lengths in the map over lengths at the place

  /// Maps points from the frame and scale of the place to those of the map.
  Sim3 S_map_place() const { return {T_map_place.rotation(), T_map_place.translation(), scale}; }
};

/// The node of a place in a place graph's constraints; both have the same number.
inline NodeId node_of_place(PlaceId place) { return NodeId(place.value()); }
/// The place of a node of a place graph; both have the same number.
inline PlaceId place_of_node(NodeId node) { return PlaceId(node.value()); }

/// Places and the constraints between them.
/// The nodes of constraints have the numbers of the places. Constraints are over SE(3) or, where
/// scales are to be estimated too, all over Sim(3).
struct PlaceGraph {
  std::vector<Place> places;  ///< the nodes
  /// Relative poses of places from odometry, loops and sensors.
  std::vector<RelativePoseConstraint> constraints;

  /// The place with the given id; nullptr if there is none.
  const Place* find(PlaceId id) const;
  /// For every place the number of its connected component.
  ///
  /// It is the smallest Place::component in it.
  /// Places of one `component` and places that a constraint joins belong together. Throws
  /// ArgumentError for a constraint on an unknown place.
  std::vector<int> joined_components() const;
  /// The same as a pose graph over SE(3), or Sim(3) if the constraints are.
  /// The first place of every connected component is fixed. Throws as joined_components.
  PoseGraph pose_graph() const;
  /// Copies the node poses, and over Sim(3) the scales, of an optimized `pose_graph()`.
  /// Throws ArgumentError if a place is missing there or the graph is over SE(2).
  void set_poses(const PoseGraph& optimized);
};

}  // namespace placegraph
