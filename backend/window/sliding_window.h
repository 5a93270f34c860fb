#pragma once
#include <placegraph/backend/window/sliding_window_options.h>
#include <placegraph/backend/window/window_information.h>
#include <placegraph/backend/window/window_measurements.h>
#include <placegraph/backend/window/window_observations.h>
#include <placegraph/backend/window/window_summary.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line3.h>
#include <placegraph/graph/geometry/plane3.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace placegraph {

struct WindowState;

/// Bundle adjustment over the last keyframes.
/// Variables that leave are marginalized into a linear prior by Schur complement, with
/// first-estimate Jacobians for the variables that stay in it. Undistorted pinhole camera.
/// Residuals: reprojection (px / sigma, Huber), inverse depth, distances of the ends of segments
/// from projected lines, points on planes, the added factors (window_measurements.h has those of
/// distances, heights above planes, measured planes, pose priors, motions and Manhattan frames),
/// the prior. Deterministic; single-threaded. Accuracies of the estimate: window_information.h and
/// scale_uncertainty.h.
class SlidingWindow {
 public:
  SlidingWindow(const SlidingWindowOptions& options, const Camera& camera);
  ~SlidingWindow();
  SlidingWindow(SlidingWindow&&) noexcept;
  SlidingWindow& operator=(SlidingWindow&&) noexcept;

  /// Adds a keyframe; ids must be new and ascending. The first keyframe fixes the gauge: it is held
  /// until it is marginalized, then its prior fixes the gauge (or, without a prior, the next oldest
  /// is held). If neither depth nor a distance measures the scale, it is fixed at its current
  /// value: by a soft distance to the farthest keyframe, and by the prior once that distance is
  /// marginalized.
  /// `stamp_s`: its time [s], if known; the accuracy of the motion makes use of it.
  void add_keyframe(KeyframeId id, const SE3& T_map_cam,
                    const std::optional<double>& stamp_s = std::nullopt);
  void add_landmark(LandmarkId id, const Eigen::Vector3d& p_map);
  void add_observation(const WindowObservation& observation);
  /// Adds a line, which is used if it has at least three images from at least two keyframes: fewer
  /// do not constrain the poses (two planes always intersect in a line). Its planes through the
  /// cameras should differ by a few degrees: near the epipolar plane its position is hardly
  /// determined, and no covariance describes that.
  void add_line(LineId id, const Line3& line_map);
  void add_line_observation(const LineObservation& observation);
  /// Adds a plane. It leaves the window with the last keyframe that measured it or whose height
  /// above it is known and the last point on it. If it is kept, the prior still constrains it to
  /// the keyframes. Heights determine the scale if at least three points are on their plane; a
  /// measured plane is metric.
  void add_plane(PlaneId id, const Plane3& plane_map);
  void add_plane_point(const PlanePoint& point);
  /// Adds a Manhattan frame. It leaves the window with the last keyframe that observed it. If it is
  /// kept, the prior still constrains it to the keyframes, as far as their motion is known.
  void add_manhattan_frame(ManhattanFrameId id, const SO3& R_map_manhattan);
  /// Adds a measurement of any kind between keyframes, planes and Manhattan frames. A full-rank
  /// prior of the held keyframe replaces holding it. A measurement that determines all directions
  /// of a keyframe is sufficient without landmarks.
  void add(const WindowFactor& factor);

  /// Removes a landmark with its observations (an outlier).
  void remove_landmark(LandmarkId id);
  void remove_observation(KeyframeId keyframe, LandmarkId landmark);
  void remove_line(LineId id);
  /// Removes a plane with all its measurements in the window, and marginalizes it in the prior.
  void remove_plane(PlaneId id);
  /// Removes this measurement of factors(), even if others have the same variables.
  void remove(const WindowFactor& factor);
  /// Replaces the inverse depth [1/m] of an observation that has one, e.g. after a new calibration.
  void revise_inverse_depth(KeyframeId keyframe, LandmarkId landmark, double inverse_depth);
  /// Replaces an observation of a landmark in a keyframe, e.g. after a new calibration.
  void revise(const WindowObservation& observation);
  /// Replaces the observation by a second camera, e.g. after its calibration. It must exist.
  void revise_second_camera(KeyframeId keyframe, LineId line,
                            const LineObservation::SecondCamera& second);

  /// Excludes a variable from marginalization, regardless of its age: a keyframe as the anchor of
  /// relative covariances of later ones (it still counts in max_keyframes), or a plane or a
  /// Manhattan frame that may be observed again.
  void keep(const WindowVariable& variable, bool kept = true);
  /// Fixes the rotation of the whole window by a Manhattan frame: after each optimization the
  /// window is rotated about its oldest keyframe so that this frame keeps its R_map_manhattan.
  /// Empty: no rotation.
  void hold_manhattan_frame(std::optional<ManhattanFrameId> id);

  [[nodiscard]] WindowSummary optimize();
  /// Marginalizes the oldest keyframes until at most max_keyframes are left. Landmarks and lines
  /// that the newest keyframe does not observe are marginalized with them; observations of the
  /// others in the leaving keyframe are dropped. Returns the ids of keyframes that left.
  std::vector<KeyframeId> marginalize();
  /// Multiplies all positions, landmarks and the prior's linearization by `scale` (> 0) about the
  /// oldest keyframe, for a monocular map whose metric scale becomes known. Throws if a measurement
  /// in the window already determines the scale: a distance, an inverse depth, a height, pose
  /// priors, a motion.
  void rescale(double scale);

  std::vector<KeyframeId> keyframes() const;               ///< ascending
  std::vector<LandmarkId> landmarks() const;               ///< ascending
  std::vector<LineId> lines() const;                       ///< ascending
  std::vector<PlaneId> planes() const;                     ///< ascending
  std::vector<ManhattanFrameId> manhattan_frames() const;  ///< ascending
  SE3 pose(KeyframeId keyframe) const;                     ///< T_map_cam
  std::optional<Eigen::Vector3d> landmark(LandmarkId id) const;
  std::optional<Line3> line(LineId id) const;
  std::optional<Plane3> plane(PlaneId id) const;
  std::optional<SO3> manhattan_frame(ManhattanFrameId id) const;  ///< R_map_manhattan
  const std::vector<WindowObservation>& observations(LandmarkId landmark) const;
  const std::vector<LineObservation>& line_observations(LineId line) const;
  /// All measurements, grouped by type; within a type in the order in which they were added.
  const std::vector<WindowFactor>& factors() const;

  /// The complete state of the window.
  const WindowState& state() const { return *state_; }
  /// The information of the estimate, computed on request and kept until the window changes.
  const WindowInformation& information() const;

 private:
  /// The state for a change; discards everything computed from it.
  WindowState& change();

  std::unique_ptr<WindowState> state_;
  mutable std::optional<WindowInformation> information_;
};

}  // namespace placegraph
