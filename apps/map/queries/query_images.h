#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/io/map/map_database.h>

#include <functional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Images to localize in a map, as taken by the map's camera.
struct QueryImages {
  std::size_t count = 0;
  std::int64_t first = 0;  ///< number of the first image in its folder
  /// The image with an index from 0 to count - 1. Throws FileError if it cannot be read.
  std::function<Frame(std::size_t)> frame;
  /// File name of an image; empty where images are not single files.
  std::function<std::string(std::size_t)> name;
  /// Remarks on the images and on their conversion to the map's camera.
  std::vector<std::string> notes;
};

/// Images of a sequence (open_dataset) or of a folder without a calibration.
/// Images of a sequence are undistorted and resampled to the camera of the map; those of a folder,
/// and all for a map without a camera, are taken as they are. `range` has the first and the last
/// number, or is empty for all. Throws FileError if a sequence is invalid, ArgumentError for a
/// range without images.
QueryImages query_images(const std::string& path, const std::vector<int>& range,
                         const MapOrigin& origin);

}  // namespace placegraph::apps
