#include <gtest/gtest.h>
#include <placegraph/frontend/scene/floor_sight.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>

namespace placegraph {
namespace {

constexpr double kHeight_m = 1.4, kHalfWidth_m = 1.2, kBoard_m = 0.1;

/// A corridor along z, its floor 1.4 m below the camera: doors on its walls, joints across its
/// floor, and a skirting board 10 cm high whose lower edge only some columns show.
struct Corridor {
  Camera camera;
  std::vector<LineSegment> segments;
  std::vector<int> axis;
  SO3 R_cam_manhattan = SO3::exp({0.03, 0.1, 0});

  explicit Corridor(bool lower_edge) {
    camera.width = 640, camera.height = 480;
    camera.fx = camera.fy = 500, camera.cx = 319.5, camera.cy = 239.5;
    for (const double x : {-kHalfWidth_m, kHalfWidth_m}) {
      add({x, kHeight_m - kBoard_m, 2.5}, {x, kHeight_m - kBoard_m, 8}, 2);
      if (lower_edge) add({x, kHeight_m, 2.5}, {x, kHeight_m, 8}, 2);
      add({x, -1, 2.5}, {x, -1, 8}, 2);
      for (double z = 2.6; z < 8; z += 0.6) add({x, -1, z}, {x, kHeight_m - kBoard_m, z}, 1);
    }
    for (double z = 2.9; z < 8; z += 0.5)
      add({-kHalfWidth_m, kHeight_m, z}, {kHalfWidth_m, kHeight_m, z}, 0);
  }
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int along) {
    const auto p = camera.project(R_cam_manhattan * a), q = camera.project(R_cam_manhattan * b);
    if (!p || !q) return;
    segments.push_back({*p, *q});
    axis.push_back(along);
  }
  OrientationMap map() const {
    return compute_orientation_map(segments, axis, camera, R_cam_manhattan);
  }
  std::vector<SurfacePoint> points(const FloorSightOptions& options = {}) const {
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

TEST(FloorSight, FloorPointsLieOnTheFloor) {
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

TEST(FloorSight, WallsStandWhereTheFloorEndsBelowTheirSkirtingBoards) {
  const Corridor corridor(true);
  EXPECT_NEAR(corridor.half_width_m(corridor.points()), kHalfWidth_m, 0.02);
  // By the map alone the floor reaches up the boards: 8 % of the width for 10 cm of 1.4 m.
  FloorSightOptions alone;
  alone.skirting_m = 0;
  EXPECT_GT(corridor.half_width_m(corridor.points(alone)), kHalfWidth_m + 0.03);
}

TEST(FloorSight, WithoutALowerEdgeTheMapDecides) {
  const Corridor corridor(false);
  const double told = corridor.half_width_m(corridor.points());
  EXPECT_GT(told, kHalfWidth_m + 0.03);
  EXPECT_LT(told, kHalfWidth_m * kHeight_m / (kHeight_m - kBoard_m) + 0.02);
}

TEST(FloorSight, RefusesWhatDoesNotFit) {
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

}  // namespace
}  // namespace placegraph
