#include <gtest/gtest.h>
#include <placegraph/frontend/floor_plan/skirting_line.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>

#include "tests/support/scenes/corridor_view.h"

namespace placegraph {
namespace skirting_line_test {

using test::CorridorView;
constexpr double kHeight_m = CorridorView::kHeight_m, kHalfWidth_m = CorridorView::kHalfWidth_m,
                 kBoard_m = CorridorView::kBoard_m;

/// What one eye takes of it.
struct Corridor : test::CorridorView {
  using CorridorView::CorridorView;
  OrientationMap map() const {
    return compute_orientation_map(segments, axis, camera, R_cam_manhattan);
  }
  std::vector<SurfacePoint> points(const SkirtingLineOptions& options = {}) const {
    return surface_points_on_floor(map(), segments, axis, camera, R_cam_manhattan, kHeight_m,
                                   options);
  }
  /// Median distance of the points of side walls from the corridor's middle.
  double half_width_m(const std::vector<SurfacePoint>& points) const {
    std::vector<double> distances;
    for (const SurfacePoint& p : points) {
      const Eigen::Vector3d n = R_cam_manhattan.inverse() * p.normal.cast<double>();
      const Eigen::Vector3d x = R_cam_manhattan.inverse() * p.point.cast<double>();
      if (std::abs(n.x()) > 0.99) distances.push_back(std::abs(x.x()));
    }
    return distances.size() < 50 ? 0 : median_of(distances);
  }
};

TEST(SkirtingLine, FloorPointsLieOnTheFloor) {
  const Corridor corridor(true);
  int floor = 0;
  for (const SurfacePoint& p : corridor.points()) {
    const Eigen::Vector3d n = corridor.R_cam_manhattan.inverse() * p.normal.cast<double>();
    const Eigen::Vector3d x = corridor.R_cam_manhattan.inverse() * p.point.cast<double>();
    if (n.y() > -0.99) continue;
    EXPECT_NEAR(x.y(), kHeight_m, 1e-4);
    ++floor;
  }
  EXPECT_GT(floor, 200);
}

TEST(SkirtingLine, WallsStandWhereTheFloorEndsBelowTheirSkirtingBoards) {
  const Corridor corridor(true);
  EXPECT_NEAR(corridor.half_width_m(corridor.points()), kHalfWidth_m, 0.02);
  // By the map alone the floor reaches up the boards: 8 % of the width for 10 cm of 1.4 m.
  SkirtingLineOptions alone;
  alone.skirting_m = 0;
  EXPECT_GT(corridor.half_width_m(corridor.points(alone)), kHalfWidth_m + 0.03);
}

TEST(SkirtingLine, WithoutALowerEdgeTheMapDecides) {
  const Corridor corridor(false);
  const double estimated = corridor.half_width_m(corridor.points());
  EXPECT_GT(estimated, kHalfWidth_m + 0.03);
  EXPECT_LT(estimated, kHalfWidth_m * kHeight_m / (kHeight_m - kBoard_m) + 0.02);
}

TEST(SkirtingLine, RefusesWhatDoesNotFit) {
  const Corridor corridor(true);
  EXPECT_THROW((void)surface_points_on_floor(corridor.map(), corridor.segments, {0},
                                             corridor.camera, corridor.R_cam_manhattan, 1.4),
               ArgumentError);
  EXPECT_THROW((void)surface_points_on_floor(corridor.map(), corridor.segments, corridor.axis,
                                             corridor.camera, corridor.R_cam_manhattan, 0),
               ArgumentError);
  const OrientationMap none = compute_orientation_map(
      corridor.segments, std::vector<int>(corridor.segments.size(), 2), corridor.camera, SO3());
  EXPECT_TRUE(surface_points_on_floor(none, corridor.segments,
                                      std::vector<int>(corridor.segments.size(), 2),
                                      corridor.camera, SO3(), 1.4)
                  .empty());
}

}  // namespace skirting_line_test
}  // namespace placegraph
