#pragma once
#include <placegraph/graph/image/frame.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace placegraph::apps {

/// First and last index that `--range` selects of `count` images; all if it is empty.
/// Throws ArgumentError unless it has two ascending numbers below `count`.
std::pair<std::int64_t, std::int64_t> selected_range(const std::vector<int>& range,
                                                     std::size_t count);

/// Folder of the images: images/ or image_0/ in `folder` if there is one, else `folder`.
std::string image_folder_of(const std::string& folder);

/// The images of a folder (itself, or images/ or image_0/ in it) that `range` selects.
struct ImageRange {
  std::vector<std::string> paths;
  std::int64_t first = 0;
};
ImageRange images_of(const std::string& folder, const std::vector<int>& range);

/// Reads an image in grey and, if the file has it, in colour.
Frame read_frame(const ImageRange& images, std::size_t index);

}  // namespace placegraph::apps
