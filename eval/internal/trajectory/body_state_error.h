#pragma once
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/internal/measurements/body_state.h>

#include <optional>
#include <vector>

namespace placegraph {

/// The state of a recording (stamps increasing) at a time: position, velocity and biases linear,
/// rotation geodesic. Nothing outside it or across a gap wider than `max_gap_s`.
std::optional<BodyState> interpolate(const std::vector<BodyState>& recording, std::int64_t stamp_ns,
                                     double max_gap_s = 0.1);

/// How far estimated states are from the true ones, without any alignment.
struct BodyStateError {
  Outcome outcome;
  int compared = 0;
  double position_rmse_m = 0, position_max_m = 0;
  double velocity_rmse_mps = 0;
  double attitude_rmse_rad = 0;
  double end_error_m = 0;  ///< of the position, at the last state compared
  double way_m = 0;        ///< flown, by the truth, from the first state compared to the last
  /// Mean normalized squared error over its degrees of freedom (Bar-Shalom et al. 2001, 5.4.2):
  /// of the whole state, and of its parts by their marginal covariances. One where errors are as
  /// large as the covariances say.
  double anees = 0, anees_position = 0, anees_velocity = 0, anees_attitude = 0;
};

/// Of all states at whose time there is a truth. Outcomes: too few data (none), degenerate (a
/// covariance that is not positive definite; then only the averages of that kind are missing).
[[nodiscard]] BodyStateError body_state_error(const std::vector<BodyState>& truth,
                                              const std::vector<BodyState>& estimated);

/// The error of one state in the order of BodyState::covariance.
Eigen::Matrix<double, 15, 1> error_of(const BodyState& truth, const BodyState& estimated);

}  // namespace placegraph
