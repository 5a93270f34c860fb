#pragma once
#include <placegraph/backend/factors/line_reprojection.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/internal/factors/marginal_prior.h>
#include <placegraph/backend/internal/window/window_factor.h>
#include <placegraph/backend/internal/window/window_observations.h>
#include <placegraph/backend/window/sliding_window_options.h>
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

/// All that a sliding window knows. Ordered containers only: every sum runs in the order of the
/// ids, and over the factors as they stand.
struct WindowState {
  SlidingWindowOptions options;
  Camera camera;
  std::map<KeyframeId, SE3> keyframes;  ///< T_map_cam
  std::map<LandmarkId, WindowLandmark> landmarks;
  std::map<LineId, WindowLine> lines;
  std::map<PlaneId, Plane3> planes;                  ///< planes of the map
  std::map<ManhattanFrameId, SO3> manhattan_frames;  ///< R_map_manhattan
  std::set<WindowVariable> kept;                     ///< are not to be marginalized
  /// Where the window lies as a whole is chosen so that this one stays as it is.
  std::optional<ManhattanFrameId> held_manhattan_frame;
  /// All measurements but those of points and lines: those of one type together, in the order in
  /// which they came.
  std::vector<WindowFactor> factors;
  MarginalPrior prior;
  bool prior_is_metric = false;  ///< what measures the scale went into the prior
  bool prior_holds_scale = false;
  /// The oldest keyframe, while no prior holds position and heading of the window.
  std::optional<KeyframeId> fixed;
  /// Nothing but the prior leads back to the keyframe that set the map's frame; once another has to
  /// be held instead, what is known is known from there only.
  bool tied_to_map = true;
};

/// Throws ArgumentError ("sliding window: keyframe 3 is not in the window") unless it is.
void require_variable(const WindowState& state, const WindowVariable& variable);
/// The estimate of a variable, which must be in the window.
Variable value_of(const WindowState& state, const WindowVariable& variable);

/// All of them: keyframes, planes, worlds, each in the order of their ids.
std::vector<WindowVariable> variables_of(const WindowState& state);

/// The whitened residual of a factor at the estimate; nothing where it cannot be computed or one of
/// its variables is not in the window.
std::optional<Eigen::VectorXd> residual(const WindowState& state, const WindowFactor& factor);
/// Whether a factor leaves no direction of one of its variables open, were the others known.
bool determines(const WindowState& state, const WindowFactor& factor,
                const WindowVariable& variable);

/// The observations of a landmark that an estimate can use: those whose point lies in front of the
/// camera, and only if there are at least two. (One view moves its own point only.)
std::vector<const WindowObservation*> usable_observations(const WindowState& state,
                                                          const WindowLandmark& landmark);

inline Reprojection reprojection_of(const Camera& camera, const WindowObservation& o) {
  if (o.covariance_px) return Reprojection(camera, o.px, *o.covariance_px);
  return Reprojection(camera, o.px, o.sigma_px);
}

/// A line that an estimate can use: at least three images of it, in two keyframes or more.
bool is_usable(const WindowLine& line);

/// Calls `use` with the one or two factors of an observation.
template <class Use>
void for_factors(const Camera& camera, const LineObservation& o, Use&& use) {
  use(LineReprojectionFactor(camera, o.start_px, o.end_px, o.sigma_px));
  if (o.second)
    use(LineReprojectionFactor(camera, o.second->start_px, o.second->end_px, o.second->sigma_px,
                               o.second->second_in_cam));
}

/// Whether a factor of one keyframe alone leaves no direction of it open: it holds the window in
/// the map.
bool is_full_pose_prior(const WindowState& state, const WindowFactor& factor);
bool has_full_pose_prior(const WindowState& state);

/// Whether something in the window gives the scale: a depth, a measured length, a height above a
/// plane with at least three points, two known positions.
bool has_metric_observation(const WindowState& state);

/// While nothing gives the scale (nothing measures it, no prior), it is held by a soft distance
/// (1 %) between the oldest keyframe and the one farthest from it, at its present length: this
/// picks one of the equivalent solutions and changes none of their residuals.
std::optional<WindowFactor> scale_reference(const WindowState& state);

}  // namespace placegraph
