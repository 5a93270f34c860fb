#pragma once
#include <placegraph/backend/factors/line_reprojection.h>
#include <placegraph/backend/factors/marginal_prior.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/window/sliding_window_options.h>
#include <placegraph/backend/window/window_factor.h>
#include <placegraph/backend/window/window_observations.h>
#include <placegraph/graph/core/ids.h>

#include <map>
#include <optional>
#include <set>

namespace placegraph {

struct WindowLandmark {
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();
  std::vector<WindowObservation> observations;  ///< ascending keyframes
  std::optional<PlanePoint> on_plane;
};

struct WindowLine {
  Line3 line_map;
  std::vector<LineObservation> observations;  ///< ascending keyframes
};

/// The complete state of a sliding window.
/// It has ordered containers only: all sums are in the order of the ids and of the factors.
struct WindowState {
  SlidingWindowOptions options;
  Camera camera;
  std::map<KeyframeId, SE3> keyframes;  ///< T_map_cam
  std::map<KeyframeId, double> stamps;  ///< times [s], of keyframes that have one
  std::map<LandmarkId, WindowLandmark> landmarks;
  std::map<LineId, WindowLine> lines;
  std::map<PlaneId, Plane3> planes;                  ///< planes of the map
  std::map<ManhattanFrameId, SO3> manhattan_frames;  ///< R_map_manhattan
  std::set<WindowVariable> kept;                     ///< variables excluded from marginalization
  /// The window is rotated as a whole so that this Manhattan frame stays the same.
  std::optional<ManhattanFrameId> held_manhattan_frame;
  /// All measurements except those of points and lines, grouped by type; within a type in the order
  /// in which they were added.
  std::vector<WindowFactor> factors;
  MarginalPrior prior;
  bool prior_is_metric = false;  ///< whether a measurement of the scale was marginalized
  bool prior_holds_scale = false;
  /// The oldest keyframe, while no prior constrains position and heading of the window.
  std::optional<KeyframeId> fixed;
  /// Whether the prior still relates the window to the keyframe that defined the map's frame. False
  /// once another keyframe is held instead; covariances are then relative to that one.
  bool constrained_to_map = true;
};

/// Throws ArgumentError ("sliding window: keyframe 3 is not in the window") unless it is.
void require_variable(const WindowState& state, const WindowVariable& variable);
/// The estimate of a variable, which must be in the window.
Variable value_of(const WindowState& state, const WindowVariable& variable);

/// Mean twist of the camera [m/s, rad/s] between the neighbours of a keyframe, in the right tangent.
/// Empty if a stamp is unknown, or without a neighbour.
std::optional<Vector6d> velocity_of(const WindowState& state, KeyframeId keyframe);

/// All variables: keyframes, planes, Manhattan frames, each in the order of their ids.
std::vector<WindowVariable> variables_of(const WindowState& state);

/// The whitened residual of a factor at the estimate.
/// Empty if it cannot be computed or one of its variables is not in the window.
std::optional<Eigen::VectorXd> residual(const WindowState& state, const WindowFactor& factor);
/// Whether a factor determines all directions of one of its variables if the others are known.
bool determines(const WindowState& state, const WindowFactor& factor,
                const WindowVariable& variable);

/// The usable observations of a landmark: those with the point in front of the camera.
/// Empty if there are fewer than two, because a single view constrains only its own point.
std::vector<const WindowObservation*> usable_observations(const WindowState& state,
                                                          const WindowLandmark& landmark);

inline Reprojection reprojection_of(const Camera& camera, const WindowObservation& o) {
  if (o.covariance_px) return Reprojection(camera, o.px, *o.covariance_px);
  return Reprojection(camera, o.px, o.sigma_px);
}

/// Whether a line is usable: at least three images of it, in at least two keyframes.
bool is_usable(const WindowLine& line);

/// Calls `use` with the one or two factors of an observation.
template <class Use>
void for_factors(const Camera& camera, const LineObservation& o, Use&& use) {
  use(LineReprojectionFactor(camera, o.start_px, o.end_px, o.sigma_px));
  if (o.second)
    use(LineReprojectionFactor(camera, o.second->start_px, o.second->end_px, o.second->sigma_px,
                               o.second->second_in_cam));
}

/// Whether a factor of a single keyframe determines all its directions and so ties it to the map.
bool is_full_pose_prior(const WindowState& state, const WindowFactor& factor);
bool has_full_pose_prior(const WindowState& state);

/// Whether a measurement in the window determines the scale.
/// Such are a depth, a measured length, a height above a plane with at least three points, two
/// known positions.
bool has_metric_observation(const WindowState& state);

/// A soft distance (1 %) that fixes the scale if neither a measurement nor the prior determines it.
/// It is between the oldest keyframe and the farthest from it, at the current length. It selects
/// one of the equivalent solutions and does not change their residuals.
std::optional<WindowFactor> scale_reference(const WindowState& state);

}  // namespace placegraph
