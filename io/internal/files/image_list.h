#pragma once
#include <string>
#include <vector>

namespace placegraph {

/// The images `000000.*`, `000001.*`, ... of a folder (png, jpg, jpeg, pgm, ppm, bmp, tif, tiff),
/// in order; other files are ignored. Throws FileError if the folder is missing or has none, a
/// number is missing between 0 and the last, or one is there twice.
std::vector<std::string> list_numbered_images(const std::string& folder);

/// All images of a folder in the order of their names (sort_by_name). Throws FileError if the
/// folder is missing or has none, which says where there are some, or if two differ in their
/// extension alone.
std::vector<std::string> list_images(const std::string& folder);

bool holds_images(const std::string& folder);

/// "60 images in images/, 60 images in depth/", of a folder and those inside it: for messages where
/// images were expected elsewhere. Empty if there are none.
std::string images_around(const std::string& folder);

}  // namespace placegraph
