#pragma once
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/landmark.h>

#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// Where the unit of length of a track segment comes from.
enum class Scale {
  kMetric,    ///< stereo, depth, the camera's height, or another sensor
  kFromMap,   ///< frames that were recognized in the map
  kGuessed,   ///< what is seen is taken to be as far away as what was seen before
  kArbitrary  ///< nothing
};

/// All lengths have grown: a position p of this track segment is now centre + factor (p - centre).
struct Rescale {
  double factor = 1;
  Eigen::Vector3d centre_odom = Eigen::Vector3d::Zero();
};

/// The keyframes and landmarks of one segment of uninterrupted tracking: those in the sliding
/// window, and what is kept of those that left it. Landmarks of earlier segments are kept, too.
/// Keyframe ids go on counting over all segments.
class LocalMap {
 public:
  static constexpr double kUnknownDepth = 10;  ///< median depth of a map with an arbitrary unit

  LocalMap(const SlidingWindowOptions& options, const Camera& camera, Scale scale);

  /// Begins another segment. `median_depth`: of what it will see; nothing: as before.
  void restart(Scale scale, const std::optional<double>& median_depth);
  /// The next keyframe's id, and how far away things are, as another run left them.
  void go_on_from(KeyframeId next_keyframe, double median_depth);

  /// Adds a keyframe at T_odom_cam to the window; returns its id.
  KeyframeId add_keyframe(const SE3& T_odom_cam);
  /// Takes back all keyframes and landmarks of this segment, as if they had never been added;
  /// `median_depth`: that before them.
  void discard(double median_depth);
  /// Optimizes the window; there is nothing to optimize about a single keyframe.
  Outcome optimize();
  /// Takes over the poses of the window. `depths`: of landmarks in the newest keyframe.
  /// `rotations_corrected`: whether something beyond the window's keyframes (a Manhattan frame)
  /// holds rotations; what the oldest keyframe was rotated by since the last call is then an error
  /// of the motion between it and the keyframe before it, which has left the window.
  void update_poses(const std::vector<double>& depths, bool rotations_corrected);
  /// Reduces the window to its size. What is known of a keyframe's motion to the next is kept when
  /// it leaves, as are the landmarks that leave with it.
  void marginalize();
  /// All lengths of the segment grow by `factor` about the oldest keyframe of the window; the scale
  /// is metric from now on.
  Rescale rescale(double factor);

  Scale scale() const { return scale_; }
  bool metric() const { return scale_ == Scale::kMetric; }
  void set_scale(Scale scale) { scale_ = scale; }
  double median_depth() const { return median_depth_; }

  /// What is known of the motion between keyframes `id` and `id` + 1. Where the scale is not
  /// metric, the motion's length counts as known in the unit of `id`, and `sigma_log_scale` is how
  /// far the unit may have changed by `id` + 1.
  struct Link {
    Matrix6d information = Matrix6d::Zero();  ///< right tangent of T_id_next
    double sigma_log_scale = 0;
  };
  Link link(KeyframeId id) const;
  /// The same information of the motion between any two keyframes of the window, everything between
  /// them marginalized.
  Matrix6d motion_information(KeyframeId from, KeyframeId to) const;

  /// Newest estimate T_odom_cam of a keyframe of this segment.
  SE3 pose(KeyframeId keyframe) const { return poses_.at(keyframe); }
  bool empty() const { return next_ == first_; }  ///< no keyframe in this segment yet
  KeyframeId first() const { return first_; }     ///< the segment's first keyframe
  KeyframeId newest() const { return back(1); }   ///< its last one, if it is not empty
  /// The keyframe before the newest one; nothing if that is the first of the segment.
  std::optional<KeyframeId> before_newest() const {
    return back(2) < first_ ? std::nullopt : std::optional(back(2));
  }
  /// The oldest keyframe of the window; nothing while there is none.
  std::optional<KeyframeId> window_begin() const;
  /// Points and lines of the window.
  int landmarks_in_window() const;
  /// All landmarks of all segments, each relative to the keyframe that first saw it, from the
  /// `first`-th on. Those that have left the window stand first (settled_landmarks()), and keep
  /// their place.
  std::vector<PointLandmark> landmarks(std::size_t first = 0) const;
  std::size_t settled_landmarks() const { return past_landmarks_.size(); }

  SlidingWindow& window() { return window_; }
  const SlidingWindow& window() const { return window_; }

 private:
  /// So many keyframes before the next one.
  KeyframeId back(int keyframes) const { return KeyframeId(next_.value() - keyframes); }
  PointLandmark describe(LandmarkId landmark) const;
  double scale_drift() const;
  void widen_link_to_oldest();

  SlidingWindowOptions options_;
  Camera camera_;
  SlidingWindow window_;
  Scale scale_;
  double median_depth_ = kUnknownDepth;
  KeyframeId first_, next_;
  std::map<KeyframeId, SE3> poses_;
  std::map<KeyframeId, Link> links_;           // of keyframes that left the window
  std::vector<PointLandmark> past_landmarks_;  // that left the window
};

}  // namespace placegraph
