#pragma once
#include <placegraph/graph/measurements/measured_motion.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads the motion of a body that wheels, a laser or inertial sensors measured.
///
/// A file (docs/odometry.md) has one kind of line, told by the number of its fields; `#` begins a
/// comment:
///
///     8   t tx ty tz qx qy qz qw               stamped poses (TUM), noise as `noise` says
///     12  row-major 3x4 (KITTI)                poses of the frames `stamps_ns`, likewise
///     14  t pose  6 standard deviations        of the step from the line before
///     29  t pose  21 numbers                   its covariance, upper triangle by rows
///     9   t_from t_to  pose                    steps, noise as `noise` says
///     15  t_from t_to  pose  6 standard deviations
///     30  t_from t_to  pose  21 numbers
///
/// Times [s] are on the clock of the frames. The order of the tangent is translation [m],
/// rotation [rad], in the frame at the step's end. `stamps_ns` are the times of the images and are
/// needed for KITTI lines only. Throws FileError with file:line: another or a changing number of
/// fields, no number, a step longer than 1e9 m, times that do not increase, a quaternion not of
/// unit length (1e-2), a standard deviation that is not positive, a covariance that is not positive
/// definite, fewer than one step, KITTI lines that are not as many as frames.
MeasuredMotion read_odometry(const std::string& path, const MotionNoise& noise,
                             const std::vector<std::int64_t>& stamps_ns);

}  // namespace placegraph
