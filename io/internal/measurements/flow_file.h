#pragma once
#include <placegraph/graph/image/image.h>

#include <string>

namespace placegraph {

/// Optical flow from a file, CV_32FC2 with (du, dv) in pixels, NaN where unknown. The extension
/// tells the form: `.flo`, Middlebury's (little-endian floats; beyond 1e9 in size: unknown), or
/// `.png`, KITTI's (16 bits, three channels: 64 u + 2^15, 64 v + 2^15, 1 where valid). Throws
/// FileError if the file is missing, truncated, or not of that form.
Image read_flow(const std::string& path);

/// Writes it in the form its extension names, to a temporary name that is renamed. KITTI's form
/// rounds to 1/64 px and leaves out what is beyond 512 px. Throws ArgumentError for another
/// extension or another type of image, FileError if it cannot be written.
void write_flow(const std::string& path, const Image& flow);

/// Throws ArgumentError unless `write_flow` knows the extension of `path`.
void require_flow_extension(const std::string& path);

/// KITTI's form of CV_32FC2 as an image in OpenCV's order of channels (valid, v, u), CV_16UC3.
Image encode_kitti_flow(const Image& flow);

}  // namespace placegraph
