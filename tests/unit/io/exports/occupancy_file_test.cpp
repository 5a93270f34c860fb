#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/occupancy_file.h>

namespace placegraph {
namespace occupancy_file_test {

OccupancyGrid small_grid() {
  OccupancyGrid grid;
  grid.cell_m = 0.1;
  grid.low = {-1.5, 2};
  grid.columns = 3, grid.rows = 2;
  grid.cells = {CellState::kFree,    CellState::kOccupied, CellState::kUnknown,
                CellState::kUnknown, CellState::kFree,     CellState::kFree};
  return grid;
}

TEST(OccupancyFile, BeginsWithTheRowOfTheLargestY) {
  EXPECT_EQ(to_pgm(small_grid()), std::string("P5\n3 2\n255\n\xcd\xfe\xfe\xfe\x00\xcd", 17));
}

TEST(OccupancyFile, IsDescribedForMapServer) {
  const std::string yaml = to_map_server_yaml(small_grid(), "my map.pgm");
  for (const char* line : {"image: \"my map.pgm\"\n", "resolution: 0.1\n", "origin: [-1.5, 2, 0]\n",
                           "negate: 0\n", "occupied_thresh: 0.65\n", "free_thresh: 0.196\n",
                           "mode: trinary\n", "#   [1.000000000, 0.000000000, 0.000000000]\n"})
    EXPECT_THAT(yaml, testing::HasSubstr(line));
}

TEST(OccupancyFile, NeedsAllItsCells) {
  OccupancyGrid grid = small_grid();
  grid.cells.pop_back();
  EXPECT_THROW(to_pgm(grid), ArgumentError);
  EXPECT_THROW(to_pgm({}), ArgumentError);
}

}  // namespace occupancy_file_test
}  // namespace placegraph
