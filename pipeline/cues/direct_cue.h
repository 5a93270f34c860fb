#pragma once
#include <placegraph/frontend/align/direct_motion.h>
#include <placegraph/frontend/features/rectification.h>
#include <placegraph/frontend/features/stereo_matcher.h>
#include <placegraph/frontend/planes/dominant_surface.h>
#include <placegraph/graph/geometry/lie.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/cues/cue_options.h>
#include <placegraph/pipeline/cues/depth_sensor.h>
#include <placegraph/pipeline/cues/frame_view.h>

#include <optional>
#include <vector>

namespace placegraph {

/// A pixel whose depth is known.
struct KnownPixel {
  Eigen::Vector2f px;
  MeasuredInverseDepth depth;
};

/// Motion from direct alignment of surfaces (Siddiqui 2015): detects the dominant surface, or
/// several, in a keyframe, and aligns later frames with all of them under one motion.
class DirectCue {
 public:
  /// `several`: use all planes that are found, not only the dominant one.
  DirectCue(const DirectCueOptions& options, const Calibration& calibration,
            const StereoMatcherOptions& stereo, bool several);

  /// Sets the newest image, which all functions below use.
  void see(const Frame& frame);
  /// Restricts the search for the ground in the newest image: 0 = no ground, CV_8UC1 of its size or
  /// empty.
  void restrict_ground(const Image& mask) { ground_mask_ = mask; }
  /// Estimates the motion of the newest image from the reference: starting at the guess, or after a
  /// search around it within `sigmas`.
  [[nodiscard]] DirectMotion align(const MotionGuess& guess) const;
  [[nodiscard]] DirectMotion search(const MotionGuess& guess, const Vector6d& sigmas) const;
  /// Makes the newest image the reference; `landmarks` provide the planes of a monocular camera
  /// besides the ground. Returns false if no surface is found; the last reference then remains.
  bool become_reference(const SE3& T_last_cur, const RectificationError& rectification,
                        const std::vector<KnownPixel>& landmarks, Random& random);
  /// Motion from the last reference to this one, which is estimated in both directions: the mean of
  /// `forward` and of the backward alignment, weighted by their covariances. If they contradict
  /// each other, `forward` with its covariance increased accordingly and the outcome
  /// `inconsistent`.
  [[nodiscard]] DirectMotion confirm(const DirectMotion& forward) const;
  /// Updates the mounting angles of a monocular camera.
  void learn(const DirectMotion& motion);

  bool has_reference() const { return !reference_.patches().empty(); }
  /// Median depth of the reference's surfaces [m].
  double median_depth_m() const;
  void reset();
  /// Pixels of the newest alignment, for drawing.
  std::vector<FrameView::SurfacePixel> view(const DirectMotion& motion) const;

 private:
  std::vector<SurfacePatch> ground(const SE3& T_last_cur, const RectificationError& rectification,
                                   Random& random);
  std::vector<KnownPixel> search_around(const RectificationError& rectification) const;
  std::vector<SurfacePatch> planes(std::vector<KnownPixel> known, double reach_px,
                                   Random& random) const;
  void refine(std::vector<SurfacePatch>& patches, const RectificationError& rectification) const;
  void find_ground(const RectificationError& rectification, Random& random);
  SurfacePatch patch(const Eigen::Vector3d& g, const Eigen::Matrix3d& covariance,
                     std::vector<Eigen::Vector2f> px, double reach_px) const;
  Image mask_of_ground() const;
  int grid_step(int count) const;
  std::vector<Eigen::Vector2f> grid(int count) const;

  DirectCueOptions options_;
  Calibration calibration_;
  DepthSensor depth_;
  bool several_, mono_;
  std::optional<DominantSurface> ground_;
  Eigen::Vector3d mounting_ = Eigen::Vector3d::UnitY();  // mean normal of the ground; monocular
  double mounting_variance_rad2_;
  // Dominant plane of the last reference, in its camera.
  Eigen::Vector3d dominant_g_ = Eigen::Vector3d::Zero();
  Frame frame_;
  Image ground_mask_;
  std::vector<Image> pyramid_, reference_pyramid_, last_pyramid_;
  DirectReference reference_, last_reference_;
};

}  // namespace placegraph
