#pragma once
#include <placegraph/backend/window/landmark_equations.h>
#include <placegraph/backend/window/window_factor.h>
#include <placegraph/backend/window/window_observations.h>
#include <placegraph/graph/core/ids.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

// Accuracies of a sliding window's estimate. Ids that are not in the window throw ArgumentError.
namespace placegraph {

class SlidingWindow;
struct WindowState;

/// The normal equations of a whole window at its estimate, with points and lines eliminated.
/// Every plane, Manhattan frame and keyframe is a variable, including the held keyframe.
struct WindowInformation {
  std::vector<WindowVariable> variables;  ///< planes, Manhattan frames, keyframes
  Eigen::MatrixXd H;

  /// The same without the prior, whose observations are not in the window any more: it only
  /// decides what all other measurements leave open. Pseudo-inverse of the normal equations, the
  /// gradient by the images, and the sums over landmarks; `images.scatter` has the information of
  /// all other measurements as their scatter.
  struct WithoutPrior {
    Eigen::MatrixXd covariance;
    Eigen::VectorXd gradient;
    ImageSums images;
  } without_prior;
};
WindowInformation window_information(const WindowState& state);

/// Information of `variables` (right tangents, in that order), all others marginalized.
/// The held keyframe is constant unless it is one of them. Singular along the gauge.
Eigen::MatrixXd joint_information(const WindowState& state, const WindowInformation& information,
                                  const std::vector<WindowVariable>& variables);

/// Information of the relative pose between two keyframes of the window.
/// 6x6, right tangent of T_from_to; from the normal equations of the whole window, all other
/// variables marginalized. Semi-definite if a direction is unobservable.
Matrix6d relative_information(const SlidingWindow& window, KeyframeId from, KeyframeId to);
/// Its inverse: the covariance of the relative pose. Empty if a direction is unobservable.
std::optional<Matrix6d> relative_covariance(const SlidingWindow& window, KeyframeId from,
                                            KeyframeId to);
/// Covariance of a keyframe's pose in the map, right tangent of T_map_cam.
/// The first keyframe (or the pose priors) defines the map's frame; zero while the keyframe is
/// held. Empty if a direction is unobservable, or once the relation to that frame is lost: if all
/// landmarks of a leaving keyframe were still in view, the next keyframe is held in its place.
std::optional<Matrix6d> keyframe_covariance(const SlidingWindow& window, KeyframeId keyframe);
/// Covariance (right tangent) of R_cam_manhattan, a Manhattan frame in a keyframe's camera frame.
/// Empty if a direction is unobservable.
std::optional<Eigen::Matrix3d> manhattan_covariance(const SlidingWindow& window,
                                                    ManhattanFrameId manhattan_frame,
                                                    KeyframeId keyframe);
/// Covariance of the tangent of a plane in a keyframe's camera frame.
/// Empty if a direction is unobservable.
std::optional<Eigen::Matrix3d> plane_covariance(const SlidingWindow& window, PlaneId plane,
                                                KeyframeId keyframe);

/// Covariance of a landmark's position in the map, given the keyframes of the window.
/// Empty if its observations in the window do not determine it.
std::optional<Eigen::Matrix3d> landmark_covariance(const SlidingWindow& window,
                                                   LandmarkId landmark);

/// Standard deviation of log(|t_middle_last| / |t_first_middle|) of three keyframes.
/// It measures the drift of the scale within the window if no measurement determines the scale, and
/// is independent of the gauge. Infinite if two of the three have the same position. Throws
/// ArgumentError unless they are three different keyframes of the window.
double sigma_log_length_ratio(const SlidingWindow& window, KeyframeId first, KeyframeId middle,
                              KeyframeId last);

/// Reprojection error [px] of an observation at the current estimate; empty behind the camera.
/// `residual_sigmas`: the same in standard deviations of its noise.
std::optional<Eigen::Vector2d> residual_px(const SlidingWindow& window,
                                           const WindowObservation& observation);
std::optional<Eigen::Vector2d> residual_sigmas(const SlidingWindow& window,
                                               const WindowObservation& observation);
/// Distances [px] of both ends of an observed segment from the projected line.
std::optional<Eigen::Vector2d> residual_px(const SlidingWindow& window,
                                           const LineObservation& observation);
/// The residual of a measurement in standard deviations, as long as that of its factor.
/// Empty if it cannot be computed or one of its variables is not in the window.
std::optional<Eigen::VectorXd> residual_sigmas(const SlidingWindow& window,
                                               const WindowFactor& factor);

}  // namespace placegraph
