#pragma once
#include <placegraph/backend/window/distortion_evidence.h>
#include <placegraph/backend/window/sliding_window_options.h>
#include <placegraph/backend/window/window_observations.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line3.h>
#include <placegraph/graph/geometry/plane3.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace placegraph {

/// Bundle adjustment over the last keyframes; what leaves is marginalized into a linear prior by
/// Schur complement, with first-estimate Jacobians for the states that stay in it. Undistorted
/// pinhole camera. Residuals: reprojection (px / sigma, Huber), inverse depth, the ends of segments
/// from projected lines, distances, heights above planes, points on planes, planes as they were
/// measured, pose priors, motions, rotations against rectangular worlds, the prior.
/// Deterministic; single-threaded.
class SlidingWindow {
 public:
  SlidingWindow(const SlidingWindowOptions& options, const Camera& camera);
  ~SlidingWindow();
  SlidingWindow(SlidingWindow&&) noexcept;
  SlidingWindow& operator=(SlidingWindow&&) noexcept;

  /// Keyframe ids must be new and ascending; the first one fixes the gauge: it is held until it is
  /// marginalized, then the prior it leaves does so (or, if it leaves none, the next oldest is
  /// held). When neither depth nor a distance says otherwise, the scale is held where it is: by a
  /// soft distance to the farthest keyframe, and by the prior once that has gone into it.
  void add_keyframe(std::int64_t id, const SE3& T_map_cam);
  /// A keyframe that is kept is not marginalized, however old it is: an anchor to which later ones
  /// shall have a relative covariance. Its place in max_keyframes it takes all the same.
  void keep(std::int64_t keyframe, bool kept = true);
  void add_landmark(std::int64_t id, const Eigen::Vector3d& p_map);
  void add_observation(const WindowObservation& observation);
  void add_distance(const DistanceObservation& observation);
  /// A line counts from three images on, of two keyframes or more: fewer say nothing of the poses
  /// (two planes always meet in a line). Its planes through the cameras should have turned by a few
  /// degrees: nearer to the epipolar plane its position is hardly determined, and no covariance
  /// describes that.
  void add_line(std::int64_t id, const Line3& line_map);
  void add_line_observation(const LineObservation& observation);
  void remove_line(std::int64_t id);
  /// What a second eye saw is known better now, as after its calibration. It must be there.
  void revise_second_eye(std::int64_t keyframe, std::int64_t line,
                         const LineObservation::SecondEye& second);
  const std::vector<LineObservation>& line_observations(std::int64_t line) const;
  /// Distances of both ends from the projected line [px].
  std::optional<Eigen::Vector2d> residual_px(const LineObservation& observation) const;
  /// A plane leaves the window with the last keyframe that measured it or whose height above it is
  /// known and the last point on it, unless it is kept: then the prior goes on to hold it to the
  /// keyframes. Heights give the scale where at least three points lie on their plane; a measured
  /// plane is metric.
  void add_plane(std::int64_t id, const Plane3& plane_map);
  void add_height(const HeightObservation& observation);
  void add_plane_point(const PlanePoint& point);
  void add_plane_observation(const PlaneObservation& observation);
  const std::vector<PlaneObservation>& plane_observations() const;  ///< in the order they came
  /// The error of a measurement of a plane in standard deviations, three of them.
  std::optional<Eigen::Vector3d> residual_sigmas(const PlaneObservation& observation) const;
  void remove_plane_observation(std::int64_t keyframe, std::int64_t plane);
  void keep_plane(std::int64_t id, bool kept = true);
  /// Forgets a plane with all that was measured of it in the window; what went into the prior is
  /// integrated over it.
  void remove_plane(std::int64_t id);
  /// A world leaves the window with the last keyframe that saw it, unless it is kept: then the
  /// prior goes on to hold it to the keyframes, as far as their motion is known.
  void add_world(std::int64_t id, const SO3& R_map_world);
  void add_world_observation(const WorldObservation& observation);
  void keep_world(std::int64_t id, bool kept = true);
  /// Where the window lies as a whole is chosen anew after each optimization: turned about its
  /// oldest keyframe so that this world stays at its R_map_world. Nothing: as it comes out.
  void hold_world(std::optional<std::int64_t> id);
  /// Of full rank on the keyframe that is held, it takes the place of holding it.
  void add_pose_prior(const PosePrior& prior);
  /// A motion of full rank measures the scale, and is enough to hold a keyframe without landmarks.
  void add_motion(const MotionObservation& motion);
  /// Forgets a landmark with its observations (an outlier).
  void remove_landmark(std::int64_t id);
  void remove_observation(std::int64_t keyframe, std::int64_t landmark);
  /// The inverse depth [1/m] of an observation that has one, as it is measured by a better
  /// calibration.
  void revise_inverse_depth(std::int64_t keyframe, std::int64_t landmark, double inverse_depth);

  [[nodiscard]] WindowSummary optimize();
  /// Marginalizes the oldest keyframes until at most max_keyframes are left: landmarks and lines
  /// that the newest keyframe no longer sees are marginalized with them, observations of the others
  /// in the leaving keyframe are dropped. Returns the ids of keyframes that left.
  std::vector<std::int64_t> marginalize();
  /// Multiplies all positions, landmarks and the prior's linearization by `scale` (> 0) about the
  /// oldest keyframe: for a mono map whose metric scale becomes known. Throws if something in the
  /// window measures it already: a distance, an inverse depth, a height, pose priors, a motion.
  void rescale(double scale);

  std::vector<std::int64_t> keyframes() const;  ///< ascending
  std::vector<std::int64_t> landmarks() const;  ///< ascending
  SE3 pose(std::int64_t keyframe) const;        ///< T_map_cam
  std::optional<Eigen::Vector3d> landmark(std::int64_t id) const;
  const std::vector<WindowObservation>& observations(std::int64_t landmark) const;
  std::vector<std::int64_t> lines() const;   ///< ascending
  std::vector<std::int64_t> planes() const;  ///< ascending
  std::vector<std::int64_t> worlds() const;  ///< ascending
  std::optional<Line3> line(std::int64_t id) const;
  std::optional<Plane3> plane(std::int64_t id) const;
  std::optional<SO3> world(std::int64_t id) const;  ///< R_map_world
  /// Reprojection error [px] of an observation at the current estimate; nothing behind the camera.
  /// `residual_sigmas`: the same in standard deviations of its noise.
  std::optional<Eigen::Vector2d> residual_px(const WindowObservation& observation) const;
  std::optional<Eigen::Vector2d> residual_sigmas(const WindowObservation& observation) const;

  /// Information (6x6, tangent of T_from_to on the right) of the relative pose between two
  /// keyframes of the window, from the normal equations of everything in the window with all else
  /// marginalized. Semi-definite where a direction is unobservable.
  Matrix6d relative_information(std::int64_t from, std::int64_t to) const;
  /// Its inverse: the covariance of the relative pose. Nothing where a direction is unobservable.
  std::optional<Matrix6d> relative_covariance(std::int64_t from, std::int64_t to) const;
  /// Covariance (tangent of T_map_cam on the right) of a keyframe's pose in the map, whose frame
  /// the first keyframe (or the pose priors) set; zero while the keyframe is held. Nothing where a
  /// direction is unobservable, and nothing once the way back to that frame is lost: where all that
  /// a leaving keyframe saw was still in view, the next one has to be held in its place.
  std::optional<Matrix6d> covariance(std::int64_t keyframe) const;
  /// Covariance (right tangent) of R_cam_world, a world as a keyframe has it before it. Nothing
  /// where a direction is unobservable.
  std::optional<Eigen::Matrix3d> world_covariance(std::int64_t world, std::int64_t keyframe) const;
  /// Covariance of the tangent of a plane as a keyframe has it before it, in its camera's frame.
  /// Nothing where a direction is unobservable.
  std::optional<Eigen::Matrix3d> plane_covariance(std::int64_t plane, std::int64_t keyframe) const;
  /// What the points of the window, at its estimate and without its prior, say of the lens.
  LensEvidence lens_evidence() const;
  /// Standard deviation of log(|t_middle_last| / |t_first_middle|) between three keyframes of the
  /// window: how well it holds its unit of length where nothing measures that. The gauge plays no
  /// part in it. Infinite if two of the three stand in one point.
  double sigma_log_length_ratio(std::int64_t first, std::int64_t middle, std::int64_t last) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
