#pragma once
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/pipeline/tracking/odometry_options.h>

#include <map>
#include <vector>

namespace placegraph {

/// Selects the tracked frames that become keyframes, by the changes since the last keyframe.
class KeyframeSelector {
 public:
  /// `min_inliers`: minimum number of landmarks for posing a frame.
  KeyframeSelector(const KeyframeOptions& options, const Camera& camera, int min_inliers)
      : options_(options), camera_(camera), min_inliers_(min_inliers) {}

  /// Makes the newest frame, with its tracks and number of landmarks, the last keyframe.
  void start(const std::vector<PointTrack>& tracks, int landmarks);
  void reset();
  /// Counts a posed frame.
  void count_frame() { ++frames_; }
  /// Number of frames since the last keyframe.
  int frames() const { return frames_; }

  /// Overlap of a posed frame with the last keyframe.
  struct Overlap {
    int inliers = 0;                ///< landmarks that agree with its pose
    bool more_tracks = false;       ///< whether it has further tracks
    std::vector<double> flow_px{};  ///< displacement of each of its tracks since the last keyframe
  };
  bool due(const Overlap& overlap) const;
  /// Displacements since the last keyframe of the tracks observed in it [px]; if
  /// KeyframeOptions::derotated, without the part explained by the rotation R_keyframe_cam since
  /// then.
  std::vector<double> flow_px(const std::vector<PointTrack>& tracks,
                              const SO3& R_keyframe_cam) const;
  /// Pixels of the tracks in the last keyframe, by id.
  const std::map<LandmarkId, Eigen::Vector2d>& px_at_keyframe() const { return px_at_keyframe_; }

 private:
  KeyframeOptions options_;
  Camera camera_;
  int min_inliers_;
  std::map<LandmarkId, Eigen::Vector2d> px_at_keyframe_;
  int landmarks_ = 0, frames_ = 0;
};

}  // namespace placegraph
