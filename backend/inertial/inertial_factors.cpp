#include <placegraph/backend/inertial/covariance_matrix.h>
#include <placegraph/backend/inertial/inertial_factors.h>
#include <placegraph/backend/inertial/state_layout.h>

#include <Eigen/Cholesky>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

}  // namespace

BodyState moved(BodyState state, const StateStep& step) {
  state.T_world_body = SE3(state.T_world_body.rotation() * SO3::exp(step.segment<3>(kAttitude)),
                           Vector3d(state.T_world_body.translation() + step.segment<3>(kPosition)));
  state.velocity_world += step.segment<3>(kVelocity);
  state.gyro_bias += step.segment<3>(kGyroBias);
  state.accel_bias += step.segment<3>(kAccelBias);
  return state;
}

StateStep difference(const BodyState& from, const BodyState& to) {
  StateStep step;
  step << to.T_world_body.translation() - from.T_world_body.translation(),
      to.velocity_world - from.velocity_world,
      (from.T_world_body.rotation().inverse() * to.T_world_body.rotation()).log(),
      to.gyro_bias - from.gyro_bias, to.accel_bias - from.accel_bias;
  return step;
}

StateError inertial_error(const ImuPreintegration& motion, const BodyState& first,
                          const BodyState& second) {
  const double t = motion.duration_s();
  const auto change = motion.change(first.gyro_bias, first.accel_bias);
  const SO3 R_first = first.T_world_body.rotation();
  const Matrix3d to_first = R_first.matrix().transpose();
  const Vector3d translation =
      to_first * (second.T_world_body.translation() - first.T_world_body.translation() -
                  t * first.velocity_world - 0.5 * t * t * gravity());
  const Vector3d faster = to_first * (second.velocity_world - first.velocity_world - t * gravity());
  const SO3 R_first_second = R_first.inverse() * second.T_world_body.rotation();
  const Vector3d rotation_error = (change.rotation.inverse() * R_first_second).log();

  StateError error;
  error.r.resize(15);
  error.r << translation - change.position, faster - change.velocity, rotation_error,
      second.gyro_bias - first.gyro_bias, second.accel_bias - first.accel_bias;
  MatrixXd& J = error.J_first;
  J = MatrixXd::Zero(15, 15);
  J.block<3, 3>(kPosition, kPosition) = -to_first;
  J.block<3, 3>(kPosition, kVelocity) = -t * to_first;
  J.block<3, 3>(kPosition, kAttitude) = hat(translation);
  J.block<3, 3>(kVelocity, kVelocity) = -to_first;
  J.block<3, 3>(kVelocity, kAttitude) = hat(faster);
  J.block<6, 6>(kPosition, kGyroBias) = -motion.by_bias().topRows<6>();
  const Matrix3d rotation_inverse = SO3::right_jacobian_inverse(rotation_error);
  J.block<3, 3>(kAttitude, kAttitude) = -rotation_inverse * R_first_second.matrix().transpose();
  // The bias acts on the right of the preintegrated rotation, whose inverse is in the logarithm.
  const Vector3d off =
      motion.by_bias().bottomRows<3>().leftCols<3>() * (first.gyro_bias - motion.gyro_bias());
  J.block<3, 3>(kAttitude, kGyroBias) = -rotation_inverse * SO3::exp(-rotation_error).matrix() *
                                        SO3::right_jacobian(off) *
                                        motion.by_bias().bottomRows<3>().leftCols<3>();
  J.block<3, 3>(kGyroBias, kGyroBias) = -Matrix3d::Identity();
  J.block<3, 3>(kAccelBias, kAccelBias) = -Matrix3d::Identity();
  MatrixXd& K = error.J_second;
  K = MatrixXd::Zero(15, 15);
  K.block<3, 3>(kPosition, kPosition) = to_first;
  K.block<3, 3>(kVelocity, kVelocity) = to_first;
  K.block<3, 3>(kAttitude, kAttitude) = rotation_inverse;
  K.block<6, 6>(kGyroBias, kGyroBias).setIdentity();

  MatrixXd covariance = MatrixXd::Zero(15, 15);
  covariance.topLeftCorner<9, 9>() = motion.covariance();
  const ImuNoise& noise = motion.noise();
  // A lower bound keeps the information finite for biases without random walk.
  constexpr double kLeastWalk = 1e-9;
  const auto walk = [&](double density) {
    return Matrix3d(std::pow(std::max(density, kLeastWalk), 2) * t * Matrix3d::Identity());
  };
  covariance.block<3, 3>(kGyroBias, kGyroBias) = walk(noise.gyro_bias_walk);
  covariance.block<3, 3>(kAccelBias, kAccelBias) = walk(noise.accel_bias_walk);
  error.information = symmetric_inverse(covariance);
  return error;
}

StateError pose_error(const PoseMeasurement& observation, const BodyState& state) {
  const Matrix3d to_seen = observation.T_world_body.rotation().matrix().transpose();
  const Vector3d translation =
      to_seen * (state.T_world_body.translation() - observation.T_world_body.translation());
  const Vector3d rotation_error =
      (observation.T_world_body.rotation().inverse() * state.T_world_body.rotation()).log();
  StateError error;
  error.r.resize(6);
  error.r << translation, rotation_error;
  error.J_first = MatrixXd::Zero(6, 15);
  error.J_first.block<3, 3>(0, kPosition) = to_seen;
  error.J_first.block<3, 3>(3, kAttitude) = SO3::right_jacobian_inverse(rotation_error);
  error.information = symmetric_inverse(observation.covariance);
  return error;
}

std::optional<StateError> flow_error(const FlowMeasurement& observation, const SE3& T_body_cam,
                                     double floor_z_m, const BodyState& first,
                                     const BodyState& second) {
  const Vector3d arm = T_body_cam.translation();
  const Matrix3d R_cam_body = T_body_cam.rotation().matrix().transpose();
  const Matrix3d R_first = first.T_world_body.rotation().matrix();
  const Matrix3d R_second = second.T_world_body.rotation().matrix();
  const Vector3d begin = first.T_world_body * arm, end = second.T_world_body * arm;
  const double height = begin.z() - floor_z_m;
  // Keeps the quotient finite. Chosen.
  constexpr double kLeastHeight_m = 0.01;
  if (!(height > kLeastHeight_m)) return std::nullopt;
  const Vector3d translation = R_first.transpose() * (end - begin);
  const Vector3d flow = R_cam_body * translation / height;
  StateError error;
  error.r = flow - observation.over_distance;
  error.J_first = MatrixXd::Zero(3, 15);
  error.J_second = MatrixXd::Zero(3, 15);
  const Matrix3d to_flow = R_cam_body / height;
  error.J_first.block<3, 3>(0, kPosition) = -to_flow * R_first.transpose();
  // The lever arm of the camera and the axes of the translation rotate with the body.
  error.J_first.block<3, 3>(0, kAttitude) = to_flow * (hat(translation) + hat(arm));
  error.J_second.block<3, 3>(0, kPosition) = to_flow * R_first.transpose();
  error.J_second.block<3, 3>(0, kAttitude) = -to_flow * R_first.transpose() * R_second * hat(arm);
  const Vector3d by_height = -flow / height;
  error.J_first.col(kPosition + 2) += by_height;
  error.J_first.block<3, 3>(0, kAttitude) += by_height * (-R_first * hat(arm)).row(2);
  if (observation.J_rotation) {
    const SO3 R_body_cam = T_body_cam.rotation();
    const SO3 R_states = R_body_cam.inverse() * first.T_world_body.rotation().inverse() *
                         second.T_world_body.rotation() * R_body_cam;
    const Vector3d wrong = (R_states.inverse() * observation.R_from_to).log();
    error.r += *observation.J_rotation * wrong;
    error.J_first.block<3, 3>(0, kAttitude) +=
        *observation.J_rotation * SO3::right_jacobian_inverse(wrong) *
        observation.R_from_to.matrix().transpose() * R_cam_body;
    error.J_second.block<3, 3>(0, kAttitude) -=
        *observation.J_rotation * SO3::right_jacobian_inverse(Vector3d(-wrong)) * R_cam_body;
  }
  error.information = symmetric_inverse(observation.covariance);
  return error;
}

}  // namespace placegraph
