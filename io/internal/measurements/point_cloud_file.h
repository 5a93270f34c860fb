#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/internal/measurements/point_cloud.h>

#include <string>
#include <vector>

namespace placegraph {

/// Reads a cloud, by what the file is called: `.ply` (ascii or binary little endian, the properties
/// x y z of its vertices, float or double), `.bin` (KITTI: four float32 a point, x y z intensity),
/// and text otherwise: `x y z` a line, further columns are not read. The scan keeps its axes.
/// Throws FileError, with the line in text, if the file is missing, truncated, has other counts
/// than it says, a number that is not finite or beyond 1e6, or no point.
PointCloud read_point_cloud(const std::string& path);

/// An organised cloud of a depth image (CV_32FC1 metres, 0 where nothing was measured) of a camera
/// without distortion. `step_m`: what its depths are multiples of. Throws ArgumentError if the
/// image is not the camera's size.
PointCloud cloud_of_depth(const Image& depth, const Camera& camera, double step_m);

/// One label a point: the last column of the lines of a text file that has four or more, or the
/// only one. Throws FileError for anything else.
std::vector<int> read_point_labels(const std::string& path);

}  // namespace placegraph
