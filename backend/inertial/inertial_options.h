#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/measurements/imu.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Options of the error-state filter of a body.
struct ErrorStateFilterOptions {
  double gyro_noise = 2e-3;          ///< density of the gyroscope's noise [rad / s / sqrt(Hz)]
  double accel_noise = 2e-2;         ///< density of the accelerometer's noise [m / s^2 / sqrt(Hz)]
  double gyro_bias_walk = 2e-5;      ///< random walk of the bias [rad / s^2 / sqrt(Hz)]
  double accel_bias_walk = 5e-4;     ///< random walk of the bias [m / s^3 / sqrt(Hz)]
  double gate = 0.999;               ///< probability of the gate of a measurement's squared error
  double history_s = 0.5;            ///< maximum delay of a measurement; later ones are rejected
  double max_prediction_s = 0.25;    ///< longest prediction beyond the last inertial sample
  double ahead_rotation_rad_s2 = 3;  ///< assumed angular acceleration beyond it
  double ahead_push_m_s3 = 5;        ///< assumed change of the specific force beyond it
  double max_position_sigma_m = 1;   ///< maximum standard deviation of a returned position
  void check() const;
};
void visit(OptionVisitor& field, ErrorStateFilterOptions& options);

/// Options of the sliding window over states of a body.
struct InertialWindowOptions {
  ImuNoise noise{2e-3, 2e-2, 2e-5, 5e-4};  ///< defaults of ErrorStateFilterOptions
  int max_states = 20;                     ///< above this number the oldest is marginalized
  int max_iterations = 4;                  ///< of each optimization
  double gate = 0.999;             ///< probability of the gate of a measurement's squared error
  double max_prediction_s = 0.25;  ///< longest prediction beyond the last inertial sample
  void check() const;
};
void visit(OptionVisitor& field, InertialWindowOptions& options);

}  // namespace placegraph
