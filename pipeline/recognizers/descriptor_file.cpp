#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/file_bytes.h>
#include <placegraph/pipeline/recognizers/descriptor_file.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

DescriptorFile::DescriptorFile(const std::string& path)
    : path_(path), rows_(read_npy(read_bytes(path), path)) {
  if (rows_.shape.size() != 2 || rows_.values.empty())
    throw FileError(path, "descriptors are a matrix with a row for every image");
  const auto wrong = std::ranges::find_if_not(
      rows_.values, [](double v) { return std::isfinite(static_cast<float>(v)); });
  if (wrong != rows_.values.end())
    throw FileError(
        path, fmt::format("row {} (from 0): a value is not finite",
                          static_cast<std::size_t>(wrong - rows_.values.begin()) / rows_.shape[1]));
}

std::vector<float> DescriptorFile::describe(const Image&, FrameId frame) {
  const auto row = static_cast<std::size_t>(frame.value());
  if (row >= rows_.shape[0])
    throw FileError(
        path_, fmt::format("has {} rows, and none for image {}", rows_.shape[0], frame.value()));
  const auto begin = rows_.values.begin() + static_cast<std::ptrdiff_t>(row * rows_.shape[1]);
  return {begin, begin + static_cast<std::ptrdiff_t>(rows_.shape[1])};
}

}  // namespace placegraph
