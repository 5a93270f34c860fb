#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/measurements/body_state.h>

#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Interpolates the state of a recording (stamps increasing) at a time.
/// Position, velocity and biases linearly, rotation along the geodesic. Nothing outside the
/// recording or across a gap wider than `max_gap_s`.
std::optional<BodyState> interpolate(const std::vector<BodyState>& recording, std::int64_t stamp_ns,
                                     double max_gap_s = 0.1);

/// Errors of estimated states, without any alignment.
struct BodyStateError {
  Outcome outcome;
  int compared = 0;
  double position_rmse_m = 0, position_max_m = 0;
  double velocity_rmse_mps = 0;
  double attitude_rmse_rad = 0;
  double end_error_m = 0;    ///< position error at the last compared state
  double path_length_m = 0;  ///< true path length from the first to the last compared state
  /// Mean normalized squared error over its degrees of freedom (Bar-Shalom et al. 2001, 5.4.2):
  /// for the whole state, and for its parts by their marginal covariances. It is 1 if the errors
  /// agree with the covariances.
  double anees = 0, anees_position = 0, anees_velocity = 0, anees_attitude = 0;
};

/// Computes the errors of all states at times of the ground truth.
/// Outcomes: too few data (no such state), degenerate (a covariance that is not positive definite;
/// then only the averages of that kind are missing).
[[nodiscard]] BodyStateError body_state_error(const std::vector<BodyState>& truth,
                                              const std::vector<BodyState>& estimated);

/// The error of one state in the order of BodyState::covariance.
Eigen::Matrix<double, 15, 1> error_of(const BodyState& truth, const BodyState& estimated);

}  // namespace placegraph
