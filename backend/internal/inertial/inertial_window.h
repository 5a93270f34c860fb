#pragma once
#include <placegraph/backend/internal/inertial/inertial_factors.h>
#include <placegraph/backend/internal/inertial/inertial_options.h>
#include <placegraph/backend/internal/linear/marginalization.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>

#include <deque>
#include <vector>

namespace placegraph {

/// The smoother beside PositionFilter: pose, velocity and biases at the times of the last images by
/// Gauss-Newton over all measurements between them: preintegrated inertial samples, poses told by
/// markers, flow over a level floor. What is older is marginalized into a quadratic prior of the
/// oldest state (Schur complement). The states are a chain: forwards and backwards elimination
/// gives the steps and the covariance of every state. Deterministic; single-threaded.
class InertialWindow {
 public:
  /// As PositionFilter: `T_body_cam` is the mounting of the camera that flow is seen by.
  InertialWindow(const InertialWindowOptions& options, const SE3& T_body_cam, double floor_z_m = 0);

  /// Begins at this state with its covariance. Throws ArgumentError if either is not usable.
  void start(const BodyState& state);
  bool started() const { return !states_.empty(); }

  /// Inertial samples come in the order of their stamps. Outcomes: inconsistent (not after the last
  /// one, not finite), not attempted (before `start`).
  Outcome add(const ImuSample& sample);
  /// A measurement makes the states at its times, if they are newer than the newest. Outcomes:
  /// inconsistent (outside the gate, not finite), not attempted (before `start`), too few data
  /// (older than the window or between its states; no inertial samples reach to it).
  Outcome add(const PoseMeasurement& observation);
  Outcome add(const FlowMeasurement& observation);

  /// The states of the window, oldest first, at the minimum. The oldest ones know most of what came
  /// after them. Outcomes: not attempted.
  struct StateEstimate {
    Outcome outcome;
    std::vector<BodyState> states;
  };
  StateEstimate solve();

 private:
  struct State {
    BodyState value;
    /// From the state before; of the first not used.
    std::optional<ImuPreintegration> motion;
    std::vector<PoseMeasurement> poses;
    std::vector<FlowMeasurement> flows;  ///< from the state before
  };
  struct Chain;

  Outcome reach(std::int64_t stamp_ns, std::size_t& index);
  Outcome append(std::int64_t stamp_ns);
  Chain linearize(std::size_t from, std::size_t to) const;
  void improve(int iterations);
  void forget();
  bool is_within_gate(const StateError& error, std::size_t index) const;

  InertialWindowOptions options_;
  SE3 T_body_cam_;
  double floor_z_m_;
  std::deque<State> states_;
  std::deque<ImuSample> samples_;  ///< the last before the newest state, and those after
  bool begins_at_rest_ = false;    ///< the first of them was assumed, not measured
  BodyState prior_at_;             ///< where the prior was taken
  QuadraticForm prior_;            ///< of the oldest state's step from there
};

}  // namespace placegraph
