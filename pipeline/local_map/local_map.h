#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/measurements/landmark.h>
#include <placegraph/pipeline/local_map/motion_uncertainty.h>

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace placegraph {

/// Source of the scale of a track segment.
enum class Scale {
  kMetric,    ///< stereo, depth, the camera's height, or another sensor
  kFromMap,   ///< frames that were recognized in the map
  kGuessed,   ///< the depth of the scene is assumed to be the same as before
  kArbitrary  ///< no source
};

/// Change of all lengths: a position p of this track segment is now centre + factor (p - centre).
struct Rescale {
  double factor = 1;
  Eigen::Vector3d centre_odom = Eigen::Vector3d::Zero();
};

/// The keyframes and landmarks of one track segment: those in the sliding window, and the retained
/// data of those that left it. Landmarks of earlier segments are retained, too. Keyframe ids
/// continue over all segments.
class LocalMap {
 public:
  static constexpr double kUnknownDepth = 10;  ///< median depth of a map with an arbitrary scale

  LocalMap(const SlidingWindowOptions& options, const Camera& camera, Scale scale);

  /// Begins another segment. `median_depth`: its expected median depth; nothing: as before.
  void restart(Scale scale, const std::optional<double>& median_depth);
  /// Sets the next keyframe's id and the median depth to those at the end of another run.
  void go_on_from(KeyframeId next_keyframe, double median_depth);

  /// Adds a keyframe at T_odom_cam to the window; returns its id. `stamp_ns`: its time, if known.
  KeyframeId add_keyframe(const SE3& T_odom_cam, const std::optional<std::int64_t>& stamp_ns = {});
  /// Adds the pose of a frame of this segment to what is known of the stamps.
  void add_frame(std::int64_t stamp_ns, const SE3& T_odom_cam) {
    uncertainty_.add_frame(stamp_ns, T_odom_cam);
  }
  /// Removes all keyframes and landmarks of this segment, as if they had never been added;
  /// `median_depth`: the value before them.
  void discard(double median_depth);
  /// Optimizes the window; does nothing for a single keyframe.
  Outcome optimize();
  /// Stores the poses of the window. `depths`: depths of landmarks in the newest keyframe.
  /// `rotations_corrected`: whether rotations are constrained by more than the window's keyframes
  /// (by a Manhattan frame); the rotation of the oldest keyframe since the last call is then an
  /// error of the motion between it and the previous keyframe, which has left the window.
  void update_poses(const std::vector<double>& depths, bool rotations_corrected);
  /// Reduces the window to its size. The link from a keyframe to the next is stored when it leaves,
  /// as are the landmarks that leave with it.
  void marginalize();
  /// Multiplies all lengths of the segment by `factor`, about the oldest keyframe of the window;
  /// the scale is metric from now on.
  Rescale rescale(double factor);

  Scale scale() const { return scale_; }
  bool metric() const { return scale_ == Scale::kMetric; }
  void set_scale(Scale scale) { scale_ = scale; }
  double median_depth() const { return median_depth_; }

  /// Uncertainty of the motion between keyframes `id` and `id` + 1. If the scale is not metric, the
  /// length of the motion is treated as known in the scale of `id`, and `sigma_log_scale` is the
  /// standard deviation of the change of scale up to `id` + 1.
  struct Link {
    AssessedMotion motion;  ///< T_id_next
    double sigma_log_scale = 0;
  };
  Link link(KeyframeId id) const;
  /// Uncertainty of the motion between any two keyframes of the window, with all keyframes between
  /// them marginalized.
  AssessedMotion motion(KeyframeId from, KeyframeId to) const;
  /// Information of a motion by all that has been learned until now.
  Matrix6d information(const AssessedMotion& motion) const;
  const MotionUncertainty& uncertainty() const { return uncertainty_; }
  /// What is learned over all segments and not part of a saved map.
  void visit_state(auto& archive) { archive(uncertainty_, assessed_); }

  /// Newest estimate T_odom_cam of a keyframe of this segment.
  SE3 pose(KeyframeId keyframe) const { return poses_.at(keyframe); }
  bool empty() const { return next_ == first_; }  ///< no keyframe in this segment yet
  KeyframeId first() const { return first_; }     ///< the segment's first keyframe
  /// The segment's last keyframe, if it is not empty.
  KeyframeId newest() const { return back(1); }
  /// The keyframe before the newest one; nothing if that is the first of the segment.
  std::optional<KeyframeId> before_newest() const {
    return back(2) < first_ ? std::nullopt : std::optional(back(2));
  }
  /// The oldest keyframe of the window; nothing if the window is empty.
  std::optional<KeyframeId> window_begin() const;
  /// Number of points and lines of the window.
  int landmarks_in_window() const;
  /// All landmarks of all segments, each relative to the keyframe that first observed it, from
  /// index `first` on. Those that have left the window come first (settled_landmarks()), and keep
  /// their index.
  std::vector<PointLandmark> landmarks(std::size_t first = 0) const;
  /// Image points of landmarks in the keyframes from `from` on, of all segments, ascending by
  /// landmark; keyframes without any are left out. Landmarks that were refused later are not among
  /// landmarks().
  std::vector<std::pair<KeyframeId, std::vector<LandmarkObservation>>> observations(
      KeyframeId from) const;
  std::size_t settled_landmarks() const { return past_landmarks_.size(); }

  SlidingWindow& window() { return window_; }
  const SlidingWindow& window() const { return window_; }

 private:
  /// The id of the keyframe `keyframes` before the next one.
  KeyframeId back(int keyframes) const { return KeyframeId(next_.value() - keyframes); }
  PointLandmark describe(LandmarkId landmark) const;  // without its covariance
  std::optional<Eigen::Matrix3d> covariance_of(const PointLandmark& landmark) const;
  std::vector<WindowObservation> window_observations() const;
  void keep_observation(const WindowObservation& observation);
  double scale_drift() const;
  Matrix6d stated_information(KeyframeId from, KeyframeId to) const;
  void widen_link_to_oldest();

  SlidingWindowOptions options_;
  Camera camera_;
  SlidingWindow window_;
  MotionUncertainty uncertainty_;
  KeyframeId assessed_ = KeyframeId::lowest();  // newest keyframe of the last assessed window
  Scale scale_;
  double median_depth_ = kUnknownDepth;
  KeyframeId first_, next_;
  std::map<KeyframeId, SE3> poses_;
  std::map<KeyframeId, Link> links_;           // links of keyframes that left the window
  std::vector<PointLandmark> past_landmarks_;  // landmarks that left the window
  // Observations that left the window, with their keyframe or their landmark, and the landmarks of
  // the window that have some.
  std::map<KeyframeId, std::vector<LandmarkObservation>> past_observations_;
  std::set<LandmarkId> observed_before_;
};

}  // namespace placegraph
