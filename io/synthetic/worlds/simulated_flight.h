#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/measurements/body_state.h>
#include <placegraph/io/sensors/imu_file.h>

#include <cstdint>
#include <vector>

namespace placegraph::synthetic {

struct SimulatedFlightOptions {
  std::uint64_t seed = 1;
  double duration_s = 120;
  double wind_mps = 1;  ///< sigma of gusts and of the mean wind along each horizontal axis
  ImuNoise noise{.gyro = 3e-4, .accel = 4e-3, .gyro_bias_walk = 2e-5, .accel_bias_walk = 4e-4};
  double gyro_bias_sigma = 0.01;   ///< sigma of the initial bias [rad/s]
  double accel_bias_sigma = 0.08;  ///< sigma of the initial bias [m/s^2]
  void check() const;
};
void visit(OptionVisitor& field, SimulatedFlightOptions& options);

/// A flight with its true states and its inertial measurements. World: z up, floor z = 0.
struct SimulatedFlight {
  static constexpr double kImuHz = 200, kImageHz = 20;
  std::vector<BodyState> truth;  ///< at every inertial sample, with the biases of that moment
  std::vector<Eigen::Vector3d> angular_velocity;  ///< [rad/s], body axes, at every inertial sample
  ImuRecording imu;
  std::vector<std::size_t> images;  ///< indices of the samples with an image

  const BodyState& at_image(std::size_t index) const { return truth[images[index]]; }
};

/// Simulates a quadrotor (rigid body; thrust along its z, motors that lag, drag of the air) that a
/// controller keeps on a path between points over the middle of the floor, one to two metres high,
/// and out to positions three to four metres off, where it stays a while. Gusts are first-order
/// processes as Dryden's longitudinal one (MIL-F-8785C), on a mean wind that changes slowly. The
/// controller uses the true state (geometric tracking, Lee, Leok & McClamroch 2010). Steps of 1 ms.
SimulatedFlight simulate_flight(const SimulatedFlightOptions& options);

}  // namespace placegraph::synthetic
