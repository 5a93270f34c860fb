#include <placegraph/backend/inertial/imu_preintegration.h>
#include <placegraph/backend/inertial/state_layout.h>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

}  // namespace

void ImuPreintegration::add(const Vector3d& gyro_rad_s, const Vector3d& accel_m_s2, double dt) {
  const Vector3d step_rotation = (gyro_rad_s - gyro_bias_) * dt;
  const Vector3d force = accel_m_s2 - accel_bias_;
  // The specific force is rotated by the attitude at mid-step.
  const Matrix3d R = (rotation_ * SO3::exp(0.5 * step_rotation)).matrix();
  const Vector3d accel = R * force;
  const Matrix3d by_attitude = -R * hat(force);
  const Matrix3d rotated_back = SO3::exp(-step_rotation).matrix();
  const Matrix3d half_back = SO3::exp(-0.5 * step_rotation).matrix();
  const Matrix3d by_gyro = -dt * SO3::right_jacobian(step_rotation);
  const Matrix3d half_by_gyro = -0.5 * dt * SO3::right_jacobian(0.5 * step_rotation);

  Matrix9d F = Matrix9d::Identity();
  F.block<3, 3>(kPosition, kVelocity) = dt * Matrix3d::Identity();
  F.block<3, 3>(kPosition, kAttitude) = 0.5 * dt * dt * by_attitude * half_back;
  F.block<3, 3>(kVelocity, kAttitude) = dt * by_attitude * half_back;
  F.block<3, 3>(kAttitude, kAttitude) = rotated_back;
  Eigen::Matrix<double, 9, 6> B = Eigen::Matrix<double, 9, 6>::Zero();
  B.block<3, 3>(kPosition, 0) = 0.5 * dt * dt * by_attitude * half_by_gyro;
  B.block<3, 3>(kVelocity, 0) = dt * by_attitude * half_by_gyro;
  B.block<3, 3>(kAttitude, 0) = by_gyro;
  B.block<3, 3>(kPosition, 3) = -0.5 * dt * dt * R;
  B.block<3, 3>(kVelocity, 3) = -dt * R;
  by_bias_ = F * by_bias_ + B;

  const double gyro = noise_.gyro * noise_.gyro * dt, accel_v = noise_.accel * noise_.accel * dt;
  Matrix9d Q = Matrix9d::Zero();
  Q.block<3, 3>(kPosition, kPosition) = accel_v * dt * dt / 3 * Matrix3d::Identity();
  Q.block<3, 3>(kPosition, kVelocity) = accel_v * dt / 2 * Matrix3d::Identity();
  Q.block<3, 3>(kVelocity, kPosition) = accel_v * dt / 2 * Matrix3d::Identity();
  Q.block<3, 3>(kVelocity, kVelocity) = accel_v * Matrix3d::Identity();
  Q.block<3, 3>(kAttitude, kAttitude) = gyro * Matrix3d::Identity();
  covariance_ = F * covariance_ * F.transpose() + Q;

  position_ += dt * velocity_ + 0.5 * dt * dt * accel;
  velocity_ += dt * accel;
  rotation_ = rotation_ * SO3::exp(step_rotation);
  duration_s_ += dt;
}

ImuPreintegration::Change ImuPreintegration::change(const Vector3d& gyro_bias,
                                                    const Vector3d& accel_bias) const {
  Eigen::Matrix<double, 6, 1> off;
  off << gyro_bias - gyro_bias_, accel_bias - accel_bias_;
  const Eigen::Matrix<double, 9, 1> more = by_bias_ * off;
  return {position_ + more.segment<3>(kPosition), velocity_ + more.segment<3>(kVelocity),
          rotation_ * SO3::exp(more.segment<3>(kAttitude))};
}

}  // namespace placegraph
