#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/measurements/imu.h>

namespace placegraph {

struct PositionFilterOptions {
  double gyro_noise = 2e-3;          ///< [rad / s / sqrt(Hz)]
  double accel_noise = 2e-2;         ///< [m / s^2 / sqrt(Hz)]
  double gyro_bias_walk = 2e-5;      ///< [rad / s^2 / sqrt(Hz)]
  double accel_bias_walk = 5e-4;     ///< [m / s^3 / sqrt(Hz)]
  double gate = 0.999;               ///< a measurement less likely than that is not believed
  double history_s = 0.5;            ///< a measurement that comes later than that is refused
  double max_prediction_s = 0.25;    ///< beyond the last inertial sample
  double ahead_rotation_rad_s2 = 3;  ///< how the body may begin to turn beyond it
  double ahead_push_m_s3 = 5;        ///< how the force on it may change beyond it
  double max_position_sigma_m = 1;   ///< a position less sure than that is no answer
  void check() const;
};
void visit(OptionVisitor& field, PositionFilterOptions& options);

struct InertialWindowOptions {
  ImuNoise noise{2e-3, 2e-2, 2e-5, 5e-4};  ///< as PositionFilterOptions has them
  int max_states = 20;                     ///< the oldest is marginalized beyond this
  int max_iterations = 4;
  double gate = 0.999;             ///< a measurement less likely than that is not believed
  double max_prediction_s = 0.25;  ///< beyond the last inertial sample
  void check() const;
};
void visit(OptionVisitor& field, InertialWindowOptions& options);

}  // namespace placegraph
