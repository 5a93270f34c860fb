#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/io/map/map_database.h>

#include <functional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Images that are to be placed in a map, as the map's camera would have taken them.
struct QueryImages {
  std::size_t count = 0;
  std::int64_t first = 0;                   ///< number of the first in its folder
  std::function<Frame(std::size_t)> frame;  ///< of 0 ... count - 1
  /// What is odd about them, and how they were made to fit the map's camera.
  std::vector<std::string> notes;
};

/// The images of a sequence (open_dataset), undistorted and resampled to the camera of the map, or
/// of a folder without a camera, as they are; those from number `range[0]` to `range[1]`, all where
/// it is empty. A map of images alone takes images as they are. Throws FileError where a sequence
/// is broken, ArgumentError for a range without images.
QueryImages query_images(const std::string& path, const std::vector<int>& range,
                         const MapOrigin& origin);

}  // namespace placegraph::apps
