#pragma once
#include <placegraph/backend/factors/line_reprojection.h>
#include <placegraph/backend/factors/marginal_prior.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/window/sliding_window_options.h>
#include <placegraph/backend/window/window_observations.h>

#include <map>
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
/// ids.
struct WindowState {
  SlidingWindowOptions options;
  Camera camera;
  std::map<std::int64_t, SE3> keyframes;  ///< T_map_cam
  std::map<std::int64_t, WindowLandmark> landmarks;
  std::map<std::int64_t, WindowLine> lines;
  std::map<std::int64_t, Plane3> planes;  ///< planes of the map
  std::map<std::int64_t, SO3> worlds;     ///< R_map_world
  std::set<std::int64_t> kept;            ///< keyframes that are not to be marginalized
  std::set<std::int64_t> kept_worlds;     ///< worlds that are not to be marginalized
  std::set<std::int64_t> kept_planes;     ///< planes that are not to be marginalized
  /// Where the window lies as a whole is chosen so that this one stays as it is.
  std::optional<std::int64_t> held_world;
  std::vector<DistanceObservation> distances;
  std::vector<HeightObservation> heights;
  std::vector<PlaneObservation> plane_observations;
  std::vector<PosePrior> pose_priors;
  std::vector<WorldObservation> world_observations;
  std::vector<MotionObservation> motions;
  MarginalPrior prior;
  bool prior_is_metric = false;  ///< what measures the scale went into the prior
  bool prior_holds_scale = false;
  /// The oldest keyframe, while no prior holds position and heading of the window.
  std::optional<std::int64_t> fixed;
};

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
                               o.second->eye_cam));
}

/// Square root of the information of a world's sighting, or of a measured plane.
Eigen::Matrix3d whitening_of(const WorldObservation& observation);
Eigen::Matrix3d whitening_of(const PlaneObservation& observation);

/// Moves all that a window knows, the linearization points of its prior too, by T_new_old on the
/// left: the same window in another frame (window_worlds.cpp).
void move_window(WindowState& state, const SE3& T_new_old);
/// Turns the window about its oldest keyframe so that `world` comes to lie at R_map_world.
void turn_window(WindowState& state, std::int64_t world, const SO3& R_map_world);

/// A full-rank pose prior in the window holds it in the map.
bool has_full_pose_prior(const WindowState& state);

/// Whether something in the window gives the scale: a depth, a distance, a measured plane, a height
/// above a plane with at least three points, two known positions, a motion of full rank.
bool has_metric_observation(const WindowState& state);

/// A motion that leaves no direction open.
bool is_full(const MotionObservation& motion);

/// While nothing gives the scale (nothing measures it, no prior), it is held by a soft distance
/// (1 %) between the oldest keyframe and the one farthest from it, at its present length: this
/// picks one of the equivalent solutions and changes none of their residuals.
std::optional<DistanceObservation> scale_reference(const WindowState& state);

/// Minimizes over all of the window (window_problem.cpp).
WindowSummary optimize_window(WindowState& state);

/// Moves one keyframe and the landmarks that end with it into the prior
/// (window_marginalization.cpp).
void marginalize_keyframe(WindowState& state, std::int64_t leaving);

}  // namespace placegraph
