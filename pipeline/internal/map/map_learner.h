#pragma once
#include <placegraph/frontend/internal/places/place_view.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/pipeline/map/map_options.h>

#include <functional>

namespace placegraph {

/// A map by appearance alone, of images without any camera: each image is a keyframe with its view,
/// a place is a stretch of images that look like its first one. No pose of it means anything, and
/// it has no calibration; MapLocalizer places images in it. `image(i)`: grey or BGR, all alike;
/// `first` is the number that the first image has as a frame. Throws ArgumentError for fewer than
/// ten images.
StoredMap learn_map(std::size_t count, const std::function<Image(std::size_t)>& image,
                    std::int64_t first, const MapLearnerOptions& options);

}  // namespace placegraph
