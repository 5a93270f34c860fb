#pragma once
#include <placegraph/graph/measurements/imu.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What an inertial sensor recorded, and its noise.
struct ImuRecording {
  double rate_hz = 0;              ///< nominal rate of the samples [Hz], positive
  ImuNoise noise;                  ///< densities of white noise and of the biases' random walks
  std::vector<ImuSample> samples;  ///< stamps strictly increasing
};

/// Reads the recording of an inertial sensor from a folder in EuRoC's form (`mav0/imu0`).
///
/// `data.csv` holds t_ns, gyro x y z [rad/s], accelerometer x y z [m/s^2] per line, `sensor.yaml`
/// holds T_BS, rate and noise densities. Throws FileError with file and line for lines that are cut
/// off, values that are not finite, stamps that do not increase, a sensor that is not in the body's
/// origin and axes, and a file without samples.
ImuRecording read_imu(const std::string& folder);

/// Writes both files into the folder, which is created where missing. Throws FileError.
void write_imu(const std::string& folder, const ImuRecording& recording);

}  // namespace placegraph
