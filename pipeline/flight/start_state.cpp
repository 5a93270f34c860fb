#include <placegraph/backend/inertial/state_layout.h>
#include <placegraph/pipeline/flight/start_state.h>

namespace placegraph {

BodyState start_state(const PoseMeasurement& pose, const FlightInitializationOptions& options,
                      const std::optional<BodyState>& before) {
  BodyState state;
  state.stamp_ns = pose.stamp_ns;
  state.T_world_body = pose.T_world_body;
  // The tangent's translation is in the axes of the body, the state's in those of the world.
  Matrix6d J = Matrix6d::Identity();
  J.topLeftCorner<3, 3>() = pose.T_world_body.rotation().matrix();
  const Matrix6d covariance = J * pose.covariance * J.transpose();
  constexpr int kPart[] = {kPosition, kAttitude};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      state.covariance.block<3, 3>(kPart[i], kPart[j]) = covariance.block<3, 3>(3 * i, 3 * j);
  const auto set_sigma = [&](int part, double sigma) {
    state.covariance.diagonal().segment<3>(part).setConstant(sigma * sigma);
  };
  set_sigma(kVelocity, options.velocity_sigma_mps);
  set_sigma(kGyroBias, options.gyro_bias_sigma);
  set_sigma(kAccelBias, options.accel_bias_sigma);
  if (!before) return state;
  state.gyro_bias = before->gyro_bias;
  state.accel_bias = before->accel_bias;
  state.covariance.bottomRightCorner<6, 6>() = before->covariance.bottomRightCorner<6, 6>();
  return state;
}

}  // namespace placegraph
