#pragma once
#include <placegraph/backend/internal/inertial/inertial_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/internal/measurements/body_state.h>
#include <placegraph/graph/internal/measurements/sighting.h>
#include <placegraph/graph/measurements/imu.h>

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <variant>

namespace placegraph {

/// Error-state Kalman filter over position, velocity, attitude and biases (Solà 2017, "Quaternion
/// kinematics for the error-state Kalman filter"), driven by an inertial sensor, corrected by flow
/// over a level floor and by markers (Siddiqui 2014, 2.1 and 2.3.4). Measurements may come late and
/// in any order within `history_s`: the filter goes back, takes them in at their time, and comes
/// forward again, so that the order of arrival changes nothing.
class PositionFilter {
 public:
  using Covariance = Eigen::Matrix<double, 15, 15>;

  /// `T_body_cam` is the mounting of the camera that flow is seen by; the floor is z = `floor_z_m`.
  PositionFilter(const PositionFilterOptions& options, const SE3& T_body_cam, double floor_z_m = 0);

  /// Begins at this state. Throws ArgumentError if it or its covariance is not finite.
  void start(const BodyState& state);
  bool started() const { return !events_.empty(); }

  /// Inertial samples come in the order of their stamps. Outcomes: inconsistent (not after the last
  /// one, not finite), not attempted (before `start`).
  Outcome add(const ImuSample& sample);
  /// Outcomes of measurements: inconsistent (outside the gate, not finite), not attempted (before
  /// `start`), too few data (older than the history, or newer than the inertial samples reach).
  Outcome add(const PoseMeasurement& observation);
  Outcome add(const FlowMeasurement& observation);
  /// Squared deviation of a pose from what the filter expects at its time, in units of both
  /// covariances (chi^2, six degrees of freedom): tells the two poses of a planar marker apart.
  std::optional<double> deviation2(const PoseMeasurement& observation) const;

  struct StateEstimate {
    Outcome outcome;
    BodyState state;
  };
  /// The state at a time from the last measurement on, predicted beyond it by the last inertial
  /// sample; what the body may do after that is in the covariance. Outcomes: not attempted, too few
  /// data (out of reach of the inertial samples, before the history), degenerate (the position is
  /// not known to `max_position_sigma_m`).
  StateEstimate at(std::int64_t stamp_ns) const;
  /// `at` and `deviation2` for an estimator that does not know this filter, such as MarkerFilter.
  /// The filter must outlive it.
  BodyExpectation expectation(std::int64_t stamp_ns) const;

 private:
  using Measurement = std::variant<std::monostate, ImuSample, PoseMeasurement, FlowMeasurement>;
  struct Event {
    std::int64_t stamp_ns = 0;
    Measurement measurement;
    BodyState after;
    ImuSample imu;             // in force from here on
    bool imu_assumed = false;  // none was measured since the start
    bool accepted = true;
  };
  struct Innovation {
    Eigen::VectorXd residual;
    Eigen::MatrixXd H, R;
    Eigen::MatrixXd C;  // of the state's error with the measurement's; empty: none
  };

  Outcome insert(std::int64_t stamp_ns, const Measurement& measurement);
  void replay(std::size_t from);
  BodyState predict(const Event& from, std::int64_t to_ns, const ImuSample& imu) const;
  std::optional<Innovation> innovation(const BodyState& state, const ImuSample& imu,
                                       const Measurement& measurement) const;
  bool correct(const Innovation& innovation, BodyState& state) const;
  void forget();

  PositionFilterOptions options_;
  SE3 T_body_cam_;
  double floor_z_m_;
  std::deque<Event> events_;  // in the order of their times
};

}  // namespace placegraph
