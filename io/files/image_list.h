#pragma once
#include <string>
#include <vector>

namespace placegraph {

/// The images `000000.*`, `000001.*`, ... of a folder (png, jpg, jpeg, pgm, ppm, bmp, tif, tiff),
/// in order; other files are ignored. Throws FileError if the folder is missing or has none, a
/// number is missing between 0 and the last, or one is there twice.
std::vector<std::string> list_numbered_images(const std::string& folder);

/// All images of a folder by name, runs of digits compared as numbers (img2 before img10). Throws
/// FileError if the folder is missing or has none.
std::vector<std::string> list_images(const std::string& folder);

}  // namespace placegraph
