#pragma once
#include <placegraph/backend/factors/marginal_prior.h>
#include <placegraph/backend/sliding_window.h>

#include <map>

namespace placegraph {

struct WindowLandmark {
  Eigen::Vector3d p_map = Eigen::Vector3d::Zero();
  std::vector<WindowObservation> observations;  ///< ascending keyframes
};

/// All that a sliding window knows. Ordered containers only: every sum runs in the order of the
/// ids.
struct WindowState {
  SlidingWindowOptions options;
  Camera camera;
  std::map<std::int64_t, SE3> keyframes;  ///< T_map_cam
  std::map<std::int64_t, WindowLandmark> landmarks;
  std::vector<DistanceObservation> distances;
  MarginalPrior prior;
  bool prior_is_metric = false;  ///< depths or distances went into the prior
  bool prior_holds_scale = false;
  /// The oldest keyframe, while no prior holds position and heading of the window.
  std::optional<std::int64_t> fixed;
};

/// The observations of a landmark that an estimate can use: those whose point lies in front of the
/// camera, and only if there are at least two. (One view moves its own point only.)
std::vector<const WindowObservation*> usable_observations(const WindowState& state,
                                                          const WindowLandmark& landmark);

/// Whether a depth or a distance in the window gives the scale.
bool has_metric_observation(const WindowState& state);

/// While nothing gives the scale (no depth, no distance, no prior), it is held by a soft distance
/// (1 %) between the oldest keyframe and the one farthest from it, at its present length: this
/// picks one of the equivalent solutions and changes none of their residuals.
std::optional<DistanceObservation> scale_reference(const WindowState& state);

/// Minimizes over all of the window (window_problem.cpp).
WindowSummary optimize_window(WindowState& state);

/// Moves one keyframe and the landmarks that end with it into the prior (window_equations.cpp).
void marginalize_keyframe(WindowState& state, std::int64_t leaving);

/// See SlidingWindow::relative_information (window_equations.cpp).
Matrix6d relative_information(const WindowState& state, std::int64_t from, std::int64_t to);

}  // namespace placegraph
