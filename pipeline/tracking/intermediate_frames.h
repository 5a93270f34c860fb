#pragma once
#include <placegraph/frontend/features/rgbd_errors.h>
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/cues/manhattan_cue.h>
#include <placegraph/pipeline/local_map/local_map.h>

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace placegraph {

/// The frames since the last keyframe. Each was posed with the landmarks as estimated at that time.
/// The next keyframe improves landmarks of uncertain depth, and the frames are posed again;
/// otherwise the motion into the keyframe would contain a jump that the camera did not make.
class IntermediateFrames {
 public:
  IntermediateFrames(const Pose3d2dOptions& options, const Camera& camera)
      : options_(options), camera_(camera) {}

  struct Tracked {
    FrameId frame;
    SE3 T_keyframe_cam;  ///< relative to the last keyframe
    std::vector<std::pair<LandmarkId, Eigen::Vector2d>> landmark_px;
    std::optional<ManhattanCue::RotationEstimate>
        manhattan_rotation;              ///< observation of a Manhattan frame
    FrameErrors errors = FrameErrors();  ///< that the pixels are corrected by
  };
  void remember(Tracked frame) { frames_.push_back(std::move(frame)); }
  /// Corrects the drift of tracks, which reference patches reveal at the next keyframe, by an equal
  /// part in every frame since the last one. `drift_px`: drift of each track.
  void correct_drift(const std::map<LandmarkId, Eigen::Vector2d>& drift_px);
  /// Poses the frames again with the current landmarks and removes them from the list. Returns id
  /// and T_odom_cam of those that observe enough landmarks. `keyframe`: last keyframe before them.
  /// `scale`: factor applied to lengths since then. `errors`: those of an RGB-D camera as they are
  /// known now.
  [[nodiscard]] std::vector<std::pair<FrameId, SE3>> repose(
      const LocalMap& map, KeyframeId keyframe, double scale,
      const RgbdErrors& errors = RgbdErrors());
  void clear() { frames_.clear(); }

 private:
  Pose3d2dOptions options_;
  Camera camera_;
  std::vector<Tracked> frames_;
};

}  // namespace placegraph
