#pragma once
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/frontend/internal/flow/point_tracker.h>
#include <placegraph/frontend/internal/relative_pose/pose_3d2d.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/pipeline/cues/cue_options.h>
#include <placegraph/pipeline/internal/cues/depth_sensor.h>
#include <placegraph/pipeline/internal/cues/direct_cue.h>

#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// Point features: tracks them from frame to frame, poses frames against the landmarks of the
/// sliding window, and hands what keyframes observe to it.
class PointCue {
 public:
  /// `times`, which must outlive the cue, receives the CPU time of its stages.
  PointCue(const PointCueOptions& options, const Calibration& calibration,
           const StereoMatcherOptions& stereo, StageTimes& times);

  const std::vector<PointTrack>& tracks() const { return tracker_.tracks(); }
  const PointCueOptions& options() const { return options_; }

  /// Follows the tracks into an image without a map.
  void track(const Image& image);
  struct TrackedPose {
    Pose3d2dResult pose;     ///< T_ref_cam is T_odom_cam
    std::vector<bool> keep;  ///< one flag per track: whether it agrees with the pose
  };
  /// Follows the tracks into an image that is expected at `T_odom_expected`, and poses it against
  /// the landmarks of the window. `T_odom_last`: pose of the image before. `velocity_known`:
  /// whether the expectation rests on a measured velocity. Points without a landmark are taken to
  /// be as deep as those beside them, or else `median_depth` away.
  [[nodiscard]] TrackedPose follow(const Image& image, const SlidingWindow& window,
                                   const SE3& T_odom_last, const SE3& T_odom_expected,
                                   bool velocity_known, double median_depth, Random& random);
  /// The pose of the newest image by its tracks as they are.
  [[nodiscard]] TrackedPose pose(const SlidingWindow& window, const SE3& T_odom_prior,
                                 Random& random) const;
  /// Drops the tracks whose flag is false.
  void keep(const std::vector<bool>& flags) { tracker_.keep(flags); }

  /// Moves the tracks to where their reference patches are found in the newest image. Returns what
  /// each was moved by [px]: the drift that it had accumulated.
  std::map<LandmarkId, Eigen::Vector2d> anchor();
  /// Drops tracks where `still` is 0 (CV_8UC1, the image's size), if enough others are left.
  void drop_tracks_on_movable_objects(const Image& still);
  /// Detects new points in the newest image where `mask` allows them. If it was made from semantic
  /// labels (`labelled`) and too few are found so, then wherever `given_mask` allows them.
  void detect(const Image& mask, bool labelled, const Image& given_mask);
  /// Hands the newest image's tracks to the window as observations of `keyframe`. Points with depth
  /// or enough parallax become landmarks.
  void observe(KeyframeId keyframe, const Frame& frame, const RectificationError& rectification,
               SlidingWindow& window);
  /// A point of two views that start a map.
  struct TwoViewPoint {
    LandmarkId track;
    Eigen::Vector2d px_ref, px_cur;
    Eigen::Matrix2d covariance_px;
    std::optional<Eigen::Vector3d> point_odom;  ///< nothing: not triangulated
  };
  /// Hands the points of the two first keyframes of a monocular map to the window.
  void observe_two_views(KeyframeId ref, KeyframeId cur, const std::vector<TwoViewPoint>& points,
                         SlidingWindow& window);
  /// Remembers that `keyframe`, the newest image, observes tracks that were detected after it was
  /// handed over.
  void observe_new_tracks(KeyframeId keyframe);
  /// Removes landmarks that do not fit from the window. Returns the depths of the other landmarks
  /// that are tracked, in keyframe `newest` [m, or the map's unit].
  std::vector<double> prune(SlidingWindow& window, KeyframeId newest);

  /// Landmarks that are tracked, with their pixel in the newest image.
  std::vector<std::pair<LandmarkId, Eigen::Vector2d>> landmark_pixels(
      const SlidingWindow& window) const;
  /// The same with their depths in keyframe `keyframe`, which the newest image is, for a cue that
  /// needs depths: they are taken to be certain to a few per cent.
  std::vector<KnownPixel> landmark_depths(const SlidingWindow& window, KeyframeId keyframe) const;
  int tracked_landmarks(const SlidingWindow& window) const;

  /// The tracks as they stand, to go back to if a frame cannot be posed.
  PointTracker checkpoint() const { return tracker_; }
  void restore(PointTracker checkpoint) { tracker_ = std::move(checkpoint); }
  /// Forgets tracks but not what keyframes observed.
  void drop_tracks() { tracker_.reset(); }
  void reset();

 private:
  struct Observation {
    KeyframeId keyframe;
    Eigen::Vector2d px;
    Eigen::Matrix2d covariance_px;
  };
  std::vector<Eigen::Vector2f> predict(const SlidingWindow& window, const SE3& T_odom_last,
                                       const SE3& T_odom_cam, double median_depth) const;
  std::vector<std::optional<InverseDepth>> measure_depth(const Frame& frame,
                                                         const RectificationError& rectification,
                                                         const SE3& T_odom_cam,
                                                         const SlidingWindow& window) const;
  std::optional<Eigen::Vector3d> place_point(const Observation& now,
                                             const std::vector<Observation>& before,
                                             const std::optional<InverseDepth>& depth,
                                             const SlidingWindow& window) const;
  bool contradicts_itself(LandmarkId landmark, const SlidingWindow& window) const;

  PointCueOptions options_;
  Camera camera_;
  DepthSensor depth_;
  StageTimes& times_;
  PointTracker tracker_;
  std::map<LandmarkId, std::vector<Observation>> observations_;  // of live tracks, in the window
  double prediction_error_px_ = 0;                               // median, of the last frame
};

}  // namespace placegraph
