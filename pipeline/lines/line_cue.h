#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/frontend/features/rectification.h>
#include <placegraph/frontend/features/stereo_matcher.h>
#include <placegraph/frontend/lines/floor_from_lines.h>
#include <placegraph/frontend/lines/line_feature.h>
#include <placegraph/frontend/lines/line_tracker.h>
#include <placegraph/frontend/lines/vanishing_direction_tracker.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/cues/cue_options.h>
#include <placegraph/pipeline/lines/line_observations.h>
#include <placegraph/pipeline/lines/line_tracks.h>

#include <map>
#include <set>
#include <vector>

namespace placegraph {

/// Tracks edges from frame to frame, estimates the pose of a frame against the lines of the window,
/// and adds the observations of keyframes to it, with a second camera if a right image or depth is
/// available.
class LineCue {
 public:
  LineCue(const LineCueOptions& options, const Calibration& calibration,
          const StereoMatcherOptions& stereo);

  /// Tracks all lines into an image taken at about `T_odom_cam`; lines outside the window are
  /// assumed to be at `depth`.
  void track(const Image& image, const SlidingWindow& window, const SE3& T_odom_cam, double depth);
  /// Pose of the newest image against the lines of the window.
  PoseFromLines pose(const SlidingWindow& window, const PoseGuess& guess, Random& random) const;
  /// Sets the pose of the newest image. Lines that contradict it are dropped.
  void accept(const SlidingWindow& window, const SE3& T_odom_cam);
  /// Detects new lines in the newest image, which is that of `keyframe`, and adds all observations
  /// to the window; lines with enough parallax become lines of the window. `rectification`:
  /// estimated rectification error of a stereo pair. `depth`: depth of edges without a line nearby.
  void observe(KeyframeId keyframe, const Frame& frame, const RectificationError& rectification,
               double depth, SlidingWindow& window);
  /// Enables rotation measurements from directions that lines share, for a monocular camera without
  /// points, which has few triangulated lines during a rotation.
  void use_vanishing_directions();
  /// Starts with an image, or tracks into it the edges found so far, while there is no window yet
  /// and the motion is unknown. New edges are tracked from here on.
  void track_uninitialized(const Frame& frame, const SE3& T_odom_start);
  /// Tracks in the newest image.
  LineView seen() const { return line_view(tracker_.tracks()); }
  /// Adds observations of an earlier keyframe to the window, for the initialization, in order of
  /// time.
  void observe_earlier(KeyframeId keyframe, const LineView& seen, SlidingWindow& window);
  /// Edges of the newest image, taken at T_odom_cam, with their lines where the window contains
  /// them; without descriptors.
  std::vector<LineFeature> features(const SlidingWindow& window, const SE3& T_odom_cam) const {
    return features_of_lines(calibration_.camera, tracker_.tracks(), window, T_odom_cam);
  }
  /// Lines of the window in the coordinates of the newest image.
  std::vector<PlacedLine> placed(const SlidingWindow& window) const;
  /// Directions that several of the lines in the newest keyframe share, in the window's frame.
  std::vector<SharedDirection> shared_directions() const;
  /// Constrains the direction of travel with lines along it at about `depth`, which are never
  /// triangulated. If the camera moves away from the direction of such a line, the line's plane
  /// rotates; a plane that has not rotated excludes positions of the newest keyframe.
  void constrain_translation(KeyframeId keyframe, double depth, SlidingWindow& window) const;
  /// Disparities of lines of the window, with their predictions from the motion of the left camera;
  /// each line is used once.
  std::vector<DisparitySample> disparity_samples(const SlidingWindow& window,
                                                 const RectificationError& rectification);
  /// Corrects the observations of the right camera after an update of the calibration.
  void revise_second_cameras(SlidingWindow& window, const RectificationError& before,
                             const RectificationError& now);
  /// Drops lines of the window that the newest keyframe contradicts.
  void prune(SlidingWindow& window);
  /// Depths, in the newest image, of the lines of the window observed in it.
  std::vector<double> depths(const SlidingWindow& window) const {
    return depths_of_lines(calibration_.camera, tracker_.tracks(), window, T_odom_last_);
  }
  /// Displacement of lines perpendicular to their direction since the last keyframe [px].
  std::vector<double> flow_px() const;
  /// Number of tracked lines of the window.
  int followed(const SlidingWindow& window) const { return count_lines(tracker_.tracks(), window); }
  std::vector<FrameView::Line> view(const SlidingWindow& window, const SE3& T_odom_cam) const {
    return view_of_lines(calibration_.camera, tracker_.tracks(), window, T_odom_cam);
  }
  void reset();

 private:
  void add_observations(KeyframeId keyframe, const std::map<LineId, LineInKeyframe>& now,
                        SlidingWindow& window);
  LineTriangulationOptions triangulation(const SlidingWindow& window) const;
  std::optional<PoseGuess> with_line_rotation(const PoseGuess& guess) const;
  void add_to_window(LineId id, const LineInKeyframe& line_in_keyframe,
                     SlidingWindow& window) const;
  void follow_mergers();
  void steer(KeyframeId keyframe, const LineView& seen, SlidingWindow& window);

  LineCueOptions options_;
  StereoMatcherOptions stereo_;
  Calibration calibration_;
  LineTracker tracker_;
  std::optional<VanishingDirectionTracker> vanishing_tracker_;
  SE3 T_odom_last_;                // pose of the newest image, once accepted
  SE3 T_odom_before_;              // pose of the previous image
  LineObservations observations_;  // observations of current tracks
  std::map<LineId, LineSegment> at_keyframe_;
  std::map<LineId, Eigen::Matrix4d> covariances_;  // covariances of lines of the window
  std::set<LineId> calibrated_;                    // lines of the window whose disparity was used
  std::map<LineId, double> drift_px_;  // perpendicular to the line, beyond the last prediction
};

}  // namespace placegraph
