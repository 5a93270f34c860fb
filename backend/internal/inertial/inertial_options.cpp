#include <placegraph/backend/internal/inertial/inertial_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

void PositionFilterOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PositionFilterOptions& o) {
  field("gyro_noise", o.gyro_noise, "rad/s per root of a hertz", {1e-9, 1});
  field("accel_noise", o.accel_noise, "m/s^2 per root of a hertz", {1e-9, 10});
  field("gyro_bias_walk", o.gyro_bias_walk, "rad/s^2 per root of a hertz", {0, 1});
  field("accel_bias_walk", o.accel_bias_walk, "m/s^3 per root of a hertz", {0, 10});
  field("gate", o.gate, "a measurement less likely than one minus this is not believed",
        {0.5, 0.999999});
  field("history_s", o.history_s, "measurements that come later than that are refused", {0, 60});
  field("max_prediction_s", o.max_prediction_s, "beyond the last inertial sample", {0, 10});
  field.formerly("ahead_turn_rad_s2")("ahead_rotation_rad_s2", o.ahead_rotation_rad_s2,
        "angular acceleration beyond the last sample", {0, 1000});
  field("ahead_push_m_s3", o.ahead_push_m_s3, "change of the force beyond the last sample",
        {0, 1000});
  field("max_position_sigma_m", o.max_position_sigma_m, "a position less sure is no answer",
        {1e-3, 1e6});
}

void InertialWindowOptions::check() const {
  check_ranges(*this);
  for (const double density : {noise.gyro, noise.accel})
    require(density > 0 && std::isfinite(density), "noise: white noise must be positive");
  for (const double walk : {noise.gyro_bias_walk, noise.accel_bias_walk})
    require(walk >= 0 && std::isfinite(walk), "noise: the walk of a bias is not negative");
}

void visit(OptionVisitor& field, InertialWindowOptions& o) {
  field("max_states", o.max_states, "the oldest is marginalized beyond this", {2, 1000});
  field("max_iterations", o.max_iterations, "of Gauss-Newton where the states are asked for",
        {1, 100});
  field("gate", o.gate, "a measurement less likely than one minus this is not believed",
        {0.5, 0.999999});
  field("max_prediction_s", o.max_prediction_s, "beyond the last inertial sample", {0, 10});
}

}  // namespace placegraph
