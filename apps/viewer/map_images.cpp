#include "apps/viewer/map_images.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/internal/image/jpeg_codec.h>
#include <placegraph/io/datasets/open_dataset.h>

#include "apps/viewer/jpeg_url.h"

namespace placegraph::apps {

MapImages::MapImages(const MapOrigin& origin)
    : sequence_(origin.sequence),
      sensor_(origin.sensor),
      lens_(origin.calibration.value_or(Calibration())) {
  if (origin.lens_k1 != 0) lens_.add(origin.lens_k1);
}

std::string MapImages::jpeg(FrameId frame) {
  const std::lock_guard lock(mutex_);
  if (!dataset_) dataset_ = open_dataset(sequence_);
  const std::int64_t index = frame.value();
  require(index >= 0 && index < static_cast<std::int64_t>(dataset_->size()),
          fmt::format("the recording has no frame {}", index));
  Frame read = dataset_->frame(static_cast<std::size_t>(index), sensor_);
  lens_.apply(read);
  return encode_jpeg(read.colour.empty() ? read.image : read.colour, kJpegQuality);
}

}  // namespace placegraph::apps
