#pragma once
#include <placegraph/frontend/internal/flow/point_tracker.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/pipeline/tracking/odometry_options.h>

#include <map>
#include <vector>

namespace placegraph {

/// Decides which tracked frames become keyframes, by what has changed since the last keyframe.
class KeyframeSelector {
 public:
  /// `min_inliers`: landmarks without which a frame cannot be posed.
  KeyframeSelector(const KeyframeOptions& options, const Camera& camera, int min_inliers)
      : options_(options), camera_(camera), min_inliers_(min_inliers) {}

  /// The newest frame has become a keyframe: it shows these tracks and so many landmarks.
  void start(const std::vector<PointTrack>& tracks, int landmarks);
  void reset();
  /// One more frame has been posed.
  void count_frame() { ++frames_; }
  /// Frames since the last keyframe.
  int frames() const { return frames_; }

  /// What a posed frame has in common with the last keyframe.
  struct Overlap {
    int inliers = 0;                ///< landmarks that pose it
    bool more_tracks = false;       ///< whether it has tracks beside those
    std::vector<double> flow_px{};  ///< displacement of each of its tracks since the last keyframe
  };
  bool due(const Overlap& overlap) const;
  /// Displacements since the last keyframe of the tracks that it has [px]; if the options say so,
  /// without what the rotation R_keyframe_cam since then explains.
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
