#pragma once
#include <placegraph/graph/geometry/so3.h>
#include <placegraph/graph/measurements/imu.h>

#include <Eigen/Core>

namespace placegraph {

/// Inertial samples between two times, integrated independently of the state at the first.
/// The result is the change of position, velocity and attitude in the body's frame at the first
/// time, without gravity and without the initial velocity (Forster et al. 2017, "On-manifold
/// preintegration for real-time visual-inertial odometry"). Rates and specific forces are constant
/// in the body frame between samples.
class ImuPreintegration {
 public:
  using Matrix9d = Eigen::Matrix<double, 9, 9>;

  /// Starts an integration with these biases; change() corrects for other biases to first order.
  ImuPreintegration(const Eigen::Vector3d& gyro_bias, const Eigen::Vector3d& accel_bias,
                    const ImuNoise& noise)
      : gyro_bias_(gyro_bias), accel_bias_(accel_bias), noise_(noise) {}

  /// Adds the sensor's rate and specific force over the next `dt` > 0 seconds.
  void add(const Eigen::Vector3d& gyro_rad_s, const Eigen::Vector3d& accel_m_s2, double dt);

  double duration_s() const { return duration_s_; }
  const Eigen::Vector3d& gyro_bias() const { return gyro_bias_; }
  const Eigen::Vector3d& accel_bias() const { return accel_bias_; }

  /// The integrated change at given biases.
  struct Change {
    Eigen::Vector3d position, velocity;
    SO3 rotation;
  };
  Change change(const Eigen::Vector3d& gyro_bias, const Eigen::Vector3d& accel_bias) const;

  /// Derivative of (position, velocity, attitude as right tangent) by (gyro bias, accelerometer
  /// bias).
  const Eigen::Matrix<double, 9, 6>& by_bias() const { return by_bias_; }
  /// Covariance of (position, velocity, attitude) from the sensor's white noise.
  const Matrix9d& covariance() const { return covariance_; }
  const ImuNoise& noise() const { return noise_; }

 private:
  Eigen::Vector3d gyro_bias_, accel_bias_;
  ImuNoise noise_;
  double duration_s_ = 0;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), velocity_ = Eigen::Vector3d::Zero();
  SO3 rotation_;
  Eigen::Matrix<double, 9, 6> by_bias_ = Eigen::Matrix<double, 9, 6>::Zero();
  Matrix9d covariance_ = Matrix9d::Zero();
};

}  // namespace placegraph
