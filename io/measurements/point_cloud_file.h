#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/measurements/point_cloud.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads a cloud in the format of the file's extension.
/// That is `.ply` (ascii or binary little endian, the properties x y z of its vertices, float or
/// double), `.bin` (KITTI: four float32 per point, x y z intensity), and otherwise text: `x y z`
/// per line, further columns are not read. The axes of the scan are kept. A point (0, 0, 0) has no
/// measurement and becomes NaN. Throws FileError, with the line in text, if the file is missing,
/// truncated, inconsistent with its own counts, has a number that is not finite or beyond 1e6, or
/// no point.
PointCloud read_point_cloud(const std::string& path);

/// The organised cloud of a depth image of a camera without distortion.
/// The image is CV_32FC1 [m], 0 where nothing was measured. `step_m`: quantization step of the
/// depths. Throws ArgumentError if the image does not have the camera's size.
PointCloud cloud_of_depth(const Image& depth, const Camera& camera, double step_m);

/// Reads one label per point.
/// It is the last column if the lines of a text file have four or more, or the only one. Throws
/// FileError for anything else.
std::vector<int> read_point_labels(const std::string& path);

}  // namespace placegraph
