#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/cues/cue_options.h>

#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// The Manhattan frames of a sliding window. The directions of a keyframe are an observation of the
/// Manhattan frame with which they agree; of the 24 equivalent rotations, the nearest one is used.
/// Directions that agree with none are kept as candidates, and several candidates that agree with
/// each other begin a new Manhattan frame. Frames remain while they are unobserved, with increasing
/// uncertainty as the camera moves on.
///
/// The axes of the map are a Manhattan frame of their own, which is observed once, exactly, by the
/// oldest keyframe at the time when the first Manhattan frame of the scene begins. They fix the
/// rotation of the window (SlidingWindow::hold_manhattan_frame): the heading from other frames
/// rotates the keyframes relative to the map, and does not rotate the map.
class ManhattanFrames {
 public:
  static constexpr ManhattanFrameId kMapAxes{};

  explicit ManhattanFrames(const ManhattanFrameOptions& options) : options_(options) {
    options_.check();
  }

  /// Predicted observation of a Manhattan frame in the newest keyframe.
  struct Expected {
    ManhattanFrameId manhattan_frame;
    SO3 R_cam_frame;
    Eigen::Matrix3d covariance;  ///< right tangent [rad^2]
  };
  /// Predictions, the most recently observed frame first.
  std::vector<Expected> expected(const SlidingWindow& window, KeyframeId keyframe) const;

  /// Adds the directions of a keyframe, with the covariance from the noise of their lines. Returns
  /// their Manhattan frame, which may be new; nothing while they are a candidate.
  std::optional<ManhattanFrameId> add(KeyframeId keyframe, const SO3& R_cam_manhattan,
                                      const Eigen::Matrix3d& covariance, SlidingWindow& window);
  /// Updates the covariances of the Manhattan frames in the newest keyframe, after the window has
  /// been optimized.
  void settle(const SlidingWindow& window);
  void reset();
  /// Covariance of the directions of one keyframe, including errors beyond the noise of its lines.
  Eigen::Matrix3d honest(const Eigen::Matrix3d& covariance) const;

 private:
  struct Candidate {
    KeyframeId keyframe;
    SO3 R_cam_manhattan;
    Eigen::Matrix3d covariance;
  };
  void see(const Candidate& observation, ManhattanFrameId manhattan_frame, SlidingWindow& window);
  std::optional<ManhattanFrameId> begin_manhattan_frame(const Candidate& newest,
                                                        SlidingWindow& window);
  void forget_one(SlidingWindow& window);

  ManhattanFrameOptions options_;
  ManhattanFrameId next_id_ = ++ManhattanFrameId(kMapAxes);
  std::vector<Candidate> candidates_;  // observations in keyframes of the window, ascending
  std::map<ManhattanFrameId, KeyframeId> last_seen_;  // last observation of each Manhattan frame
  // Covariance of each Manhattan frame in the last keyframe.
  std::map<ManhattanFrameId, Eigen::Matrix3d> covariance_;
};

}  // namespace placegraph
