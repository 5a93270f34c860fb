#pragma once
#include <placegraph/graph/image/image.h>
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/map/map_options.h>

#include <cstddef>
#include <cstdint>
#include <functional>

namespace [[gnu::visibility("default")]] placegraph {

/// Builds a map from appearance alone, from images without a camera.
///
/// Each image is a keyframe with its view, and a place is a sequence of images that resemble its
/// first one. Its poses are meaningless, and it has no calibration; MapLocalizer places images in
/// it. `image(i)`: grey or
/// BGR, the same for all images; `first` is the frame number of the first image. Throws
/// ArgumentError for fewer than ten images.
StoredMap learn_map(std::size_t count, const std::function<Image(std::size_t)>& image,
                    std::int64_t first, const MapLearnerOptions& options);

}  // namespace placegraph
