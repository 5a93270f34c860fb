#pragma once
#include <placegraph/backend/inertial/inertial_factors.h>
#include <placegraph/backend/inertial/inertial_options.h>
#include <placegraph/backend/linear/marginalization.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>

#include <deque>
#include <vector>

namespace placegraph {

/// Fixed-lag smoother: pose, velocity and biases at the times of the last images.
/// It is an alternative to ErrorStateFilter: Gauss-Newton over all measurements of the window, i.e.
/// preintegrated inertial samples, poses measured by markers, flow over a level floor. Older states
/// are marginalized into a quadratic prior of the oldest state (Schur complement). The states are a
/// chain: forward and backward elimination compute the steps and the covariance of every state.
/// Deterministic; single-threaded.
class InertialWindow {
 public:
  /// As ErrorStateFilter: `T_body_cam` is the pose of the camera that measures flow.
  InertialWindow(const InertialWindowOptions& options, const SE3& T_body_cam, double floor_z_m = 0);

  /// Starts from this state with its covariance. Throws ArgumentError if either is invalid.
  void start(const BodyState& state);
  bool started() const { return !states_.empty(); }

  /// Adds an inertial sample; they must be in the order of their stamps. Outcomes: inconsistent
  /// (not after the last one, not finite), not attempted (before `start`).
  Outcome add(const ImuSample& sample);
  /// Adds a measurement, and states at its times that are newer than the newest state. Outcomes:
  /// inconsistent (outside the gate, not finite), not attempted (before `start`), too few data
  /// (older than the window, between its states, or after the inertial samples).
  Outcome add(const PoseMeasurement& observation);
  Outcome add(const FlowMeasurement& observation);

  /// The states of the window at the minimum, oldest first. The estimates of the oldest states use
  /// most later measurements. Outcomes: not attempted.
  struct StateEstimate {
    Outcome outcome;
    std::vector<BodyState> states;
  };
  StateEstimate solve();

 private:
  struct State {
    BodyState value;
    /// Motion since the previous state; not used for the first state.
    std::optional<ImuPreintegration> motion;
    std::vector<PoseMeasurement> poses;
    std::vector<FlowMeasurement> flows;  ///< flow since the previous state
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
  std::deque<ImuSample> samples_;  ///< the last sample before the newest state, and all later ones
  bool begins_at_rest_ = false;    ///< whether the first sample was assumed, not measured
  BodyState prior_at_;             ///< linearization point of the prior
  QuadraticForm prior_;            ///< prior of the oldest state's step from prior_at_
};

}  // namespace placegraph
