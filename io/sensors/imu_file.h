#pragma once
#include <placegraph/graph/measurements/imu.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A recording of an inertial sensor, with its noise.
struct ImuRecording {
  double rate_hz = 0;              ///< nominal rate of the samples [Hz], positive
  ImuNoise noise;                  ///< densities of white noise and of the biases' random walks
  std::vector<ImuSample> samples;  ///< stamps strictly increasing
};

/// Reads the recording of an inertial sensor from a folder in EuRoC's format (`mav0/imu0`).
///
/// `data.csv` contains t_ns, gyro x y z [rad/s], accelerometer x y z [m/s^2] per line,
/// `sensor.yaml` contains T_BS, rate and noise densities. Throws FileError with file and line for
/// truncated lines, values that are not finite, stamps that do not increase, a sensor frame that
/// differs from the body frame, and a file without samples.
ImuRecording read_imu(const std::string& folder);

/// Writes both files into the folder, which is created if it is missing. Throws FileError.
void write_imu(const std::string& folder, const ImuRecording& recording);

}  // namespace placegraph
