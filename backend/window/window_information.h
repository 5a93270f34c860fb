#pragma once
#include <placegraph/backend/window/window_equations.h>

namespace placegraph {

/// The normal equations of everything in a window, at its estimate, points and lines eliminated; in
/// them every plane, world and keyframe is a variable, the one that is held too.
struct WindowInformation {
  WindowVariables variables;  ///< planes, worlds, keyframes
  Eigen::MatrixXd H;
};
WindowInformation window_information(const WindowState& state);

/// Information of `variables` (right tangents, in that order) with all else marginalized, the
/// keyframe that is held as constant unless it is one of them; singular along the gauge.
Eigen::MatrixXd joint_information(const WindowState& state, const WindowInformation& information,
                                  const std::vector<WindowVariables::Variable>& variables);
/// The information of a keyframe's pose in the map, all else marginalized.
Matrix6d absolute_information(const WindowState& state, const WindowInformation& information,
                              std::int64_t keyframe);
/// See SlidingWindow::relative_information.
Matrix6d relative_information(const WindowState& state, const WindowInformation& information,
                              std::int64_t from, std::int64_t to);
/// See SlidingWindow::world_covariance.
std::optional<Eigen::Matrix3d> world_covariance(const WindowState& state,
                                                const WindowInformation& information,
                                                std::int64_t world, std::int64_t keyframe);
/// See SlidingWindow::plane_covariance.
std::optional<Eigen::Matrix3d> plane_covariance(const WindowState& state,
                                                const WindowInformation& information,
                                                std::int64_t plane, std::int64_t keyframe);
/// See SlidingWindow::sigma_log_length_ratio.
double sigma_log_length_ratio(const WindowState& state, const WindowInformation& information,
                              std::int64_t first, std::int64_t middle, std::int64_t last);

}  // namespace placegraph
