#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/frontend/features/rectification.h>
#include <placegraph/frontend/features/stereo_matcher.h>
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/frontend/relative_pose/mono_initializer.h>
#include <placegraph/frontend/relative_pose/pose_3d2d.h>
#include <placegraph/frontend/relative_pose/rotation_2d2d.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/landmark.h>
#include <placegraph/graph/measurements/frame.h>
#include <placegraph/graph/measurements/measured_motion.h>
#include <placegraph/pipeline/cues/direct_cue.h>
#include <placegraph/pipeline/cues/frame_view.h>
#include <placegraph/pipeline/cues/line_cue.h>
#include <placegraph/pipeline/cues/manhattan_cue.h>
#include <placegraph/pipeline/cues/plane_cue.h>
#include <placegraph/pipeline/cues/surface_labels.h>
#include <placegraph/pipeline/odometry/cue_list.h>
#include <placegraph/pipeline/odometry/lens_estimator.h>
#include <placegraph/pipeline/scale/floor_line_scale.h>
#include <placegraph/pipeline/scale/ground_plane_scale.h>

#include <map>
#include <memory>
#include <set>

namespace placegraph {

/// When a frame becomes a keyframe.
struct KeyframeOptions {
  double max_flow_share = 0.06;  ///< median track displacement since the last one / image width
  /// Whether the camera's turn is taken out of the displacements: what is left is parallax.
  bool derotated = false;
  double min_tracked_share = 0.7;  ///< of the last keyframe's landmarks still followed
  int max_interval = 20;           ///< frames, if the camera moves at all
  void check() const;
};
void visit(OptionVisitor& field, KeyframeOptions& options);

struct OdometryOptions {
  std::string cues = "points,plane";  ///< see parse_cues
  PointTrackerOptions tracker;
  Pose3d2dOptions pose;
  MonoInitializerOptions initializer;
  Rotation2d2dOptions turn;
  StereoMatcherOptions stereo;
  RectificationOptions rectification;
  GroundScaleOptions ground;
  LineCueOptions lines;
  ManhattanCueOptions manhattan;
  PlaneLandmarkOptions planes;
  SurfaceCueOptions surfaces;
  KeyframeOptions keyframe;
  SlidingWindowOptions window{.max_keyframes = 10, .relative_decrease = 1e-3};
  double outlier_px = 4;  ///< a landmark that misses its pixel by more is dropped
  /// So is one that misses all its pixels by more than both, root mean square, with its track.
  double misfit_px = 0.4, misfit_sigmas = 1.5;
  /// Points without which masks from labels are not heeded.
  int min_unmasked_tracks = 150;
  double min_parallax_deg = 0.5;  ///< to triangulate a landmark from keyframes
  /// SlidingWindowOptions::scale_drift of a single eye whose unit the ground or another sensor
  /// measures.
  double scale_drift = 0.003;
  void check() const;
};
void visit(OptionVisitor& field, OdometryOptions& options);

enum class TrackingState { kWaiting, kTracking, kLost };

/// What one frame brought.
struct OdometryUpdate {
  TrackingState state = TrackingState::kWaiting;
  SE3 T_odom_cam;              ///< if tracking, or the first of the two views
  std::int64_t keyframe = -1;  ///< reference keyframe, if tracking
  int inliers = 0;
  std::string reason;      ///< why it is not tracking, or begins anew
  bool reference = false;  ///< while waiting: this frame is the first of the two views

  struct NewKeyframe {
    std::int64_t id;
    Frame frame;
    std::shared_ptr<const SceneSight> sight = nullptr;  ///< its surfaces, where they are looked at
  };
  std::vector<NewKeyframe> new_keyframes;
  /// Frames that are posed afterwards, frame id and T_odom_cam: those before the initialization,
  /// and those since the last keyframe, against landmarks that a new keyframe has made better
  /// known.
  std::vector<std::pair<std::int64_t, SE3>> filled;
  /// The scale became known: every earlier position p of this run of tracking is now
  /// centre + factor (p - centre).
  struct Rescale {
    double factor = 1;
    Eigen::Vector3d centre_odom = Eigen::Vector3d::Zero();
  };
  std::optional<Rescale> rescale;
  /// A single eye has made no way, only turned, since the last keyframe (where it is lost) or since
  /// the first view (while it waits for the second; where this frame took that one's place, since
  /// the one before it).
  struct Turn {
    SO3 R_before_cam;
    Eigen::Matrix3d covariance;  ///< of its right tangent [rad^2]
  };
  std::optional<Turn> turn;
};

/// Motion memory: follows points, lines or both, poses every frame against the landmarks of a
/// sliding window, and refines the window at keyframes. Stereo and RGB-D start with the first
/// frame; mono waits for two views with parallax, and takes its scale from the ground where the
/// camera height is known.
class Odometry {
 public:
  /// `times`, which must outlive it, learns what its stages take.
  Odometry(const OdometryOptions& options, const Calibration& calibration, std::uint64_t seed,
           LogSink log, StageTimes& times);

  /// `T_odom_cam_known`, where the frame has been recognized in the map, gives a single eye that
  /// begins anew its unit and place.
  [[nodiscard]] OdometryUpdate add_frame(const Frame& frame,
                                         const std::optional<SE3>& T_odom_cam_known = {});
  /// Forgets window and tracks and begins anew with the next frame, which stands at T_odom_cam. If
  /// `in_known_map`, a single eye without ground takes its unit from frames that are recognized;
  /// otherwise, if what it sees is about as far away as before, from `median_depth_m`. Keyframe ids
  /// go on counting.
  void restart(const SE3& T_odom_cam, bool in_known_map = false,
               const std::optional<double>& median_depth_m = {});

  /// Takes up the run of another: its next keyframe's id, and how far away things were. To be
  /// followed by restart().
  void go_on_from(std::int64_t next_keyframe, double median_depth_m) {
    next_keyframe_ = next_keyframe;
    median_depth_m_ = median_depth_m;
  }
  /// How many of `landmarks()` have left the window: those stand first and stay as they are, but
  /// for a change of the unit.
  std::size_t settled_landmarks() const { return past_landmarks_.size(); }

  /// The camera's motion by other sensors, before the first frame: gives a single eye its unit.
  void set_motion(std::shared_ptr<const MeasuredMotion> motion_cam);
  /// Labels the surfaces of keyframes from now on, before the first frame. `masks`: they say where
  /// points, lines and ground are looked for.
  void set_scene(std::shared_ptr<const SceneEye> eye, bool masks);
  /// What holds in the surroundings the camera is in; nothing: all that the options ask for.
  void assume(const std::optional<Assumptions>& assumptions);
  /// The landmarks that are followed, in the newest frame's camera.
  std::vector<Eigen::Vector3d> points_cam() const;
  /// Whether a first frame has been taken since the last restart.
  bool started() const { return started_; }
  /// Tracking goes on in a unit of its own that lines on the floor are to give: where a frame is,
  /// is not known yet in metres.
  bool awaits_unit() const {
    return floor_ && !scale_known_ && !in_known_map_ && state_ == TrackingState::kTracking;
  }
  bool scale_known() const { return scale_known_; }
  /// Nothing has given this run its unit: what it sees is thought to be as far away as what was
  /// seen before.
  bool guesses_unit() const { return guesses_unit_; }
  /// Newest estimate of a keyframe of the present run of tracking, T_odom_cam.
  SE3 keyframe_pose(std::int64_t id) const { return keyframe_poses_.at(id); }
  /// First keyframe of the present run of tracking.
  std::int64_t first_keyframe() const { return first_keyframe_; }
  /// What is known of the motion between keyframes `id` and `id` + 1. Where the unit of length is
  /// not measured, the motion's length counts as known in the unit of `id`, and `sigma_log_scale`
  /// is how far the unit may have changed by `id` + 1.
  struct Link {
    Matrix6d information = Matrix6d::Zero();  ///< right tangent of T_id_next
    double sigma_log_scale = 0;
  };
  Link link(std::int64_t id) const;
  /// The same information of the motion between any two keyframes of the window, everything between
  /// them marginalized.
  Matrix6d motion_information(std::int64_t from, std::int64_t to) const;
  /// The oldest keyframe of the window; -1 while there is none.
  std::int64_t window_begin() const;
  /// All landmarks of all runs of tracking, each relative to the keyframe that first saw it; from
  /// the `first`-th on.
  std::vector<PointLandmark> landmarks(std::size_t first = 0) const;
  double median_depth_m() const { return median_depth_m_; }
  /// Edges of the newest image, with their lines in its camera where they are known; not described.
  std::vector<LineFeature> line_features() const {
    return lines_ ? lines_->features(window_, T_odom_last_) : std::vector<LineFeature>();
  }
  /// Of all runs of tracking; nothing is asked of two eyes.
  const LensEstimator& lens() const { return lens_; }
  /// Tracks and ground of the last frame; nothing where it is lost.
  FrameView view() const;

 private:
  struct View {  // a frame while mono waits for its second view
    std::int64_t frame;
    std::map<std::int64_t, Eigen::Vector2d> px;
  };
  struct LinesWaiting {  // the same of lines without points
    Frame frame;
    LineView lines;
  };
  struct FrameBetween {  // tracked since the last keyframe
    std::int64_t frame;
    SE3 T_keyframe_cam;
    std::vector<std::pair<std::int64_t, Eigen::Vector2d>> px;  // of landmarks
    std::optional<ManhattanCue::Heading> heading;              // of one that few points pose
  };
  struct Sighting2d {
    std::int64_t keyframe;
    Eigen::Vector2d px;
    Eigen::Matrix2d covariance;  // of px
  };
  struct DepthMeasurement {
    double inverse_depth, sigma;
  };

  SlidingWindow empty_window() const;
  bool metric_from_start() const;
  std::string too_few_landmarks() const;
  OdometryUpdate begin(const Frame& frame);
  std::optional<OdometryUpdate::Turn> turn_since(
      const std::map<std::int64_t, Eigen::Vector2d>& px_before, Random& random) const;
  OdometryUpdate wait_turning(const Frame& frame, Random& random);
  OdometryUpdate replace_reference(const Frame& frame, const std::optional<SE3>& T_known,
                                   const std::optional<OdometryUpdate::Turn>& turn = {});
  OdometryUpdate try_initialize(const Frame& frame, const std::optional<SE3>& T_known);
  OdometryUpdate begin_with_lines(const Frame& frame);
  OdometryUpdate try_lines(const Frame& frame, const std::optional<SE3>& T_known);
  bool place_line_views(const std::vector<std::size_t>& chosen, const LineInitialization& start,
                        double scale, double depth);
  OdometryUpdate track(const Frame& frame);
  Pose3d2dResult follow_points(const Frame& frame, const SE3& prior, Random& random,
                               std::vector<bool>& keep);
  Pose3d2dResult pose_from_points(const SE3& prior, Random& random, std::vector<bool>& keep) const;
  PoseFromLines pose_with_lines(const Frame& frame, const SE3& prior, const Pose3d2dResult& points,
                                Random& random);
  int landmarks_in_window() const;
  OdometryUpdate begin_on_surfaces(const Frame& frame);
  OdometryUpdate track_surfaces(const Frame& frame);
  DirectMotion align_surfaces() const;
  MotionGuess expected_motion() const;
  bool surface_keyframe_due(const DirectMotion& motion) const;
  bool add_surface_keyframe(const Frame& frame, const DirectMotion& motion, OdometryUpdate& update);
  void align_keyframes(const Frame& frame, std::int64_t previous);
  std::vector<KnownPixel> landmarks_seen(const SE3& T_odom_cam) const;
  void fill_between(std::int64_t ref, std::int64_t cur, Random& random,
                    OdometryUpdate& update) const;
  std::vector<Eigen::Vector2f> predict(const SE3& T_odom_cam) const;
  bool keyframe_due(const Frame& frame, int inliers) const;
  void remember(std::int64_t frame, const std::optional<ManhattanCue::Heading>& heading);
  void anchor_tracks();
  void pose_between(std::int64_t keyframe, OdometryUpdate& update);
  void add_keyframe(const Frame& frame, const SE3& T_odom_cam, OdometryUpdate& update);
  Frame looked_at(const Frame& frame);
  void detect_points(const Frame& frame, const Image& given_mask);
  void leave_moving_things();
  bool sees_worlds() const;
  Image labelled_ground(const Frame& frame) const;
  GroundSight ground_sight(const Frame& frame) const;
  void observe_tracks(std::int64_t keyframe, const Frame& frame);
  void observe_lines(std::int64_t keyframe, const Frame& frame);
  void measure_scale(const Frame& frame, OdometryUpdate& update);
  void measure_ground(const Frame& frame, OdometryUpdate& update);
  void measure_floor(OdometryUpdate& update);
  void measure_way(OdometryUpdate& update);
  std::optional<DistanceObservation> measured_way(std::int64_t from, std::int64_t to) const;
  void set_scale(double factor, OdometryUpdate& update);
  void refine_window();
  void look_at_directions(const Frame& frame);
  std::optional<ManhattanCue::Heading> heading_of(const Frame& frame, const SE3& T_odom_cam,
                                                  int points) const;
  SE3 turned(const SE3& T_odom_cam, const Matrix6d& information,
             const std::optional<ManhattanCue::Heading>& heading) const;
  void look_at_planes(const Frame& frame);
  void widen_last_link(const SE3& T_odom_oldest);
  double unit_drift() const;
  PointLandmark describe_landmark(std::int64_t id) const;
  std::vector<std::optional<DepthMeasurement>> measure_depth(const Frame& frame,
                                                             const SE3& T_odom_cam) const;
  std::vector<std::optional<double>> expected_disparities(const SE3& T_odom_cam,
                                                          const RectificationError& error) const;
  void calibrate_eyes();
  std::optional<DisparitySample> disparity_sample(std::int64_t landmark) const;
  void revise_disparities(const RectificationError& before);
  void add_observation(const Sighting2d& sighting, std::int64_t landmark,
                       const std::optional<DepthMeasurement>& depth);
  std::optional<Eigen::Vector3d> place_point(const Sighting2d& now,
                                             const std::vector<Sighting2d>& before,
                                             const std::optional<DepthMeasurement>& depth) const;
  bool contradicts_itself(std::int64_t landmark) const;
  std::vector<double> keep_fitting_landmarks();

  OdometryOptions options_;
  Calibration calibration_;
  std::uint64_t seed_;
  LogSink log_;
  StageTimes& times_;
  PointTracker tracker_;
  SlidingWindow window_;
  Cues cues_;
  std::optional<LineCue> lines_;
  std::optional<ManhattanCue> manhattan_;
  std::optional<PlaneLandmarks> planes_;
  std::optional<GroundScale> ground_;
  std::optional<SurfaceCue> surfaces_;
  DirectMotion newest_motion_;                           // of surfaces, from the last keyframe
  Frame last_frame_;                                     // where surfaces alone are followed
  std::optional<FloorScale> floor_;                      // of lines without points or ground
  std::optional<RectificationEstimator> rectification_;  // of two eyes
  std::set<std::int64_t> calibrated_;                    // landmarks of the window it has heard of
  LensEstimator lens_;
  std::int64_t newest_of_lens_ = -1;              // keyframe it has heard of
  std::shared_ptr<const MeasuredMotion> motion_;  // of the camera, where nothing else is metric
  std::map<std::int64_t, std::int64_t> stamps_;   // of this run's keyframes, for that
  std::shared_ptr<const SceneEye> eye_;           // labels keyframes
  bool masks_ = false;                            // and they are heeded
  std::shared_ptr<const SceneSight> sight_;       // of the frame last labelled
  std::optional<Assumptions> assumed_;
  TrackingState state_ = TrackingState::kWaiting;
  bool started_ = false;  // the first frame of this run has been seen
  bool lost_ = false;     // the last frame
  bool scale_known_ = false;
  bool in_known_map_ = false, guesses_unit_ = false;

  SE3 T_odom_restart_, T_odom_start_, T_odom_last_,
      T_last_cur_;  // the last one: velocity over one frame
  bool velocity_known_ = false;
  double prediction_error_px_ = 0;  // of the last frame's tracks, median
  std::int64_t next_keyframe_ = 0, first_keyframe_ = 0, last_keyframe_ = -1;
  int landmarks_at_keyframe_ = 0, frames_since_keyframe_ = 0;
  std::map<std::int64_t, Frame> keyframe_frames_;  // of the window, where the ground is looked at
  std::map<std::int64_t, Eigen::Vector2d> px_at_keyframe_;
  std::map<std::int64_t, std::vector<Sighting2d>> sightings_;  // of live tracks, in the window
  std::map<std::int64_t, SE3> keyframe_poses_;
  std::map<std::int64_t, Link> links_;         // of keyframes that left the window
  std::vector<PointLandmark> past_landmarks_;  // that left the window
  std::vector<View> views_;
  std::vector<std::pair<std::int64_t, SE3>> turned_;  // frames that wait, T_odom_cam by turns alone
  std::vector<LinesWaiting> line_views_;
  std::vector<FrameBetween> between_;
  Frame reference_frame_;
  std::shared_ptr<const SceneSight> reference_sight_;
  static constexpr double kUnknownDepth = 10;  // of a map whose unit is arbitrary
  double median_depth_m_ = kUnknownDepth;
};

}  // namespace placegraph
