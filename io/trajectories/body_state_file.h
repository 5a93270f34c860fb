#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/measurements/body_state.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads states in the format of EuRoC's `state_groundtruth_estimate0/data.csv`.
/// A line has t_ns, position [m], quaternion (w first), velocity [m/s], gyro bias [rad/s],
/// accelerometer bias [m/s^2], 17 numbers per line, in the order of their stamps. Their covariances
/// are zero. Of states with one stamp the first is kept, and `log` gets a warning. Throws FileError
/// with file and line.
std::vector<BodyState> read_body_states(const std::string& path, const LogSink& log = {});

/// Writes states in that format; covariances are left out. Throws FileError.
void write_body_states(const std::string& path, const std::vector<BodyState>& states);

}  // namespace placegraph
