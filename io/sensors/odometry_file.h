#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/measurements/measured_motion.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads the motion of a body as measured by wheels, a laser or inertial sensors.
///
/// A file (docs/other_sensors.md) has one kind of line, recognized by its number of fields; `#`
/// begins a comment:
///
///     8   t tx ty tz qx qy qz qw               stamped poses (TUM), noise from `noise`
///     12  row-major 3x4 (KITTI)                poses of the frames `stamps_ns`, noise likewise
///     14  t pose  6 standard deviations        for the step from the previous line
///     29  t pose  21 numbers                   its covariance, upper triangle by rows
///     9   t_from t_to  pose                    steps, noise from `noise`
///     15  t_from t_to  pose  6 standard deviations
///     30  t_from t_to  pose  21 numbers
///
/// Times [s] are on the clock of the frames. The order of the tangent is translation [m], rotation
/// [rad], in the frame at the step's end. `stamps_ns` are the times of the images and are needed
/// for KITTI lines only. Of poses with one time the first is kept, and `log` gets a warning. Throws
/// FileError with file:line: an unknown or changing number of fields, not a number, a step longer
/// than 1e9 m, times that go back, a quaternion not of unit length (1e-2), a standard deviation that
/// is not positive, a covariance that is not positive definite, fewer than one step, a number of
/// KITTI lines that differs from the number of frames.
MeasuredMotion read_odometry(const std::string& path, const MotionNoise& noise,
                             const std::vector<std::int64_t>& stamps_ns, const LogSink& log = {});

}  // namespace placegraph
