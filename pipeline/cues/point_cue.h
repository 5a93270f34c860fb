#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/frontend/features/rgbd_errors.h>
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/pipeline/cues/cue_options.h>
#include <placegraph/pipeline/cues/depth_sensor.h>
#include <placegraph/pipeline/cues/direct_cue.h>

#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// Tracks point features from frame to frame, poses frames against the landmarks of the sliding
/// window, and adds the observations of keyframes to it.
class PointCue {
 public:
  /// `times`, which must outlive the cue, receives the CPU time of its stages.
  PointCue(const PointCueOptions& options, const Calibration& calibration,
           const StereoMatcherOptions& stereo, StageTimes& times);

  const std::vector<PointTrack>& tracks() const { return tracker_.tracks(); }
  const PointCueOptions& options() const { return options_; }

  /// Sets the errors that pixels and depths are corrected by.
  void correct(const RgbdErrors& errors) { errors_ = errors; }
  const RgbdErrors& errors() const { return errors_; }
  /// Sets the velocity of the camera at the newest image, on which the errors of times depend.
  void set_velocity(const Vector6d& twist) { twist_ = twist; }

  /// Tracks the points into an image without a map.
  void track(const Image& image);
  struct TrackedPose {
    Pose3d2dResult pose;     ///< T_ref_cam is T_odom_cam
    std::vector<bool> keep;  ///< one flag per track: whether it agrees with the pose
    int landmarks = 0;       ///< number of tracks with a landmark
  };
  /// Tracks the points into an image whose predicted pose is `T_odom_expected`, and estimates its
  /// pose against the landmarks of the window. `T_odom_last`: pose of the previous image.
  /// `velocity_known`: whether the prediction is based on a measured velocity. The depth of points
  /// without a landmark is assumed to be that of neighbouring points, or else `median_depth`.
  [[nodiscard]] TrackedPose follow(const Image& image, const SlidingWindow& window,
                                   const SE3& T_odom_last, const SE3& T_odom_expected,
                                   bool velocity_known, double median_depth, Random& random);
  /// Pose of the newest image from its current tracks.
  [[nodiscard]] TrackedPose pose(const SlidingWindow& window, const SE3& T_odom_prior,
                                 Random& random) const;
  /// Drops the tracks whose flag is false.
  void keep(const std::vector<bool>& flags) { tracker_.keep(flags); }

  /// Moves the tracks to the positions at which their reference patches are found in the newest
  /// image. Returns the displacement of each [px]: its accumulated drift.
  std::map<LandmarkId, Eigen::Vector2d> anchor();
  /// Drops tracks where `still` is 0 (CV_8UC1, the image's size), if enough others remain.
  void drop_tracks_on_movable_objects(const Image& still);
  /// Drops tracks where `mask` is 0 (CV_8UC1, the image's size), and their landmarks.
  void drop_masked(const Image& mask, SlidingWindow& window);
  /// Detects new points in the newest image where `mask` allows them. If the mask was made from
  /// semantic labels (`labelled`) and too few points are found, detects points wherever
  /// `given_mask` allows them.
  void detect(const Image& mask, bool labelled, const Image& given_mask);
  /// Adds the newest image's tracks to the window as observations of `keyframe`. Points with depth
  /// or enough parallax become landmarks.
  void observe(KeyframeId keyframe, const Frame& frame, const RectificationError& rectification,
               SlidingWindow& window);
  /// A point in the two views that initialize a map.
  struct TwoViewPoint {
    LandmarkId track;
    Eigen::Vector2d px_ref, px_cur;
    Eigen::Matrix2d covariance_px;
    std::optional<Eigen::Vector3d> point_odom;  ///< nothing: not triangulated
  };
  /// Adds the points of the first two keyframes of a monocular map to the window.
  void observe_two_views(KeyframeId ref, KeyframeId cur, const std::vector<TwoViewPoint>& points,
                         SlidingWindow& window);
  /// Stores observations, by `keyframe` (the newest image), of tracks that were detected after it
  /// was added.
  void observe_new_tracks(KeyframeId keyframe);
  /// Removes landmarks that do not fit from the window. Returns the depths of the other tracked
  /// landmarks in keyframe `newest` [m, or in the scale of the map].
  std::vector<double> prune(SlidingWindow& window, KeyframeId newest);

  /// Tracked landmarks with their corrected pixel in the newest image, whose pose is T_odom_cam.
  std::vector<std::pair<LandmarkId, Eigen::Vector2d>> landmark_pixels(const SlidingWindow& window,
                                                                      const SE3& T_odom_cam) const;
  /// The same with their depths in `keyframe`, which must be the newest image, for a cue that needs
  /// depths: they are assumed to be accurate to a few per cent.
  std::vector<KnownPixel> landmark_depths(const SlidingWindow& window, KeyframeId keyframe) const;
  int tracked_landmarks(const SlidingWindow& window) const;

  /// Copy of the tracks, to be restored if a frame cannot be posed.
  PointTracker checkpoint() const { return tracker_; }
  void restore(PointTracker checkpoint) { tracker_ = std::move(checkpoint); }
  /// Drops all tracks but keeps the observations of keyframes.
  void drop_tracks() { tracker_.reset(); }
  void reset();

 private:
  struct Observation {
    KeyframeId keyframe;
    Eigen::Vector2d px;  // as tracked
    Eigen::Matrix2d covariance_px;
    Vector6d twist = Vector6d::Zero();  // the velocity at the keyframe
  };
  std::vector<bool> used_by(const Image& mask) const;
  std::vector<Eigen::Vector2f> predict(const SlidingWindow& window, const SE3& T_odom_last,
                                       const SE3& T_odom_cam, double median_depth) const;
  Eigen::Vector2d corrected_px(const Eigen::Vector2d& px, const Vector6d& twist,
                               const std::optional<Eigen::Vector3d>& p_cam) const;
  std::vector<Eigen::Vector2d> corrected_px(const SlidingWindow& window,
                                            const SE3& T_odom_cam) const;
  std::vector<std::optional<MeasuredInverseDepth>> measure_depth(
      const Frame& frame, const std::vector<Eigen::Vector2d>& at_px,
      const RectificationError& rectification, const SE3& T_odom_cam,
      const SlidingWindow& window) const;
  std::optional<Eigen::Vector3d> place_point(KeyframeId keyframe, const Eigen::Vector2d& px,
                                             const std::vector<Observation>& before,
                                             const std::optional<MeasuredInverseDepth>& depth,
                                             const SlidingWindow& window) const;
  bool contradicts_itself(LandmarkId landmark, const SlidingWindow& window) const;

  PointCueOptions options_;
  Camera camera_;
  std::optional<DepthCamera> depth_camera_;  // unless depth is from stereo
  DepthSensor depth_;
  StageTimes& times_;
  PointTracker tracker_;
  std::map<LandmarkId, std::vector<Observation>> observations_;  // current tracks, in the window
  double prediction_error_px_ = 0;                               // median of the last frame
  RgbdErrors errors_;
  Vector6d twist_ = Vector6d::Zero();
};

}  // namespace placegraph
