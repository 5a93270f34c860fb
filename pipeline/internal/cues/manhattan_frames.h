#pragma once
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/cues/cue_options.h>

#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// The rectangular worlds that a sliding window knows. A view's directions are a sighting of the
/// world they agree with, of the 24 frames along the same axes the one nearest to it; those that
/// agree with none wait, and several of them that agree with each other begin a new world. Worlds
/// go on unseen, known ever less well as the motion goes on.
///
/// The axes of the map are a world of their own, seen once, exactly, by the oldest keyframe at the
/// time when the first rectangular one begins. They hold the window
/// (SlidingWindow::hold_manhattan_frame): what the others say about the heading turns the
/// keyframes, and not the map under them.
class ManhattanFrames {
 public:
  static constexpr ManhattanFrameId kMapAxes{};

  explicit ManhattanFrames(const ManhattanFrameOptions& options) : options_(options) {
    options_.check();
  }

  /// How the newest keyframe should see a world.
  struct Expected {
    ManhattanFrameId manhattan_frame;
    SO3 R_cam_frame;
    Eigen::Matrix3d covariance;  ///< right tangent [rad^2]
  };
  /// Those seen last first.
  std::vector<Expected> expected(const SlidingWindow& window, KeyframeId keyframe) const;

  /// Hands the directions of a keyframe's view over, with the covariance of their lines' noise.
  /// Returns the world they are of, which they may begin; nothing while they wait.
  std::optional<ManhattanFrameId> add(KeyframeId keyframe, const SO3& R_cam_manhattan,
                                      const Eigen::Matrix3d& covariance, SlidingWindow& window);
  /// After the window has been optimized: how well the newest keyframe knows the worlds.
  void settle(const SlidingWindow& window);
  void reset();
  /// Of the directions of one view, with what is beyond the noise of its lines.
  Eigen::Matrix3d honest(const Eigen::Matrix3d& covariance) const;

 private:
  struct Candidate {
    KeyframeId keyframe;
    SO3 R_cam_manhattan;
    Eigen::Matrix3d covariance;
  };
  void see(const Candidate& observation, ManhattanFrameId manhattan_frame, SlidingWindow& window);
  std::optional<ManhattanFrameId> begin_frame(const Candidate& newest, SlidingWindow& window);
  void forget_one(SlidingWindow& window);

  ManhattanFrameOptions options_;
  ManhattanFrameId next_frame_ = ++ManhattanFrameId(kMapAxes);
  std::vector<Candidate> candidates_;                 // of keyframes in the window, ascending
  std::map<ManhattanFrameId, KeyframeId> last_seen_;  // of worlds
  std::map<ManhattanFrameId, Eigen::Matrix3d>
      covariance_;  // of worlds, as the last keyframe knew them
};

}  // namespace placegraph
