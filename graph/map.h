#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/loop_stage.h>
#include <placegraph/graph/place_graph.h>
#include <placegraph/graph/place_view.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A keyframe of a map; its pose is relative to its place's, see PlaceMember.
struct Keyframe {
  KeyframeId id;                  ///< in the order of the frames
  FrameId frame;                  ///< the frame that became this keyframe
  std::int64_t stamp_ns = 0;      ///< of that frame
  PlaceId place;                  ///< the place that it belongs to
  SE3 T_place_keyframe;           ///< of its camera, in the place's unit of length
  std::vector<Feature> features;  ///< for place recognition and loop verification
  double scale = 1;               ///< length at the place of one unit of length at the keyframe
  PlaceView view;                 ///< its image in all cues; empty where that was not kept
};

/// The pose of an input frame relative to its keyframe; none where the frame is lost.
struct FrameRecord {
  FrameId frame;                        ///< its position in the sequence
  std::int64_t stamp_ns = 0;            ///< when it was taken
  std::optional<KeyframeId> keyframe;   ///< there wherever the frame has a pose
  std::optional<SE3> T_keyframe_frame;  ///< of its camera, in the keyframe's unit of length
  /// Landmarks whose observations the pose agreed with when the frame was tracked; 0 if the pose
  /// did not come from landmarks.
  int inliers = 0;
};

/// A loop candidate and what became of it.
struct LoopRecord {
  FrameId query_frame, match_frame;         ///< the frames of the later and the earlier keyframe
  int inliers = 0;                          ///< points that agree with the relative pose
  LoopStage stage = LoopStage::kRetrieval;  ///< the test that refused it, or kAccepted
  SE3 T_match_query;                        ///< of accepted ones, in the match's unit of length
  LoopModel model = LoopModel::kNone;       ///< by which the relative pose was found
  int lines = 0;                            ///< lines that agree with the relative pose
  double similarity = 0;  ///< similarity of the images, relative to that of query and predecessor
  /// Estimated probability that the two show one place, from all that the decision was based on:
  /// see docs/places.md.
  double probability = 0;

  /// Whether the loop became a constraint of the map.
  bool accepted() const { return stage == LoopStage::kAccepted; }
};

/// All that a run of SLAM leaves behind; a plain value, of which a copy is a snapshot.
struct Map {
  std::vector<Keyframe> keyframes;       ///< by ascending id
  std::vector<PointLandmark> landmarks;  ///< points, each relative to a keyframe
  PlaceGraph place_graph;                ///< places, with the keyframes as members
  std::vector<FrameRecord> frames;       ///< every input frame, in order
  std::vector<LoopRecord> loops;         ///< every candidate that was tested, in order
  bool metric = false;                   ///< whether its unit of length is the metre
  Trajectory trajectory_online;  ///< each frame's pose T_map_cam as estimated when it was processed

  /// The keyframe of an id; nullptr if there is none.
  const Keyframe* find_keyframe(KeyframeId id) const;
  /// p_map = S_map_keyframe * p for points p in the keyframe's camera frame and unit of length.
  /// Throws ArgumentError if the keyframe or its place is not in the map.
  Sim3 S_map_keyframe(KeyframeId keyframe) const;
  /// A landmark's position in the map frame; throws as S_map_keyframe.
  Eigen::Vector3d position(const PointLandmark& landmark) const {
    return S_map_keyframe(landmark.keyframe) * landmark.point_cam;
  }
  /// Every frame's pose T_map_cam, through its keyframe and place.
  /// Frames of other components than the first are posed only if constraints join them to it;
  /// otherwise they count as lost here. Throws ArgumentError if a posed frame's keyframe or that
  /// keyframe's place is not in the map.
  Trajectory trajectory_optimized() const;
};

}  // namespace placegraph
