#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/occupancy_file.h>

#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

// map_server takes (255 - grey) / 255 for the probability that a cell is occupied: less than
// kFreeBelow is free, more than kOccupiedAbove is occupied.
constexpr double kFreeBelow = 0.196, kOccupiedAbove = 0.65;

char grey_of(CellState state) {
  switch (state) {
    case CellState::kFree:
      return static_cast<char>(254);
    case CellState::kOccupied:
      return static_cast<char>(0);
    case CellState::kUnknown:
      break;
  }
  return static_cast<char>(205);
}

}  // namespace

std::string to_pgm(const OccupancyGrid& grid) {
  require(grid.columns > 0 && grid.rows > 0 &&
              grid.cells.size() ==
                  static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
          "occupancy grid: the number of cells is not that of columns and rows");
  std::string pgm = fmt::format("P5\n{} {}\n255\n", grid.columns, grid.rows);
  const auto columns = static_cast<std::size_t>(grid.columns);
  for (std::size_t row = static_cast<std::size_t>(grid.rows); row-- > 0;)
    for (std::size_t column = 0; column < columns; ++column)
      pgm += grey_of(grid.cells[row * columns + column]);
  return pgm;
}

std::string to_map_server_yaml(const OccupancyGrid& grid, const std::string& image) {
  const Eigen::Matrix3d R = grid.R_grid_map.matrix();
  std::string yaml = "# p_grid = R p_map, x forward, y left, z up; rows of R:\n";
  for (int i = 0; i < 3; ++i)
    yaml += fmt::format("#   [{:.9f}, {:.9f}, {:.9f}]\n", R(i, 0), R(i, 1), R(i, 2));
  return yaml +
         fmt::format(
             "image: {}\nmode: trinary\nresolution: {}\norigin: [{}, {}, 0]\nnegate: 0\n"
             "occupied_thresh: {}\nfree_thresh: {}\n",
             nlohmann::json(image).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
             grid.cell_m, grid.low[0], grid.low[1], kOccupiedAbove, kFreeBelow);
}

}  // namespace placegraph
