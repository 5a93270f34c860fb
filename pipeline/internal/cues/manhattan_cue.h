#pragma once
#include <placegraph/frontend/internal/segments/segment_detector.h>
#include <placegraph/frontend/internal/vanishing/scene_directions.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/pipeline/cues/cue_options.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/internal/cues/ground_mask.h>
#include <placegraph/pipeline/internal/cues/manhattan_frames.h>

namespace placegraph {

/// The share of rectangular worlds in motion memory: the straight edges of a keyframe give the
/// directions of its scene, which are sightings of the window's worlds (ManhattanFrames). Known
/// worlds are followed from where the window expects them; only where none is seen, all directions
/// are looked for. Believed is what shows two axes at least, is known well enough in all three
/// turns, and agrees with its world.
class ManhattanCue {
 public:
  ManhattanCue(const ManhattanCueOptions& options, const Camera& camera, std::uint64_t seed,
               LogSink log);

  /// `segments`: edges of the image, if they are known already.
  void observe(KeyframeId keyframe, const Image& image,
               const std::optional<std::vector<LineSegment>>& segments, SlidingWindow& window);
  void settle(const SlidingWindow& window) { manhattan_frames_.settle(window); }
  /// A world of the window as a frame sees it, which is taken from about R_odom_cam: the one seen
  /// last that is believed. Nothing if none is.
  struct RotationEstimate {
    ManhattanFrameId manhattan_frame;
    SO3 R_cam_frame;
    Eigen::Matrix3d information;  ///< right tangent [1/rad^2]
  };
  std::optional<RotationEstimate> heading(const Image& image, const SO3& R_odom_cam,
                                          const SlidingWindow& window, KeyframeId keyframe) const;
  /// The edges of the last keyframe's image that were looked at, with their world and axis.
  const std::vector<FrameView::DirectedLine>& view() const { return view_; }
  /// What the edges of the last keyframe tell of the ground, if walls stand in what is taken for it
  /// (`outline_px`), as they do in corridors: where a floor is shown, it is that, and level; else
  /// it is whatever may lie before the walls.
  GroundMask ground(const std::vector<Eigen::Vector2d>& outline_px) const;
  void reset();

 private:
  /// What the last keyframe saw of a rectangular world, known already or not.
  struct Observation {
    std::vector<LineSegment> segments;
    std::vector<int> axis;
    SO3 R_cam_manhattan;
    Eigen::Matrix3d covariance;  ///< right tangent [rad^2]
  };
  std::vector<LineSegment> detect(const Image& image) const;
  ManhattanFrame track(const std::vector<LineSegment>& segments,
                       const ManhattanFrames::Expected& manhattan_frame) const;
  bool trusted(const ManhattanFrame& frame) const;
  bool take(KeyframeId keyframe, const std::vector<LineSegment>& segments,
            const ManhattanFrame& frame, SlidingWindow& window);

  ManhattanCueOptions options_;
  Camera camera_;
  std::uint64_t seed_;
  LogSink log_;
  ManhattanFrames manhattan_frames_;
  std::optional<Observation> observation_;
  std::vector<FrameView::DirectedLine> view_;
};

/// A pose, known by `information` (right tangent), where a heading agrees with it best: the
/// position follows the rotation as far as the information lets it. The pose as it is without a
/// heading, or if the window does not hold its Manhattan frame.
SE3 with_heading(const SE3& T_odom_cam, const Matrix6d& information,
                 const std::optional<ManhattanCue::RotationEstimate>& heading,
                 const SlidingWindow& window);

}  // namespace placegraph
