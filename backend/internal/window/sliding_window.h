#pragma once
#include <placegraph/backend/internal/window/distortion_evidence.h>
#include <placegraph/backend/internal/window/window_information.h>
#include <placegraph/backend/internal/window/window_measurements.h>
#include <placegraph/backend/internal/window/window_observations.h>
#include <placegraph/backend/internal/window/window_summary.h>
#include <placegraph/backend/window/sliding_window_options.h>
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

/// Bundle adjustment over the last keyframes; what leaves is marginalized into a linear prior by
/// Schur complement, with first-estimate Jacobians for the states that stay in it. Undistorted
/// pinhole camera. Residuals: reprojection (px / sigma, Huber), inverse depth, the ends of segments
/// from projected lines, points on planes, the factors that are added (window_measurements.h has
/// those of distances, heights above planes, planes as they were measured, pose priors, motions and
/// rotations against rectangular worlds), the prior. Deterministic; single-threaded. What the
/// window knows of its accuracy is asked by window_information.h and scale_uncertainty.h.
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
  void add_keyframe(KeyframeId id, const SE3& T_map_cam);
  void add_landmark(LandmarkId id, const Eigen::Vector3d& p_map);
  void add_observation(const WindowObservation& observation);
  /// A line counts from three images on, of two keyframes or more: fewer say nothing of the poses
  /// (two planes always meet in a line). Its planes through the cameras should have turned by a few
  /// degrees: nearer to the epipolar plane its position is hardly determined, and no covariance
  /// describes that.
  void add_line(LineId id, const Line3& line_map);
  void add_line_observation(const LineObservation& observation);
  /// A plane leaves the window with the last keyframe that measured it or whose height above it is
  /// known and the last point on it, unless it is kept: then the prior goes on to hold it to the
  /// keyframes. Heights give the scale where at least three points lie on their plane; a measured
  /// plane is metric.
  void add_plane(PlaneId id, const Plane3& plane_map);
  void add_plane_point(const PlanePoint& point);
  /// A world leaves the window with the last keyframe that saw it, unless it is kept: then the
  /// prior goes on to hold it to the keyframes, as far as their motion is known.
  void add_manhattan_frame(ManhattanFrameId id, const SO3& R_map_manhattan);
  /// A measurement of any kind between keyframes, planes and worlds. A full-rank prior of the
  /// keyframe that is held takes the place of holding it. What leaves no direction of a keyframe
  /// open is enough to determine it without landmarks.
  void add(const WindowFactor& factor);

  /// Forgets a landmark with its observations (an outlier).
  void remove_landmark(LandmarkId id);
  void remove_observation(KeyframeId keyframe, LandmarkId landmark);
  void remove_line(LineId id);
  /// Forgets a plane with all that was measured of it in the window; what went into the prior is
  /// integrated over it.
  void remove_plane(PlaneId id);
  /// Forgets a measurement, one of factors(): of several with the same variables this one.
  void remove(const WindowFactor& factor);
  /// The inverse depth [1/m] of an observation that has one, as it is measured by a better
  /// calibration.
  void revise_inverse_depth(KeyframeId keyframe, LandmarkId landmark, double inverse_depth);
  /// What a second eye saw is known better now, as after its calibration. It must be there.
  void revise_second_camera(KeyframeId keyframe, LineId line,
                            const LineObservation::SecondCamera& second);

  /// What is kept is not marginalized, however old it is: a keyframe as an anchor to which later
  /// ones shall have a relative covariance (its place in max_keyframes it takes all the same), a
  /// plane or a world that may be seen again.
  void keep(const WindowVariable& variable, bool kept = true);
  /// Where the window lies as a whole is chosen anew after each optimization: turned about its
  /// oldest keyframe so that this world stays at its R_map_manhattan. Nothing: as it comes out.
  void hold_manhattan_frame(std::optional<ManhattanFrameId> id);

  [[nodiscard]] WindowSummary optimize();
  /// Marginalizes the oldest keyframes until at most max_keyframes are left: landmarks and lines
  /// that the newest keyframe no longer sees are marginalized with them, observations of the others
  /// in the leaving keyframe are dropped. Returns the ids of keyframes that left.
  std::vector<KeyframeId> marginalize();
  /// Multiplies all positions, landmarks and the prior's linearization by `scale` (> 0) about the
  /// oldest keyframe: for a mono map whose metric scale becomes known. Throws if something in the
  /// window measures it already: a distance, an inverse depth, a height, pose priors, a motion.
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
  /// Those of one type together, and these in the order in which they came.
  const std::vector<WindowFactor>& factors() const;

  /// All that the window knows.
  const WindowState& state() const { return *state_; }
  /// Computed when it is asked for, and kept until the window changes.
  const WindowInformation& information() const;

 private:
  /// What follows from the state is forgotten.
  WindowState& change();

  std::unique_ptr<WindowState> state_;
  mutable std::optional<WindowInformation> information_;
};

}  // namespace placegraph
