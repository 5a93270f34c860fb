#include <placegraph/backend/inertial/inertial_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void ErrorStateFilterOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, ErrorStateFilterOptions& o) {
  field("gyro_noise", o.gyro_noise, "noise density of the gyroscope [rad/s/sqrt(Hz)]", {1e-9, 1});
  field("accel_noise", o.accel_noise, "noise density of the accelerometer [m/s^2/sqrt(Hz)]",
        {1e-9, 10});
  field("gyro_bias_walk", o.gyro_bias_walk,
        "random walk of the gyroscope's bias [rad/s^2/sqrt(Hz)]", {0, 1});
  field("accel_bias_walk", o.accel_bias_walk,
        "random walk of the accelerometer's bias [m/s^3/sqrt(Hz)]", {0, 10});
  field("gate", o.gate, "probability of the gate of a measurement's squared error",
        {0.5, 0.999999});
  field("history_s", o.history_s, "maximum delay of a measurement; later ones are rejected [s]",
        {0, 60});
  field("max_prediction_s", o.max_prediction_s,
        "longest prediction beyond the last inertial sample [s]", {0, 10});
  field.formerly("ahead_turn_rad_s2")(
      "ahead_rotation_rad_s2", o.ahead_rotation_rad_s2,
      "angular acceleration assumed beyond the last sample [rad/s^2]", {0, 1000});
  field("ahead_push_m_s3", o.ahead_push_m_s3,
        "change of the specific force assumed beyond the last sample [m/s^3]", {0, 1000});
  field("max_position_sigma_m", o.max_position_sigma_m,
        "maximum standard deviation of a returned position [m]", {1e-3, 1e6});
}

void InertialWindowOptions::check() const {
  check_ranges(*this);
  for (const double density : {noise.gyro, noise.accel})
    require(density > 0 && std::isfinite(density), "noise: white noise must be positive");
  for (const double walk : {noise.gyro_bias_walk, noise.accel_bias_walk})
    require(walk >= 0 && std::isfinite(walk),
            "noise: the random walk of a bias must not be negative");
}

void visit(OptionVisitor& field, InertialWindowOptions& o) {
  field("max_states", o.max_states, "maximum number of states; above it the oldest is marginalized",
        {2, 1000});
  field("max_iterations", o.max_iterations,
        "maximum iterations of Gauss-Newton when the states are requested", {1, 100});
  field("gate", o.gate, "probability of the gate of a measurement's squared error",
        {0.5, 0.999999});
  field("max_prediction_s", o.max_prediction_s,
        "longest prediction beyond the last inertial sample [s]", {0, 10});
}

}  // namespace placegraph
