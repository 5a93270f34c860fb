#pragma once
#include <placegraph/graph/image/image.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// A picture from a file: `grey` CV_8UC1, and `colour` CV_8UC3 BGR where the file has colour.
struct GreyAndColour {
  Image grey, colour;
};

/// Reads PNG or JPEG, and by the module of picture_plugin.h PGM/PPM, TIFF or BMP; pixels as stored
/// (EXIF orientation is not applied). Of a file of 16 bits the upper eight of `bits` are kept.
/// Throws FileError if the file is missing, truncated, no image, or under 4 px high or wide.
GreyAndColour read_image(const std::string& path, int bits = 16);

/// Channels and depth as in the file. Throws like `read_image`.
Image read_image_as_stored(const std::string& path);

/// Reads a 16-bit depth image into CV_32FC1 metres: value * unit_m; 0 and 65535 (nothing measured)
/// become 0. Throws FileError, also if the file has another pixel type.
Image read_depth(const std::string& path, double unit_m);

/// Writes an 8 or 16-bit grey, BGR or BGRA image as the extension of `path` says, atomically.
/// Throws FileError if the file cannot be written or no format has the extension.
void write_image(const std::string& path, const Image& image);

/// The grey version of a BGR or grey image; grey ones are shared, not copied.
Image to_grey(const Image& image);

/// Throws FileError unless the image is `width` x `height`.
void require_size(const std::string& path, const Image& image, int width, int height);

}  // namespace placegraph
