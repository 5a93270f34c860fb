#include "apps/viewer/map_images.h"

#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/report/served_page.h>

#include <filesystem>

namespace placegraph::apps {

MapImages::MapImages(const MapOrigin& origin)
    : sequence_(origin.sequence), sensor_(origin.sensor), lens_k1_(origin.lens_k1) {}

std::optional<std::string> MapImages::jpeg(FrameId frame) {
  const std::lock_guard lock(mutex_);
  if (!dataset_) {
    if (!std::filesystem::exists(sequence_)) return std::nullopt;
    dataset_ = open_dataset(sequence_);
    lens_.emplace(dataset_->calibration(sensor_));
    if (lens_k1_ != 0) lens_->add(lens_k1_);
  }
  const std::int64_t index = frame.value();
  if (index < 0 || index >= static_cast<std::int64_t>(dataset_->size())) return std::nullopt;
  const Frame read = dataset_->frame(static_cast<std::size_t>(index), sensor_);
  const Image& image = read.colour.empty() ? read.image : read.colour;
  return jpeg_of_page(lens_k1_ == 0 ? image : lens_->corrected(image));
}

}  // namespace placegraph::apps
