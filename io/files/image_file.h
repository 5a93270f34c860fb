#pragma once
#include <placegraph/graph/image/image.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// An image that was read from a file, as grey and as colour.
struct GreyAndColour {
  Image grey, colour;  ///< CV_8UC1; CV_8UC3 in BGR, empty where the file has no colour
};

/// Reads an image as 8-bit grey and, if the file has colour, as BGR.
///
/// PNG and JPEG are read by the library itself; PGM/PPM, TIFF and BMP need its picture plug-in.
/// EXIF orientation is not applied. If a 16-bit file uses only `bits` bits (8 to 16), the upper
/// eight of these are kept. Throws FileError if the file is missing, truncated, not an image, or
/// less than 4 px high or wide.
GreyAndColour read_image(const std::string& path, int bits = 16);

/// Reads an image with the channels and bits per channel of the file.
///
/// Throws FileError if the file is missing, truncated or not an image.
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
