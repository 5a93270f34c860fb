#pragma once
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/frontend/internal/features/rectification.h>
#include <placegraph/frontend/internal/features/stereo_matcher.h>
#include <placegraph/frontend/internal/lines/floor_from_lines.h>
#include <placegraph/frontend/internal/lines/line_feature.h>
#include <placegraph/frontend/internal/lines/line_tracker.h>
#include <placegraph/frontend/internal/lines/vanishing_direction_tracker.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/cues/cue_options.h>
#include <placegraph/pipeline/internal/lines/line_observations.h>
#include <placegraph/pipeline/internal/lines/line_tracks.h>

#include <map>
#include <set>
#include <vector>

namespace placegraph {

/// The share of lines in motion memory: follows edges from frame to frame, poses a frame against
/// the lines of the window, and gives keyframes' sightings to it, with second eyes where there is a
/// right one or depth.
class LineCue {
 public:
  LineCue(const LineCueOptions& options, const Calibration& calibration,
          const StereoMatcherOptions& stereo);

  /// Follows all lines into an image taken at about `T_odom_cam`; those not in the window are
  /// thought to lie at `depth`.
  void track(const Image& image, const SlidingWindow& window, const SE3& T_odom_cam, double depth);
  /// Pose of the newest image against the lines of the window.
  PoseFromLines pose(const SlidingWindow& window, const PoseGuess& guess, Random& random) const;
  /// Tells where the newest image was taken. Lines that contradict it are no longer followed.
  void accept(const SlidingWindow& window, const SE3& T_odom_cam);
  /// Detects new lines in the newest image, which is that of `keyframe`, and adds what it sees to
  /// the window; lines with enough parallax become lines of the window. `rectification`: what the
  /// two eyes, where there are two, are thought to be off by. `depth`: of what no line is beside.
  void observe(KeyframeId keyframe, const Frame& frame, const RectificationError& rectification,
               double depth, SlidingWindow& window);
  /// Rotation is seen by the directions that lines share, too: for a single eye without points,
  /// which knows the place of few lines in a turn.
  void use_compass();
  /// Begins with an image, or follows into it what was begun, while there is no window yet: nothing
  /// is known of the motion. Edges that are new are followed from here on.
  void wait(const Frame& frame, const SE3& T_odom_start);
  /// Where the tracks are seen in the newest image.
  LineView seen() const { return line_view(tracker_.tracks(), options_.sigma_floor_px); }
  /// Adds what an earlier keyframe saw to the window: to begin with, in order of time.
  void observe_earlier(KeyframeId keyframe, const LineView& seen, SlidingWindow& window);
  /// Edges of the newest image, taken at T_odom_cam, with their lines where the window has them;
  /// not described.
  std::vector<LineFeature> features(const SlidingWindow& window, const SE3& T_odom_cam) const {
    return features_of_lines(calibration_.camera, tracker_.tracks(), window, T_odom_cam);
  }
  /// Lines of the window as the newest image sees them.
  std::vector<PlacedLine> placed(const SlidingWindow& window) const;
  /// Directions that several of the lines in the newest keyframe share, in the window's frame.
  std::vector<SharedDirection> shared_directions() const;
  /// Lines along the way, at about `depth`, are never placed: their planes hold the way instead. A
  /// camera that leaves the direction of such a line sees its plane turn, so what did not turn says
  /// where the newest keyframe does not lie.
  void hold_course(KeyframeId keyframe, double depth, SlidingWindow& window) const;
  /// Disparities of lines of the window beside what the left eye's motion says of them, each line's
  /// once.
  std::vector<DisparitySample> disparity_samples(const SlidingWindow& window,
                                                 const RectificationError& rectification);
  /// What right eyes saw follows a better calibration.
  void revise_second_cameras(SlidingWindow& window, const RectificationError& before,
                             const RectificationError& now);
  /// Drops lines of the window that the newest keyframe contradicts.
  void prune(SlidingWindow& window);
  /// Depths, in the newest image, of the lines of the window that it sees.
  std::vector<double> depths(const SlidingWindow& window) const {
    return depths_of_lines(calibration_.camera, tracker_.tracks(), window, T_odom_last_);
  }
  /// How far lines have moved across since the last keyframe [px].
  std::vector<double> flow_px() const;
  /// Lines of the window that are followed.
  int followed(const SlidingWindow& window) const { return count_lines(tracker_.tracks(), window); }
  std::vector<FrameView::Line> view(const SlidingWindow& window, const SE3& T_odom_cam) const {
    return view_of_lines(calibration_.camera, tracker_.tracks(), window, T_odom_cam);
  }
  void reset();

 private:
  void add_observations(KeyframeId keyframe, const std::map<LineId, LineInKeyframe>& now,
                        SlidingWindow& window);
  LineTriangulationOptions triangulation(const SlidingWindow& window) const;
  std::optional<PoseGuess> with_heading(const PoseGuess& guess) const;
  void add_to_window(LineId id, const LineInKeyframe& line_in_keyframe,
                     SlidingWindow& window) const;
  void follow_mergers();
  void steer(KeyframeId keyframe, const LineView& seen, SlidingWindow& window);

  LineCueOptions options_;
  StereoMatcherOptions stereo_;
  Calibration calibration_;
  LineTracker tracker_;
  std::optional<VanishingDirectionTracker> compass_;
  SE3 T_odom_last_;                // of the newest image, once accepted
  SE3 T_odom_before_;              // of the image before
  LineObservations observations_;  // of live tracks
  std::map<LineId, LineSegment> at_keyframe_;
  std::map<LineId, Eigen::Matrix4d> covariances_;  // of lines of the window
  std::set<LineId> calibrated_;        // lines of the window whose disparity was given out
  std::map<LineId, double> drift_px_;  // across, beyond what was predicted last
};

}  // namespace placegraph
