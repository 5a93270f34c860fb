#include "apps/support/frame_source.h"

#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>

namespace placegraph::apps {
FrameSource::FrameSource(const std::string& path) {
  try {
    dataset_ = open_dataset(path);
  } catch (const UnknownLayout&) {
    if (!holds_images(path)) throw;
    images_ = list_images(path);
    first_ = read_image(images_.front()).grey;
  }
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
