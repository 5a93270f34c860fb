#pragma once
#include <placegraph/graph/pose_graph/bundle.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads a bundle adjustment problem in the BAL format.
///
/// "Bundle Adjustment in the Large" (Agarwal et al. 2010): the numbers of cameras, points and
/// observations; `camera point u v` [px] for every observation; nine numbers for every camera
/// (rotation vector and translation of T_cam_world, f [px], k1, k2); three for every point. Numbers
/// are separated by blanks or line ends. In the file the optical axis of a camera is -z, y points
/// up and v increases upwards; poses and pixels are converted to z forward, y and v downwards.
/// Throws FileError with the line: not a number, not finite, a negative count, an index beyond the
/// counts, a focal length that is not positive, too few or too many numbers.
Bundle read_bal(const std::string& path);

/// Writes a problem in the BAL format with 17 significant digits.
///
/// The file is replaced as a whole or not at all. Throws as Bundle::check, and FileError.
void write_bal(const std::string& path, const Bundle& bundle);

}  // namespace placegraph
