#pragma once
#include <placegraph/graph/pose_graph/bundle.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads a problem of "Bundle Adjustment in the Large" (Agarwal et al. 2010): the numbers of
/// cameras, points and observations; `camera point u v` for every observation; nine numbers for
/// every camera (rotation vector and translation of T_cam_world, f, k1, k2); three for every point.
/// Numbers are separated by blanks or line ends. There the camera looks along -z with y up and v
/// counts upwards; here it looks along z with y down and v counts downwards: both are turned over.
/// Throws FileError with the line: not a number, not finite, a negative count, an index beyond the
/// counts, a focal length that is not positive, too few or too many numbers.
Bundle read_bal(const std::string& path);

/// Writes the same form with 17 significant digits, atomically. Throws as Bundle::check.
void write_bal(const std::string& path, const Bundle& bundle);

}  // namespace placegraph
