#pragma once
#include <placegraph/graph/image/image.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// A picture that was read from a file.
struct GreyAndColour {
  Image grey, colour;  ///< CV_8UC1; CV_8UC3 in BGR, empty where the file has no colour
};

/// Reads a picture as 8-bit grey and, where the file has it, colour.
///
/// PNG and JPEG are read by the library itself; PGM/PPM, TIFF and BMP need its picture plug-in.
/// EXIF orientation is not applied. Of a 16-bit file that uses `bits` bits (8 to 16) the upper
/// eight of them are kept. Throws FileError if the file is missing, truncated, no image, or under 4
/// px high or wide.
GreyAndColour read_image(const std::string& path, int bits = 16);

/// Reads a picture with the channels and bits per channel that the file has.
///
/// Throws FileError if the file is missing, truncated or no image.
Image read_image_as_stored(const std::string& path);

/// Reads a 16-bit depth image into CV_32FC1 [m]: value * unit_m.
///
/// 0 and 65535 (nothing measured) become 0. Throws FileError as read_image_as_stored, and if the
/// file has another pixel type.
Image read_depth(const std::string& path, double unit_m);

/// Writes an 8 or 16-bit grey, BGR or BGRA image in the format of the path's extension.
///
/// The file is replaced as a whole or not at all. Throws FileError if the file cannot be written or
/// no format has the extension.
void write_image(const std::string& path, const Image& image);

/// Converts a BGR image to grey; a grey image is returned as it is, sharing its pixels.
Image to_grey(const Image& image);

/// Throws FileError, naming `path`, unless the image is `width` x `height` [px].
void require_size(const std::string& path, const Image& image, int width, int height);

}  // namespace placegraph
