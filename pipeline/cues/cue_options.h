#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Metric scale of a monocular camera of known height from the ground plane ahead of it.
struct GroundPlaneScaleOptions {
  GroundPlaneOptions plane;  ///< direct alignment of the ground in two keyframes
  bool enabled = true;       ///< use the ground plane where the camera height is known
  /// Relative standard deviation of a single scale, added to that of the alignment: the road is
  /// uneven, and overlapping pairs of keyframes observe the same part of it, so that their errors
  /// are correlated.
  double sigma_relative = 0.02;
  /// Maximum distance of a scale from the median of the last five (in logarithm); scales with a
  /// larger distance are not used.
  double max_log_jump = 0.12;
  double mounting_sigma_deg = 3;  ///< initial standard deviation of the camera's pitch and roll
  /// Standard deviation of pitch and roll in one frame about their mean (vehicle pitching).
  double pitching_sigma_deg = 0.5;
  /// Minimum translation between the two keyframes, in camera heights; a shorter one carries little
  /// information.
  double min_baseline_heights = 0.6;
  void check() const;
};
void visit(OptionVisitor& field, GroundPlaneScaleOptions& options);

/// Metric scale of a monocular camera of known height from lines on the floor.
struct FloorLineScaleOptions {
  FloorFromLinesOptions floor;  ///< selection of the lines on the floor
  /// Relative standard deviation of one height: uneven floor, camera bobbing.
  double sigma_relative = 0.01;
  /// Maximum relative standard deviation of the height that provides the first scale.
  double max_sigma_at_first = 0.04;
  void check() const;
};
void visit(OptionVisitor& field, FloorLineScaleOptions& options);

/// Line landmarks: edges that are tracked, triangulated and kept in the sliding window.
struct LineCueOptions {
  LineTrackerOptions tracker;              ///< edges followed from frame to frame
  LineStereoOptions stereo;                ///< matching of edges in the right image
  LineTriangulationOptions triangulation;  ///< conditions for the triangulation of a line
  PoseFromLinesOptions pose;               ///< pose of a frame from known lines
  LineInitializerOptions initializer;      ///< first keyframes of a monocular camera without points
  FloorLineScaleOptions floor;             ///< metric scale where points are not among the cues
  /// Number of observations in the window that count as one independent observation, because the
  /// error of an edge persists while it is tracked (their variances are multiplied by this number).
  double similar_observations = 16;
  double outlier_px = 4;  ///< residual [px] at a carrier above which a line landmark is removed
  void check() const;
};
void visit(OptionVisitor& field, LineCueOptions& options);

/// Point landmarks: corners that are tracked, triangulated and kept in the sliding window.
struct PointCueOptions {
  PointTrackerOptions tracker;  ///< points followed from frame to frame
  Pose3d2dOptions pose;         ///< pose of a frame from landmarks
  double outlier_px = 4;        ///< reprojection error [px] above which a landmark is removed
  /// Masks from semantic labels are ignored if they would leave fewer tracks than this.
  int min_unmasked_tracks = 150;
  /// Minimum angle between the rays of two keyframes to triangulate a landmark.
  double min_parallax_deg = 0.5;
};

/// Options for the Manhattan frames in the sliding window.
///
/// A Manhattan frame consists of three orthogonal directions that many edges of the scene share.
struct ManhattanFrameOptions {
  /// Number of neighbouring keyframes that count as one, because they observe the same lines and
  /// their errors are correlated. In front of a blank wall the rotation from points is less
  /// accurate than its covariance states, so a large number does harm.
  double correlation = 1;
  int persistence = 3;  ///< keyframes of the window that must observe a new Manhattan frame
  /// Maximum number of stored frames; the one unobserved for longest is removed.
  int max_count = 4;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, ManhattanFrameOptions& options);

/// Rotation from the directions of Manhattan frames.
struct ManhattanCueOptions {
  /// Detection of straight edges.
  SegmentDetectorOptions segments{.min_length_px = 20};
  SceneDirectionOptions directions;  ///< detection of vanishing points and Manhattan frames
  ManhattanFrameOptions frames;      ///< tracking of Manhattan frames in the sliding window
  int max_width_px = 800;    ///< image width above which images are halved before edge detection
  double max_sigma_deg = 1;  ///< maximum standard deviation of a used frame about any axis
  /// Number of inliers below which a frame between keyframes also takes its rotation from Manhattan
  /// frames.
  int few_points = 1000;
  void check() const;
};
void visit(OptionVisitor& field, ManhattanCueOptions& options);

/// Planes in the depth images of keyframes as landmarks of the sliding window.
struct PlaneLandmarkOptions {
  bool enabled = false;      ///< off: depth images provide no plane landmarks
  DepthPlanesOptions depth;  ///< detection of planes in a depth image
  /// Number of neighbouring keyframes that count as one, because they observe the same depths and
  /// their errors are correlated.
  double correlation = 4;
  /// Standard deviation of a plane's normal and distance [m] observed from a new keyframe, in
  /// addition to the covariance of the window: the motion drifts by more than the noise of its
  /// points explains.
  double drift_deg = 0.2, drift_m = 0.01;
  /// Minimum overlap of an observed plane and a landmark, as a share of the smaller one.
  double min_overlap = 0.2;
  int patience = 20;  ///< number of keyframes for which an unobserved landmark is kept
  /// Maximum number of landmarks; the one unobserved for longest is removed.
  int max_landmarks = 12;
  void check() const;
};
void visit(OptionVisitor& field, PlaneLandmarkOptions& options);

/// Options of the cue that estimates motion by direct alignment of planes.
struct DirectCueOptions {
  DominantSurfaceOptions surface;  ///< the ground under a vehicle or robot
  /// Fit of further planes to inverse depths.
  InverseDepthPlaneOptions planes{.ransac = {.max_iterations = 100, .min_inliers = 30}};
  DirectMotionOptions align;  ///< options of the direct alignment
  int depths = 800;           ///< number of depths measured over the whole image to find planes
  int max_planes = 5;  ///< maximum number of planes aligned at once, in addition to the ground
  double min_plane_share = 0.06;  ///< minimum share of the depths that support a plane
  /// A keyframe is created when the share of samples in view, or of inliers among them, falls below
  /// this value.
  double keyframe_share = 0.6;
  void check() const;
};
void visit(OptionVisitor& field, DirectCueOptions& options);

}  // namespace placegraph
