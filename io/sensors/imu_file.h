#pragma once
#include <placegraph/graph/measurements/imu.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What an inertial sensor recorded, and how it errs.
struct ImuRecording {
  double rate_hz = 0;
  ImuNoise noise;
  std::vector<ImuSample> samples;  ///< stamps strictly increasing
};

/// Reads a folder in EuRoC's form (`mav0/imu0`): `data.csv` with t_ns, gyro x y z [rad/s],
/// accelerometer x y z [m/s^2] a line, and `sensor.yaml` with T_BS, rate and noise densities.
/// Throws FileError with file and line for lines that are cut off, values that are not finite,
/// stamps that do not increase, a sensor that is not in the body's origin and axes, and where no
/// sample is there.
ImuRecording read_imu(const std::string& folder);

/// Writes both files into the folder, which is made where missing. Throws FileError.
void write_imu(const std::string& folder, const ImuRecording& recording);

}  // namespace placegraph
