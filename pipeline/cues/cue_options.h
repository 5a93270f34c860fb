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
  /// uneven, and pairs of keyframes that overlap see the same of it, so that they err together.
  double sigma_relative = 0.02;
  /// Largest distance of a scale from the median of the last five (in logarithm); scales farther
  /// off are not used.
  double max_log_jump = 0.12;
  double mounting_sigma_deg = 3;     ///< standard deviation of the camera's pitch and roll at first
  double pitching_sigma_deg = 0.5;   ///< of a single frame about their mean: the vehicle pitches
  double mounting_drift_deg = 0.03;  ///< random walk of the mean from one measurement to the next
  /// Standard deviation of the normal of a floor that edges show to be level, beside that of the
  /// edges.
  double level_sigma_deg = 0.03;
  /// Shortest translation between the two keyframes, in camera heights; a shorter one tells little.
  double min_baseline_heights = 0.6;
  void check() const;
};
void visit(OptionVisitor& field, GroundPlaneScaleOptions& options);

/// Metric scale of a monocular camera of known height from lines on the floor.
struct FloorLineScaleOptions {
  FloorFromLinesOptions floor;   ///< which lines lie on the floor
  double sigma_relative = 0.01;  ///< of a single height: the floor is uneven, the camera bobs
  /// Largest distance of a scale from the median of the last five (in logarithm); scales farther
  /// off are not used.
  double max_log_jump = 0.12;
  /// Largest relative standard deviation of the height from which the scale is taken first.
  double max_sigma_at_first = 0.04;
  void check() const;
};
void visit(OptionVisitor& field, FloorLineScaleOptions& options);

/// Line landmarks: edges that are tracked, triangulated and kept in the sliding window.
struct LineCueOptions {
  LineTrackerOptions tracker;              ///< edges followed from frame to frame
  LineStereoOptions stereo;                ///< edges found again in the right image
  LineTriangulationOptions triangulation;  ///< when the line in space is known well enough
  PoseFromLinesOptions pose;               ///< the pose of a frame from known lines
  LineInitializerOptions start;  ///< the first keyframes of a monocular camera without points
  FloorLineScaleOptions floor;   ///< metric scale where points are not among the cues
  double sigma_floor_px = 0.15;  ///< least deviation across a line: lens, rolling shutter, blur
  /// The error of an edge persists while it is tracked: so many observations in the window count as
  /// one independent one (their variances are multiplied by this number).
  double similar_observations = 16;
  /// Replaces triangulation.min_rotation_deg where vanishing directions give the rotation and fewer
  /// than 15 lines are known: a line is then of use much sooner.
  double min_rotation_steered_deg = 0.4;
  /// Frames to look ahead: an edge that leaves the image sooner at the present motion is tracked
  /// only if there are few others.
  int stay_frames = 10;
  double outlier_px = 4;  ///< a line landmark with a larger residual at a carrier is removed
  void check() const;
};
void visit(OptionVisitor& field, LineCueOptions& options);

/// Point landmarks: corners that are tracked, triangulated and kept in the sliding window.
struct PointCueOptions {
  PointTrackerOptions tracker;  ///< points followed from frame to frame
  Pose3d2dOptions pose;         ///< the pose of a frame from landmarks
  double outlier_px = 4;        ///< a landmark with a larger reprojection error [px] is removed
  /// A landmark whose reprojection errors over at least three keyframes exceed both limits (root
  /// mean square per coordinate, in pixels and in standard deviations) is removed with its track.
  double misfit_px = 0.4, misfit_sigmas = 1.5;
  /// Masks made from semantic labels are ignored where they would leave fewer tracks than this.
  int min_unmasked_tracks = 150;
  /// Least angle between the rays of two keyframes to triangulate a landmark.
  double min_parallax_deg = 0.5;
};

/// How Manhattan frames are kept in the sliding window.
///
/// A Manhattan frame is three orthogonal directions that many edges of the scene share.
struct ManhattanFrameOptions {
  /// Standard deviation of the directions in one keyframe beyond the noise of its lines: the scene
  /// is not quite rectangular, lines are assigned to wrong axes, the lens is distorted.
  double sigma_floor_deg = 0.1;
  /// Neighbouring keyframes see the same lines and err alike: so many of them count as one. As
  /// points before a blank wall tell a rotation worse than their covariance says, a large number
  /// does harm.
  double correlation = 1;
  /// Standard deviation of a Manhattan frame seen from a new keyframe, beyond the covariance of the
  /// window: rotations drift by more than the noise of the points explains. Frames that differ by
  /// less than about three of these are one.
  double sigma_drift_deg = 1;
  int persistence = 3;  ///< keyframes of the window that must show a new Manhattan frame
  int max_frames = 4;   ///< most frames remembered; the one unseen for longest is forgotten
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, ManhattanFrameOptions& options);

/// Rotation from the directions of Manhattan frames.
struct ManhattanCueOptions {
  /// How straight edges are found.
  SegmentDetectorOptions segments{.min_length_px = 20, .merging = {}, .refinement = {}};
  SceneDirectionOptions directions;  ///< how vanishing points and Manhattan frames are found
  ManhattanFrameOptions worlds;      ///< how Manhattan frames are kept in the window
  int max_width_px = 800;            ///< wider images are halved before edges are looked for
  double max_sigma_deg = 1;  ///< largest standard deviation about any axis of a frame that is used
  /// A frame between keyframes also takes its rotation from Manhattan frames if its pose has fewer
  /// inliers than this.
  int few_points = 1000;
  void check() const;
};
void visit(OptionVisitor& field, ManhattanCueOptions& options);

/// Planes in the depth images of keyframes as landmarks of the sliding window.
struct PlaneLandmarkOptions {
  bool enabled = false;      ///< off: depth images give no plane landmarks
  DepthPlanesOptions depth;  ///< how planes are found in a depth image
  /// Neighbouring keyframes see the same depths and err alike: so many of them count as one.
  double correlation = 4;
  /// Standard deviation of a plane's normal and distance [m] seen from a new keyframe, beyond the
  /// covariance of the window: the motion drifts by more than the noise of its points explains.
  double drift_deg = 0.2, drift_m = 0.01;
  /// Least share of the smaller of an observed plane and a landmark that lies where the other is.
  double min_overlap = 0.2;
  int patience = 20;       ///< keyframes for which an unseen landmark is remembered
  int max_landmarks = 12;  ///< most landmarks; the one unseen for longest is forgotten
  void check() const;
};
void visit(OptionVisitor& field, PlaneLandmarkOptions& options);

/// Motion by direct alignment of the grey values of planes.
struct DirectCueOptions {
  DominantSurfaceOptions surface;  ///< the ground under a vehicle or robot
  /// How further planes are fitted to inverse depths.
  InverseDepthPlaneOptions planes{.ransac = {.max_iterations = 100, .min_inliers = 30}};
  DirectMotionOptions align;      ///< the alignment itself
  int depths = 800;               ///< depths measured over the whole image to find planes in
  int max_planes = 5;             ///< most planes aligned at once, beside the ground
  double min_plane_share = 0.06;  ///< least share of the depths that lie on a plane
  /// Least relative standard deviation of a plane's distance: surfaces are uneven.
  double evenness_distance = 0.005;
  double evenness_deg = 0.1;   ///< least standard deviation of a plane's normal
  double nodding_deg = 0.4;    ///< of a vehicle's pitch and roll about their mean; monocular
  double sigma_height = 0.01;  ///< relative standard deviation of the camera height; monocular
  /// A keyframe is due below this share of the samples in view, or of inliers among them.
  double keyframe_share = 0.6;
  /// Largest difference of forward and backward motion, in standard deviations.
  double max_disagreement = 5;
  void check() const;
};
void visit(OptionVisitor& field, DirectCueOptions& options);

}  // namespace placegraph
