#pragma once
#include <placegraph/frontend/internal/align/direct_motion.h>
#include <placegraph/frontend/internal/features/rectification.h>
#include <placegraph/frontend/internal/features/stereo_matcher.h>
#include <placegraph/frontend/internal/planes/dominant_surface.h>
#include <placegraph/graph/geometry/lie.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/pipeline/cues/cue_options.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/internal/cues/depth_sensor.h>

#include <optional>
#include <vector>

namespace placegraph {

/// A pixel whose depth is known.
struct KnownPixel {
  Eigen::Vector2f px;
  InverseDepth depth;
};

/// The share of surfaces in motion memory (Siddiqui 2015): finds the dominant surface, or several,
/// in a keyframe, and aligns later frames with it as a whole, under one motion.
class DirectCue {
 public:
  /// `several`: all planes that are found, not the dominant one alone.
  DirectCue(const DirectCueOptions& options, const Calibration& calibration,
            const StereoMatcherOptions& stereo, bool several);

  /// The newest image; everything below speaks of it.
  void see(const Frame& frame);
  /// Where in it the ground may be looked at: 0 = not there, CV_8UC1 of its size or empty.
  void restrict_ground(const Image& mask) { ground_mask_ = mask; }
  /// Its motion from the reference: from the guess, or after a search about it by `sigmas`.
  [[nodiscard]] DirectMotion align(const MotionGuess& guess) const;
  [[nodiscard]] DirectMotion search(const MotionGuess& guess, const Vector6d& sigmas) const;
  /// Makes it the reference; `landmarks` show a single eye what planes there are beside the ground.
  /// False where no surface is found: then the last reference stays.
  bool become_reference(const SE3& T_last_cur, const RectificationError& rectification,
                        const std::vector<KnownPixel>& landmarks, Random& random);
  /// The motion from the last reference to this one, which is now known from both ends: the mean of
  /// `forward` and of the alignment back, by their covariances; if they contradict each other,
  /// `forward` with so much more covariance, and an outcome (inconsistent) that says so.
  [[nodiscard]] DirectMotion confirm(const DirectMotion& forward) const;
  /// What a single eye learns of how its camera is mounted.
  void learn(const DirectMotion& motion);

  bool has_reference() const { return !reference_.patches().empty(); }
  /// Median depth of the reference's surfaces [m].
  double median_depth_m() const;
  void reset();
  /// For drawing: the newest alignment's pixels.
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
  Eigen::Vector3d mounting_ = Eigen::Vector3d::UnitY();  // mean normal of the ground, for one eye
  double mounting_variance_rad2_;
  Eigen::Vector3d dominant_g_ = Eigen::Vector3d::Zero();  // of the last reference, in its camera
  Frame frame_;
  Image ground_mask_;
  std::vector<Image> pyramid_, reference_pyramid_, last_pyramid_;
  DirectReference reference_, last_reference_;
};

}  // namespace placegraph
