#pragma once
#include <placegraph/backend/internal/window/window_factor.h>
#include <placegraph/backend/internal/window/window_observations.h>
#include <placegraph/graph/core/ids.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

// What a sliding window is asked about its accuracy. Ids that are not in the window throw
// ArgumentError.
namespace placegraph {

class SlidingWindow;
struct WindowState;

/// The normal equations of everything in a window, at its estimate, points and lines eliminated; in
/// them every plane, world and keyframe is a variable, the one that is held too.
struct WindowInformation {
  std::vector<WindowVariable> variables;  ///< planes, worlds, keyframes
  Eigen::MatrixXd H;
};
WindowInformation window_information(const WindowState& state);

/// Information of `variables` (right tangents, in that order) with all else marginalized, the
/// keyframe that is held as constant unless it is one of them; singular along the gauge.
Eigen::MatrixXd joint_information(const WindowState& state, const WindowInformation& information,
                                  const std::vector<WindowVariable>& variables);

/// Information (6x6, tangent of T_from_to on the right) of the relative pose between two keyframes
/// of the window, from the normal equations of everything in the window with all else marginalized.
/// Semi-definite where a direction is unobservable.
Matrix6d relative_information(const SlidingWindow& window, KeyframeId from, KeyframeId to);
/// Its inverse: the covariance of the relative pose. Nothing where a direction is unobservable.
std::optional<Matrix6d> relative_covariance(const SlidingWindow& window, KeyframeId from,
                                            KeyframeId to);
/// Covariance (tangent of T_map_cam on the right) of a keyframe's pose in the map, whose frame the
/// first keyframe (or the pose priors) set; zero while the keyframe is held. Nothing where a
/// direction is unobservable, and nothing once the way back to that frame is lost: where all that a
/// leaving keyframe saw was still in view, the next one has to be held in its place.
std::optional<Matrix6d> keyframe_covariance(const SlidingWindow& window, KeyframeId keyframe);
/// Covariance (right tangent) of R_cam_manhattan, a world as a keyframe has it before it. Nothing
/// where a direction is unobservable.
std::optional<Eigen::Matrix3d> manhattan_covariance(const SlidingWindow& window,
                                                    ManhattanFrameId manhattan_frame,
                                                    KeyframeId keyframe);
/// Covariance of the tangent of a plane as a keyframe has it before it, in its camera's frame.
/// Nothing where a direction is unobservable.
std::optional<Eigen::Matrix3d> plane_covariance(const SlidingWindow& window, PlaneId plane,
                                                KeyframeId keyframe);

/// Standard deviation of log(|t_middle_last| / |t_first_middle|) between three keyframes of the
/// window: how well it holds its unit of length where nothing measures that. The gauge plays no
/// part in it. Infinite if two of the three stand in one point. Throws ArgumentError unless they
/// are three different keyframes of the window.
double sigma_log_length_ratio(const SlidingWindow& window, KeyframeId first, KeyframeId middle,
                              KeyframeId last);

/// Reprojection error [px] of an observation at the current estimate; nothing behind the camera.
/// `residual_sigmas`: the same in standard deviations of its noise.
std::optional<Eigen::Vector2d> residual_px(const SlidingWindow& window,
                                           const WindowObservation& observation);
std::optional<Eigen::Vector2d> residual_sigmas(const SlidingWindow& window,
                                               const WindowObservation& observation);
/// Distances of both ends from the projected line [px].
std::optional<Eigen::Vector2d> residual_px(const SlidingWindow& window,
                                           const LineObservation& observation);
/// The error of a measurement in standard deviations, as many as its factor has; nothing where it
/// cannot be computed or a variable of it is not in the window.
std::optional<Eigen::VectorXd> residual_sigmas(const SlidingWindow& window,
                                               const WindowFactor& factor);

}  // namespace placegraph
