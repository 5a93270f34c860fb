#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/loop_stage.h>
#include <placegraph/graph/place_graph.h>
#include <placegraph/graph/recognition/place_view.h>

#include <cstddef>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A keyframe of a map; its pose is relative to its place, see PlaceMember.
struct Keyframe {
  KeyframeId id;                  ///< id; ids ascend in the order of the frames
  FrameId frame;                  ///< the frame that became this keyframe
  std::int64_t stamp_ns = 0;      ///< stamp of that frame
  PlaceId place;                  ///< the place that it belongs to
  SE3 T_place_keyframe;           ///< pose of its camera, at the place's scale
  std::vector<Feature> features;  ///< image features for place recognition and loop verification
  double scale = 1;               ///< scale: lengths at the place over lengths at the keyframe
  PlaceView view;                 ///< descriptors of its image in all cues; empty if not stored
  /// Image points of landmarks, ascending by landmark. A landmark that is not in the map was
  /// refused after this keyframe.
  std::vector<LandmarkObservation> observations = {};
  std::string thumbnail = {};  ///< its image as a small JPEG file; empty if not stored
};

/// The pose of an input frame relative to its keyframe; no pose if the frame is lost.
struct FrameRecord {
  FrameId frame;                        ///< its position in the sequence
  std::int64_t stamp_ns = 0;            ///< time of its images
  std::optional<KeyframeId> keyframe;   ///< the keyframe; present if the frame has a pose
  std::optional<SE3> T_keyframe_frame;  ///< pose of its camera, at the keyframe's scale
  /// Number of landmarks whose observations agreed with the pose in tracking; 0 if the pose was not
  /// estimated from landmarks.
  int inliers = 0;
  /// Share of the tracked landmarks that agree with the pose, less where they are few, in [0, 1];
  /// nothing without a pose from landmarks.
  std::optional<double> confidence = {};
  std::string reason = {};  ///< why the frame has no pose of its own; empty if it was tracked
};

/// A loop candidate and the result of its tests.
struct LoopRecord {
  FrameId query_frame, match_frame;         ///< the frames of the later and the earlier keyframe
  int inliers = 0;                          ///< points that agree with the relative pose
  LoopStage stage = LoopStage::kRetrieval;  ///< the test that refused it, or kAccepted, kManual
  SE3 T_match_query;                   ///< relative pose of an accepted loop, at the match's scale
  LoopModel model = LoopModel::kNone;  ///< model by which the relative pose was found
  int lines = 0;                       ///< lines that agree with the relative pose
  /// Similarity of the images, relative to that of the query and its predecessor.
  double similarity = 0;
  /// Estimated probability that both frames show the same place, from all evidence of the decision:
  /// see docs/place_graph.md.
  double probability = 0;

  /// Whether the loop became a constraint of the map.
  bool accepted() const { return stage == LoopStage::kAccepted; }
};

/// Frames whose poses are in one coordinate frame.
///
/// A new component begins after a loss of tracking that nothing bridges. Constraints between places
/// join components.
struct MapComponent {
  int number = 0;                   ///< number as in PlaceGraph::joined_components
  bool main = false;                ///< whether it has the most frames with a pose
  std::size_t posed = 0;            ///< number of its frames that have a pose
  std::size_t first = 0, last = 0;  ///< positions of its first and last such frame in Map::frames
};

/// The result of a SLAM run; a plain value, a copy of which is a snapshot.
struct Map {
  std::vector<Keyframe> keyframes;       ///< keyframes by ascending id
  std::vector<PointLandmark> landmarks;  ///< points, each relative to a keyframe
  PlaceGraph place_graph;                ///< places, with the keyframes as members
  std::vector<FrameRecord> frames;       ///< every input frame, in order
  std::vector<LoopRecord> loops;         ///< every candidate that was tested, in order
  bool metric = false;                   ///< whether lengths are in metres: see judge()
  /// Each frame's pose T_map_cam as estimated when it was processed, of the main component alone.
  Trajectory trajectory_online;

  /// The keyframe with the given id; nullptr if there is none.
  const Keyframe* find_keyframe(KeyframeId id) const;
  /// p_map = S_map_keyframe * p for points p in the keyframe's camera frame and scale.
  /// Throws ArgumentError if the keyframe or its place is not in the map.
  Sim3 S_map_keyframe(KeyframeId keyframe) const;
  /// A landmark's position in the map frame; throws as S_map_keyframe.
  Eigen::Vector3d position(const PointLandmark& landmark) const {
    return S_map_keyframe(landmark.keyframe) * landmark.point_cam;
  }
  /// The components that have frames with a pose, by ascending number.
  ///
  /// One of them is the main one. Throws as trajectory_optimized.
  std::vector<MapComponent> components() const;
  /// Number of the component with the most posed frames, of equal ones the first.
  ///
  /// 0 for a map without components. Throws as trajectory_optimized.
  int main_component() const;
  /// The pose T_map_cam of every frame of the main component, through its keyframe and place.
  /// Frames of other components have no pose here. Throws ArgumentError if a posed frame's keyframe
  /// or that keyframe's place is not in the map.
  Trajectory trajectory_optimized() const { return trajectory_optimized(main_component()); }
  /// The same for the component with this MapComponent::number, in its own frame.
  Trajectory trajectory_optimized(int component) const;
};

}  // namespace placegraph
