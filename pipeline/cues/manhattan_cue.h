#pragma once
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/pipeline/cues/cue_options.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/cues/ground_mask.h>
#include <placegraph/pipeline/cues/manhattan_frames.h>

namespace placegraph {

/// Adds rotation measurements from Manhattan frames to the window: the straight edges of a keyframe
/// provide the directions of its scene, which are observations of the window's Manhattan frames
/// (ManhattanFrames). Known Manhattan frames are tracked from their predicted rotation; only if
/// none is observed, all directions are searched. An observation is accepted if it shows at least
/// two axes, is sufficiently accurate about all three rotation axes, and agrees with its Manhattan
/// frame.
class ManhattanCue {
 public:
  ManhattanCue(const ManhattanCueOptions& options, const Camera& camera, std::uint64_t seed,
               LogSink log);

  /// Adds the directions of a keyframe to the window. `segments`: edges of the image, if they have
  /// already been detected.
  void observe(KeyframeId keyframe, const Image& image,
               const std::optional<std::vector<LineSegment>>& segments, SlidingWindow& window);
  void settle(const SlidingWindow& window) { manhattan_frames_.settle(window); }
  /// Observation of a Manhattan frame of the window in an image taken at about R_odom_cam: the most
  /// recently observed one that is accepted. Nothing if none is accepted.
  struct RotationEstimate {
    ManhattanFrameId manhattan_frame;
    SO3 R_cam_frame;
    Eigen::Matrix3d information;  ///< right tangent [1/rad^2]
  };
  std::optional<RotationEstimate> manhattan_rotation(const Image& image, const SO3& R_odom_cam,
                                                     const SlidingWindow& window,
                                                     KeyframeId keyframe) const;
  /// Edges of the last keyframe's image that were examined, with their Manhattan frame and axis.
  const std::vector<FrameView::DirectedLine>& view() const { return view_; }
  /// Ground mask from the edges of the last keyframe, if walls cover part of the assumed ground
  /// (`outline_px`), as in corridors: if edges show a floor, the mask is that floor, which is
  /// level; otherwise it is the area in front of the walls.
  GroundMask ground(const std::vector<Eigen::Vector2d>& outline_px) const;
  void reset();

 private:
  /// Observation of a Manhattan frame, known or new, in the last keyframe.
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

/// Pose with covariance `information`^-1 (right tangent) that agrees best with a heading: the
/// position follows the rotation according to the information. Returns the pose unchanged without a
/// heading, or if the window does not contain its Manhattan frame.
SE3 with_manhattan_rotation(const SE3& T_odom_cam, const Matrix6d& information,
                            const std::optional<ManhattanCue::RotationEstimate>& manhattan_rotation,
                            const SlidingWindow& window);

}  // namespace placegraph
