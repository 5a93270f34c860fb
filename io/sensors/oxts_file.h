#pragma once
#include <placegraph/graph/measurements/gps_fix.h>

#include <cstdint>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads the GPS/inertial readings (OXTS) of KITTI raw.
/// 30 numbers a reading, "lat lon alt roll pitch yaw vn ve vf vl vu ... pos_accuracy vel_accuracy"
/// and five states. `path` is - a drive's folder with `oxts/timestamps.txt` and
/// `oxts/data/0000000000.txt` ..., or that `oxts` folder itself: dates as UTC since 1970, - a file
/// NAME with one reading a line beside `times_NAME` (seconds, one a line), or a folder with
/// `oxts.txt` and `times_oxts.txt`. Attitude: R_enu_body = Rz(yaw) Ry(pitch) Rx(roll), yaw 0 =
/// east, body forward-left-up; velocity from it and the speeds forward, left, up. Throws FileError
/// with the line: missing, truncated, not 30 numbers, not finite, latitude or longitude out of
/// range, accuracy negative, times not increasing, more or fewer readings than times, none at all.
std::vector<GpsFix> read_oxts(const std::string& path);

/// Reads times of KITTI, strictly increasing, at least one.
/// They are seconds (times.txt) or dates "2011-09-26 13:02:25.594360375" (timestamps.txt),
/// interpreted as UTC since 1970. Throws FileError.
std::vector<std::int64_t> read_kitti_times(const std::string& path);

}  // namespace placegraph
