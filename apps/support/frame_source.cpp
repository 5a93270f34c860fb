#include "apps/support/frame_source.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>

#include <filesystem>

namespace placegraph::apps {
namespace {

/// The images of a folder that is no data set; empty if it has none.
std::vector<std::string> bare_images(const std::string& path) {
  namespace fs = std::filesystem;
  for (const char* mark : {"mav0", "rgb.txt", "calib.txt", "calibration.yaml"})
    if (fs::exists(fs::path(path) / mark)) return {};
  if (!fs::is_directory(path)) return {};
  try {
    return list_images(path);
  } catch (const FileError&) {
    return {};
  }
}

}  // namespace

FrameSource::FrameSource(const std::string& path) : images_(bare_images(path)) {
  if (images_.empty())
    dataset_ = open_dataset(path);
  else
    first_ = read_image(images_.front()).grey;
}

std::optional<Camera> FrameSource::camera() const {
  if (!dataset_) return std::nullopt;
  return dataset_->calibration(Sensor::kMono).camera;
}

std::optional<std::int64_t> FrameSource::stamp_ns(std::size_t index) const {
  if (!dataset_) return std::nullopt;
  return dataset_->stamp_ns(index);
}

Image FrameSource::image(std::size_t index) const {
  if (dataset_) return dataset_->frame(index, Sensor::kMono).image;
  const Image image = read_image(images_.at(index)).grey;
  require_size(images_[index], image, first_.cols, first_.rows);
  return image;
}

}  // namespace placegraph::apps
