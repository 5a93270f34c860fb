#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/map/map_occupancy.h>

#include "tests/support/message_of.h"
#include "tests/support/scenes/observed_map.h"

namespace placegraph {
namespace map_occupancy_test {

/// A camera at 0, 0.5, 1 m on x that looks along z at a wall of points at z = 4.025 m.
class MapOccupancyTest : public testing::Test {
 protected:
  MapOccupancyTest() {
    scene.camera = test::pinhole(640, 480, 400);
    for (int i = 0; i < 3; ++i) scene.T_ref_cam.emplace_back(SO3(), Eigen::Vector3d(0.5 * i, 0, 0));
    for (double x = -1; x < 2; x += 0.04) scene.points_ref.emplace_back(x, 0.1, 4.025);
    scene.px.resize(3);
    for (std::size_t view = 0; view < 3; ++view)
      for (const Eigen::Vector3d& p : scene.points_ref)
        scene.px[view].push_back(*scene.camera.project(scene.T_ref_cam[view].inverse() * p));
    map = test::observed_map(scene);
  }
  /// The cell of a point of the map's floor, x to the right and z ahead.
  static CellState at(const OccupancyGrid& grid, double x, double z) {
    const Eigen::Vector3d p = grid.R_grid_map * Eigen::Vector3d(x, 0, z);
    const auto column = static_cast<int>(std::floor((p[0] - grid.low[0]) / grid.cell_m));
    const auto row = static_cast<int>(std::floor((p[1] - grid.low[1]) / grid.cell_m));
    EXPECT_TRUE(column >= 0 && row >= 0 && column < grid.columns && row < grid.rows);
    return grid.cells.at(static_cast<std::size_t>(row * grid.columns + column));
  }
  test::PointScene scene;
  Map map;
};

TEST_F(MapOccupancyTest, IsFreeUpToAWallAndUnknownBesideIt) {
  const MapOccupancy result = occupancy_of(map, 0);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  const OccupancyGrid& grid = result.grid;
  EXPECT_TRUE((grid.R_grid_map * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE((grid.R_grid_map * Eigen::Vector3d(0, -1, 0)).isApprox(Eigen::Vector3d::UnitZ()));
  for (const double x : {-0.9, 0.0, 0.5, 1.9})
    EXPECT_EQ(at(grid, x, 4.025), CellState::kOccupied) << x;
  for (const double x : {0.1, 0.5, 1.0}) EXPECT_EQ(at(grid, x, 2), CellState::kFree) << x;
  EXPECT_EQ(at(grid, 0.25, 0), CellState::kFree);      // the camera was there
  EXPECT_EQ(at(grid, 0.25, -0.15), CellState::kFree);  // and its body
  EXPECT_EQ(at(grid, 1.9, 0.5), CellState::kUnknown);
}

TEST_F(MapOccupancyTest, LeavesOutWhatIsAboveAndBelow) {
  for (PointLandmark& landmark : map.landmarks) landmark.point_cam[1] = -2;
  const MapOccupancy result = occupancy_of(map, 0);
  ASSERT_TRUE(result.outcome);
  for (const CellState cell : result.grid.cells) EXPECT_NE(cell, CellState::kOccupied);
  EXPECT_EQ(at(result.grid, 0.25, 0.5), CellState::kFree);  // rays are 0.25 m high there
}

TEST_F(MapOccupancyTest, EndsRaysTwoStandardDeviationsBeforeTheLandmark) {
  for (PointLandmark& landmark : map.landmarks)
    landmark.covariance = Eigen::Vector3d::Constant(0.4 * 0.4).asDiagonal();
  const MapOccupancy result = occupancy_of(map, 0);
  ASSERT_TRUE(result.outcome);
  EXPECT_EQ(at(result.grid, 0.5, 3.02), CellState::kFree);
  EXPECT_EQ(at(result.grid, 0.5, 3.52), CellState::kUnknown);
  EXPECT_EQ(at(result.grid, 0.5, 4.025), CellState::kOccupied);
}

TEST_F(MapOccupancyTest, UsesNoLandmarkOfUnknownOrLargeDeviation) {
  for (PointLandmark& landmark : map.landmarks) landmark.covariance.reset();
  map.landmarks[0].covariance = Eigen::Vector3d(0.01, 0.01, 9).asDiagonal();
  const MapOccupancy result = occupancy_of(map, 0);
  ASSERT_TRUE(result.outcome);
  for (const CellState cell : result.grid.cells) EXPECT_NE(cell, CellState::kOccupied);
  EXPECT_LT(result.grid.columns, 15);  // the path of the camera and its rim
}

TEST_F(MapOccupancyTest, HasTheWallsOfAFloorPlanAndItsVertical) {
  FloorPlan plan;
  plan.outcome = Outcome::ok();
  plan.R_plan_map = SO3::exp(Eigen::Vector3d(0.1, 0, 0));
  PlanWall& wall = plan.walls.emplace_back();
  wall.a = {-0.52, 1.98};
  wall.b = {-0.52, 3.03};
  const MapOccupancy result = occupancy_of(map, 0, {}, &plan);
  ASSERT_TRUE(result.outcome);
  const Eigen::Vector3d down =
      result.grid.R_grid_map * (plan.R_plan_map.inverse() * Eigen::Vector3d(0, 1, 0));
  EXPECT_TRUE(down.isApprox(Eigen::Vector3d(0, 0, -1)));
  for (const double z : {2.0, 2.5, 3.0}) {
    const Eigen::Vector3d p = plan.R_plan_map.inverse() * Eigen::Vector3d(-0.52, 0, z);
    const Eigen::Vector3d on_grid = result.grid.R_grid_map * p;
    const auto column =
        static_cast<int>(std::floor((on_grid[0] - result.grid.low[0]) / result.grid.cell_m));
    const auto row =
        static_cast<int>(std::floor((on_grid[1] - result.grid.low[1]) / result.grid.cell_m));
    EXPECT_EQ(result.grid.cells.at(static_cast<std::size_t>(row * result.grid.columns + column)),
              CellState::kOccupied)
        << z;
  }
}

TEST_F(MapOccupancyTest, NeedsMetresAndALimitedNumberOfCells) {
  MapOccupancyOptions options;
  options.cell_m = 1e-5;
  EXPECT_THAT(test::message_of<ArgumentError>([&] { (void)occupancy_of(map, 0, options); }),
              testing::HasSubstr("are too many"));
  options.cell_m = 0;
  EXPECT_THROW((void)occupancy_of(map, 0, options), ArgumentError);
  EXPECT_EQ(occupancy_of(map, 3).outcome.reason, "nothing has a pose");
  map.metric = false;
  EXPECT_EQ(occupancy_of(map, 0).outcome.reason, "the map is not metric");
}

}  // namespace map_occupancy_test
}  // namespace placegraph
