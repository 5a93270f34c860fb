#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/frontend/planes/plane_options.h>
#include <placegraph/frontend/relative_pose/relative_pose_options.h>
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

struct GroundScaleOptions {
  GroundPlaneOptions plane;
  bool enabled = true;  ///< use the ground plane where the camera height is known
  /// Of a single scale, added to its noise: the road is uneven, and pairs of views that overlap see
  /// the same of it, so that they err together.
  double sigma_relative = 0.02;
  double max_log_jump = 0.12;         ///< from the median of the last scales; more is not believed
  double mounting_sigma_deg = 3;      ///< pitch and roll of the camera before anything was seen
  double pitching_sigma_deg = 0.5;    ///< of a single view about the mean: the vehicle nods
  double mounting_drift_deg = 0.03;   ///< of the mean, from one measurement to the next
  double level_sigma_deg = 0.03;      ///< of a floor that edges show to be level, beside theirs
  double min_baseline_heights = 0.6;  ///< motion between the two views; a shorter one tells little
  void check() const;
};
void visit(OptionVisitor& field, GroundScaleOptions& options);

struct FloorScaleOptions {
  FloorFromLinesOptions floor;
  double sigma_relative = 0.01;      ///< of a single height: the floor is not flat, the camera bobs
  double max_log_jump = 0.12;        ///< from the median of the last scales; more is not believed
  double max_sigma_at_first = 0.04;  ///< of the height that gives the unit, relative
  void check() const;
};
void visit(OptionVisitor& field, FloorScaleOptions& options);

struct LineCueOptions {
  LineTrackerOptions tracker;
  LineStereoOptions stereo;
  LineTriangulationOptions triangulation;
  PoseFromLinesOptions pose;
  LineInitializerOptions start;
  FloorScaleOptions floor;
  double sigma_floor_px = 0.15;  ///< no line is placed better across: lens, rolling shutter, blur
  /// What one look at an edge errs by stays while it is followed: so many sightings in the window
  /// are worth one independent one.
  double alike_sightings = 16;
  /// In place of triangulation.min_turn_deg where directions show the rotation, and turns of planes
  /// are those of the way alone: with what is not known of its place, a line is of use much sooner.
  double min_turn_steered_deg = 0.4;
  int stay_frames = 10;   ///< an edge that the motion takes out of the image before is begun last
  double outlier_px = 4;  ///< a line of the window that is missed by more is dropped
  void check() const;
};
void visit(OptionVisitor& field, LineCueOptions& options);

struct PointCueOptions {
  PointTrackerOptions tracker;
  Pose3d2dOptions pose;
  double outlier_px = 4;  ///< a landmark that misses its pixel by more is dropped
  /// So is one that misses all its pixels by more than both, root mean square, with its track.
  double misfit_px = 0.4, misfit_sigmas = 1.5;
  /// Fewer tracks than this, and masks made from semantic labels are ignored.
  int min_unmasked_tracks = 150;
  double min_parallax_deg = 0.5;  ///< to triangulate a landmark from keyframes
};

struct ManhattanWorldOptions {
  /// Of the directions of one view beyond what its lines' noise explains: the scene is not quite
  /// rectangular, lines are taken for what they are not, the lens.
  double sigma_floor_deg = 0.1;
  /// Neighbouring views see the same lines and err alike: so many of them count as one. What points
  /// before a blank wall say of a turn is worse than they know, so this is not to be overdone.
  double correlation = 1;
  /// Of a world seen from a new keyframe, beyond what the window claims to know: its rotations
  /// drift by more than the noise of its points explains, in turns above all. Worlds that differ by
  /// less than about three of these are one.
  double sigma_drift_deg = 1;
  int persistence = 3;  ///< keyframes of the window that must show a new world
  int max_worlds = 4;   ///< remembered; the one unseen for longest is forgotten
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, ManhattanWorldOptions& options);

struct ManhattanCueOptions {
  SegmentDetectorOptions segments{.min_length_px = 20, .merging = {}, .refinement = {}};
  SceneDirectionOptions directions;
  ManhattanWorldOptions worlds;
  int max_width_px = 800;    ///< wider images are halved before segments are looked for
  double max_sigma_deg = 1;  ///< about any axis: directions known less well are not believed
  /// A frame between keyframes that is posed by fewer points is turned by the worlds, too.
  int few_points = 1000;
  void check() const;
};
void visit(OptionVisitor& field, ManhattanCueOptions& options);

struct PlaneLandmarkOptions {
  bool enabled = false;
  DepthPlanesOptions depth;
  /// Neighbouring views see the same depths and err alike: so many of them count as one.
  double correlation = 4;
  /// Of a plane seen from a new keyframe, beyond what the window claims to know: its motion drifts
  /// by more than the noise of its points explains.
  double drift_deg = 0.2, drift_m = 0.01;
  double min_overlap = 0.2;  ///< of the smaller of a plane seen and a landmark
  int patience = 20;         ///< keyframes that a landmark is remembered unseen
  int max_landmarks = 12;    ///< the one unseen for longest is forgotten
  void check() const;
};
void visit(OptionVisitor& field, PlaneLandmarkOptions& options);

struct SurfaceCueOptions {
  DominantSurfaceOptions surface;  ///< the ground under a vehicle or robot
  InverseDepthPlaneOptions planes{.ransac = {.max_iterations = 100, .min_inliers = 30}};
  DirectMotionOptions align;
  int depths = 800;  ///< asked for over the whole image, where planes are sought
  int max_planes = 5;
  double min_plane_share = 0.06;     ///< of the depths, for a plane
  double evenness_distance = 0.005;  ///< no surface is known better: as a share of its distance
  double evenness_deg = 0.1;         ///< and its normal
  double nodding_deg = 0.4;          ///< of a vehicle about its mean pitch and roll, for one eye
  double sigma_height = 0.01;        ///< of the height of one eye, as a share of it
  double keyframe_share = 0.6;       ///< of the surfaces in view below which a keyframe is due
  double max_disagreement = 5;       ///< of forward and backward motion [standard deviations]
  void check() const;
};
void visit(OptionVisitor& field, SurfaceCueOptions& options);

}  // namespace placegraph
