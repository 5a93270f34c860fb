#pragma once
#include <placegraph/backend/inertial/inertial_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/measurements/body_state.h>
#include <placegraph/graph/measurements/imu.h>

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>
#include <variant>

namespace placegraph {

/// Error-state Kalman filter over position, velocity, attitude and biases.
/// It follows Solà 2017, "Quaternion kinematics for the error-state Kalman filter". An inertial
/// sensor drives it; flow over a level floor and markers correct it (Siddiqui 2014, 2.1 and 2.3.4).
/// Measurements may arrive late and in any order within `history_s`: the filter inserts them at
/// their time and repeats the later updates, so that the result is independent of the order of
/// arrival.
class ErrorStateFilter {
 public:
  using Covariance = Eigen::Matrix<double, 15, 15>;

  /// `T_body_cam` is the pose of the camera that measures flow; the floor is z = `floor_z_m`.
  ErrorStateFilter(const ErrorStateFilterOptions& options, const SE3& T_body_cam,
                   double floor_z_m = 0);

  /// Starts from this state. Throws ArgumentError if it or its covariance is not finite.
  void start(const BodyState& state);
  bool started() const { return !events_.empty(); }

  /// Adds an inertial sample; they must be in the order of their stamps. Outcomes: inconsistent
  /// (not after the last one, not finite), not attempted (before `start`).
  Outcome add(const ImuSample& sample);
  /// Adds a measurement. Outcomes: inconsistent (outside the gate, not finite), not attempted
  /// (before `start`), too few data (older than the history, or too new for the inertial samples).
  Outcome add(const PoseMeasurement& observation);
  Outcome add(const FlowMeasurement& observation);
  /// Squared deviation of a pose from the filter's prediction at its time.
  /// It is weighted by both covariances (chi^2, six degrees of freedom) and distinguishes the two
  /// poses of a planar marker.
  std::optional<double> deviation2(const PoseMeasurement& observation) const;

  struct StateEstimate {
    Outcome outcome;
    BodyState state;
  };
  /// The state at a time after the start of the history.
  /// It is predicted from the last measurement before that time, with the last inertial sample; the
  /// covariance includes the possible motion after that sample. Outcomes: not attempted, too few
  /// data (too long after the inertial samples, before the history), degenerate (the standard
  /// deviation of the position exceeds `max_position_sigma_m`).
  StateEstimate at(std::int64_t stamp_ns) const;
  /// `at` and `deviation2` for an estimator that is independent of this filter, such as
  /// MarkerFilter.
  /// The filter must outlive it.
  BodyExpectation expectation(std::int64_t stamp_ns) const;

 private:
  using Measurement = std::variant<std::monostate, ImuSample, PoseMeasurement, FlowMeasurement>;
  struct Event {
    std::int64_t stamp_ns = 0;
    Measurement measurement;
    BodyState after;
    ImuSample imu;             // valid from here on
    bool imu_assumed = false;  // no sample was measured since the start
    bool accepted = true;
  };
  struct Innovation {
    Eigen::VectorXd residual;
    Eigen::MatrixXd H, R;
    Eigen::MatrixXd C;  // covariance of the state's error with the measurement's; empty: none
  };

  Outcome insert(std::int64_t stamp_ns, const Measurement& measurement);
  void replay(std::size_t from);
  BodyState predict(const Event& from, std::int64_t to_ns, const ImuSample& imu) const;
  std::optional<Innovation> innovation(const BodyState& state, const ImuSample& imu,
                                       const Measurement& measurement) const;
  bool correct(const Innovation& innovation, BodyState& state) const;
  void forget();

  ErrorStateFilterOptions options_;
  SE3 T_body_cam_;
  double floor_z_m_;
  std::deque<Event> events_;  // in order of time
};

}  // namespace placegraph
