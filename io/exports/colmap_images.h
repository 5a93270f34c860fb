#pragma once
#include <placegraph/io/exports/colmap_model.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace placegraph {

/// The id of the point of an image point without one.
inline constexpr auto kNoColmapPoint = std::numeric_limits<std::uint64_t>::max();

/// An image point with the id of its point, as files have it.
struct ColmapImagePoint {
  Eigen::Vector2d px;                    ///< (0, 0): centre of the first pixel
  std::uint64_t point = kNoColmapPoint;  ///< id, never kNoColmapPoint in what is read
};

/// The images of a model, as images.bin or images.txt has them. All lists are as long.
struct ColmapImages {
  std::vector<ColmapModel::Image> images;             ///< without observations
  std::vector<std::uint32_t> cameras;                 ///< id of the camera of each image
  std::vector<std::vector<ColmapImagePoint>> points;  ///< those of each image
};

/// Reads images.bin. Throws FileError if it is missing, truncated or malformed.
ColmapImages read_binary_images(const std::string& path);
/// Reads images.txt. Throws FileError with the line.
ColmapImages read_text_images(const std::string& path);

}  // namespace placegraph
