#pragma once
#include <placegraph/graph/geometry/so3.h>

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace placegraph {

/// What is known of a cell of a floor.
enum class CellState : std::uint8_t {
  kUnknown,  ///< nothing was observed of it
  kFree,     ///< nothing stands in it
  kOccupied  ///< something stands in it
};

/// A grid of cells on the floor, as robots navigate by.
struct OccupancyGrid {
  double cell_m = 0.05;                           ///< side of a cell
  Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< corner of least x and y in the grid's frame
  int columns = 0, rows = 0;                      ///< along x and along y
  std::vector<CellState> cells;                   ///< row by row, from the least y on
  /// Rotation from the map frame to the grid's, x forward, y left, z up; both have one origin.
  SO3 R_grid_map;
};

/// The picture of a grid as map_server of ROS reads it: PGM, white where free, black where
/// occupied, grey where unknown; the last row of cells is the first of the picture.
/// Throws ArgumentError if the number of cells is not that of columns and rows.
std::string to_pgm(const OccupancyGrid& grid);

/// The description of that picture, YAML; `image` is its path from the folder of the description.
std::string to_map_server_yaml(const OccupancyGrid& grid, const std::string& image);

}  // namespace placegraph
