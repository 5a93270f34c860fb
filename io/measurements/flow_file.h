#pragma once
#include <placegraph/graph/image/image.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads optical flow from a file, CV_32FC2 with (du, dv) in pixels, NaN where unknown.
/// The extension determines the format: `.flo`, Middlebury's (little-endian floats; above 1e9 in
/// magnitude: unknown), or `.png`, KITTI's (16 bits, three channels: 64 u + 2^15, 64 v + 2^15, 1
/// where valid). Throws FileError if the file is missing, truncated, or in another format.
Image read_flow(const std::string& path);

/// Writes flow in the format of its extension, to a temporary name that is renamed.
/// KITTI's format rounds to 1/64 px and leaves out flow beyond 512 px. Throws ArgumentError for
/// another extension or another type of image, FileError if it cannot be written.
void write_flow(const std::string& path, const Image& flow);

/// Throws ArgumentError unless `write_flow` supports the extension of `path`.
void require_flow_extension(const std::string& path);

/// Converts CV_32FC2 to KITTI's format in OpenCV's order of channels (valid, v, u), CV_16UC3.
Image encode_kitti_flow(const Image& flow);

}  // namespace placegraph
