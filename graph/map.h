#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/loop_stage.h>
#include <placegraph/graph/place_graph.h>
#include <placegraph/graph/place_view.h>

namespace [[gnu::visibility("default")]] placegraph {

/// A keyframe as the map keeps it: its pose hangs on its place's, see PlaceMember.
struct Keyframe {
  KeyframeId id;
  FrameId frame;
  std::int64_t stamp_ns = 0;
  PlaceId place;
  SE3 T_place_keyframe;
  std::vector<Feature> features;
  double scale = 1;  ///< length at the place of one unit of length at the keyframe
  PlaceView view;    ///< how it looks in all cues; empty where that was not kept
};

/// Every input frame, relative to its keyframe; nothing where it is lost.
struct FrameRecord {
  FrameId frame;
  std::int64_t stamp_ns = 0;
  std::optional<KeyframeId> keyframe;
  std::optional<SE3> T_keyframe_frame;
  /// Landmarks that the frame was posed by as it was tracked; 0 if it was posed otherwise.
  int inliers = 0;
};

/// What became of a loop candidate.
struct LoopRecord {
  FrameId query_frame, match_frame;
  int inliers = 0;  ///< points that agree with the pose
  LoopStage stage = LoopStage::kRetrieval;
  SE3 T_match_query;  ///< of accepted ones
  LoopModel model = LoopModel::kNone;
  int lines = 0;        ///< lines that agree with the pose
  double likeness = 0;  ///< of the views, as a share of that to the keyframe before the query
  /// That the two show one place, by all that the decision knew: an estimate, see docs/places.md.
  double probability = 0;

  bool accepted() const { return stage == LoopStage::kAccepted; }
};

/// All that a run leaves behind. A plain value: a copy is a snapshot.
struct Map {
  std::vector<Keyframe> keyframes;
  std::vector<PointLandmark> landmarks;
  PlaceGraph place_graph;
  std::vector<FrameRecord> frames;
  std::vector<LoopRecord> loops;
  bool metric = false;           ///< whether its unit is the metre
  Trajectory trajectory_online;  ///< as each frame's pose stood when the frame had been processed

  const Keyframe* find_keyframe(KeyframeId id) const;
  /// p_map = S_map_keyframe * p for points and camera positions p in the keyframe's frame and unit.
  /// Throws ArgumentError if the keyframe or its place is not in the map.
  Sim3 S_map_keyframe(KeyframeId keyframe) const;
  /// Where a landmark stands in the map; throws as S_map_keyframe.
  Eigen::Vector3d position(const PointLandmark& landmark) const {
    return S_map_keyframe(landmark.keyframe) * landmark.point_cam;
  }
  /// Every frame's pose through keyframe and place, T_map_cam. Frames of other components than the
  /// first are posed only if constraints join them to it; otherwise they count as lost here. Throws
  /// ArgumentError if a posed frame's keyframe or that one's place is not in the map.
  Trajectory trajectory_optimized() const;
};

}  // namespace placegraph
