#pragma once
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The images `000000.*`, `000001.*`, ... of a folder, in order.
/// They are png, jpg, jpeg, pgm, ppm, bmp, tif and tiff; other files are ignored. Throws FileError
/// if the folder is missing or has none, or if a number between 0 and the last is missing or occurs
/// twice.
std::vector<std::string> list_numbered_images(const std::string& folder);

/// All images of a folder in the order of their names (sort_by_name).
/// Throws FileError if the folder is missing or has none (the message lists folders with images),
/// or if two names differ only in their extension.
std::vector<std::string> list_images(const std::string& folder);

/// Whether a folder has images.
bool holds_images(const std::string& folder);
/// Whether the name ends as those of images do, in upper or lower case.
bool has_image_extension(const std::string& path);

/// How many images there are in a folder and its subfolders, as text.
/// "60 images in images/, 60 images in depth/", for messages about images in an unexpected place.
/// Empty if there are none.
std::string images_around(const std::string& folder);

}  // namespace placegraph
