#pragma once
#include <placegraph/frontend/internal/relative_pose/pose_3d2d.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/internal/cues/manhattan_cue.h>
#include <placegraph/pipeline/internal/local_map/local_map.h>

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace placegraph {

/// The frames since the last keyframe. Each was posed against the landmarks as they were known
/// then. The next keyframe improves those whose depth was poorly known, and the frames are posed
/// again, or the motion into the keyframe would show a jump that the camera did not make.
class IntermediateFrames {
 public:
  IntermediateFrames(const Pose3d2dOptions& options, const Camera& camera)
      : options_(options), camera_(camera) {}

  struct Tracked {
    FrameId frame;
    SE3 T_keyframe_cam;  ///< from the last keyframe
    std::vector<std::pair<LandmarkId, Eigen::Vector2d>> landmark_px;
    std::optional<ManhattanCue::RotationEstimate> heading;  ///< what it sees of a Manhattan frame
  };
  void remember(Tracked frame) { frames_.push_back(std::move(frame)); }
  /// Reference patches show at the next keyframe how far tracks have drifted since the last one: by
  /// equal parts in every frame. `drift_px`: of each track.
  void correct_drift(const std::map<LandmarkId, Eigen::Vector2d>& drift_px);
  /// Poses the frames again, by the landmarks as they are now known: id and T_odom_cam of those
  /// that see enough of them. `keyframe`: the last one before them. `scale`: what lengths have
  /// grown by since then. Forgets them.
  [[nodiscard]] std::vector<std::pair<FrameId, SE3>> repose(const LocalMap& map,
                                                            KeyframeId keyframe, double scale);
  void clear() { frames_.clear(); }

 private:
  Pose3d2dOptions options_;
  Camera camera_;
  std::vector<Tracked> frames_;
};

}  // namespace placegraph
