#pragma once
#include <placegraph/graph/measurements/frame.h>

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

/// `placegraph map learn`.
void add_map_learn_command(CLI::App& map);

/// The images of a folder (itself, or images/ or image_0/ in it) from number `range[0]` to
/// `range[1]`, all where it is empty. Throws ArgumentError for a range without images.
struct ImageRange {
  std::vector<std::string> paths;
  std::int64_t first = 0;
};
ImageRange images_of(const std::string& folder, const std::vector<int>& range);

/// Grey and, where the file has it, in colour.
Frame read_frame(const ImageRange& images, std::size_t index);

}  // namespace placegraph::apps
