#pragma once
#include <placegraph/graph/internal/measurements/body_state.h>

#include <string>
#include <vector>

namespace placegraph {

/// Reads states as EuRoC's `state_groundtruth_estimate0/data.csv` holds them: t_ns, position [m],
/// quaternion (w first), velocity [m/s], gyro's bias [rad/s], accelerometer's bias [m/s^2], 17
/// numbers a line, in the order of their stamps. Their covariances are zero. Throws FileError with
/// file and line.
std::vector<BodyState> read_body_states(const std::string& path);

/// Writes that form; covariances are left out. Throws FileError.
void write_body_states(const std::string& path, const std::vector<BodyState>& states);

}  // namespace placegraph
