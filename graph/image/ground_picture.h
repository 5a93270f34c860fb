#pragma once
#include <Eigen/Core>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// A picture of the ground from above: an occupancy grid, or a tile of a map.
/// Its pixels are parallelograms in the x and y of the world frame; x to the right and y up is
/// usual.
struct GroundPicture {
  std::string name;                                    ///< of its file
  std::string source;                                  ///< its pixels: "data:image/png;base64,..."
  int columns = 0;                                     ///< of the pixels
  int rows = 0;                                        ///< of the pixels
  Eigen::Vector2d corner_m = Eigen::Vector2d::Zero();  ///< outer corner of the first pixel
  Eigen::Vector2d right_m = Eigen::Vector2d::Zero();   ///< from a pixel to its right neighbour
  Eigen::Vector2d down_m = Eigen::Vector2d::Zero();    ///< from a pixel to the one below it
};

}  // namespace placegraph
