#include "apps/support/image_range.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>

#include <filesystem>

namespace placegraph::apps {

std::string image_folder_of(const std::string& folder) {
  for (const char* name : {"images", "image_0"}) {
    const std::filesystem::path inside = std::filesystem::path(folder) / name;
    if (std::filesystem::is_directory(inside)) return inside.string();
  }
  return folder;
}

std::pair<std::int64_t, std::int64_t> selected_range(const std::vector<int>& range,
                                                     std::size_t count) {
  const auto last = static_cast<std::int64_t>(count) - 1;
  if (range.empty()) return {0, last};
  require(range.size() == 2 && range[0] >= 0 && range[0] <= range[1] && range[1] <= last,
          fmt::format("--range: two numbers of images needed, from 0 to {}", last));
  return {range[0], range[1]};
}

ImageRange images_of(const std::string& folder, const std::vector<int>& range) {
  ImageRange images{list_images(image_folder_of(folder)), 0};
  const auto [first, last] = selected_range(range, images.paths.size());
  images.first = first;
  images.paths = {images.paths.begin() + first, images.paths.begin() + last + 1};
  return images;
}

Frame read_frame(const ImageRange& images, std::size_t index) {
  const GreyAndColour image = read_image(images.paths.at(index));
  Frame frame;
  frame.stamp_ns = images.first + static_cast<std::int64_t>(index);
  frame.id = FrameId(frame.stamp_ns);
  frame.image = image.grey;
  frame.colour = image.colour;
  return frame;
}

}  // namespace placegraph::apps
