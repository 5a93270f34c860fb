#include <gtest/gtest.h>
#include <placegraph/frontend/scene/orientation_map.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {
namespace orientation_map_test {

/// A box room, 4 m wide, 2.4 m high, its far wall 5 m away, looked into along z: the edges of the
/// far wall and the four that lead to it.
struct BoxRoom {
  Camera camera;
  std::vector<LineSegment> segments;
  std::vector<int> axis;
  BoxRoom() {
    camera.width = 320, camera.height = 240;
    camera.fx = camera.fy = 250, camera.cx = 159.5, camera.cy = 119.5;
    const double x = 2, y = 1.2, far = 5, near = 2.6;
    for (const double s : {-1.0, 1.0}) {
      add({-x, s * y, far}, {x, s * y, far}, 0);
      add({s * x, -y, far}, {s * x, y, far}, 1);
      for (const double t : {-1.0, 1.0}) add({s * x, t * y, near}, {s * x, t * y, far}, 2);
      // A board on each side wall, a mat on floor and ceiling.
      for (const double z : {2.9, 4.0}) {
        add({s * x, -0.5, z}, {s * x, 0.5, z}, 1);
        add({-0.5, s * y, z}, {0.5, s * y, z}, 0);
      }
      for (const double t : {-0.5, 0.5}) {
        add({s * x, t, 2.9}, {s * x, t, 4.0}, 2);
        add({t, s * y, 2.9}, {t, s * y, 4.0}, 2);
      }
    }
  }
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int along) {
    segments.push_back({*camera.project(a), *camera.project(b)});
    axis.push_back(along);
  }
  int label(const OrientationMap& map, const Eigen::Vector3d& p) const {
    const Eigen::Vector2d px = *camera.project(p);
    return map.labels.at<std::uint8_t>(static_cast<int>(px[1]), static_cast<int>(px[0]));
  }
};

TEST(OrientationMap, TellsTheWallsOfABoxRoom) {
  const BoxRoom room;
  const OrientationMap map = compute_orientation_map(room.segments, room.axis, room.camera, SO3());
  ASSERT_TRUE(map.outcome);
  EXPECT_EQ(map.vertical_axis, 1);
  EXPECT_EQ(room.label(map, {0, 0, 5}), 3);
  EXPECT_EQ(room.label(map, {-2, 0, 3.5}), 1);
  EXPECT_EQ(room.label(map, {2, 0, 3.5}), 1);
  EXPECT_EQ(room.label(map, {0, 1.2, 3.5}), 2);
  const Image surfaces = indoor_surfaces(map, room.camera, SO3());
  const Eigen::Vector2d floor = *room.camera.project({0, 1.2, 3.5}),
                        ceiling = *room.camera.project({0, -1.2, 3.5});
  const auto at = [&](const Eigen::Vector2d& p) {
    return static_cast<PlanSurface>(
        surfaces.at<std::uint8_t>(static_cast<int>(p[1]), static_cast<int>(p[0])));
  };
  EXPECT_EQ(at(floor), PlanSurface::kFloor);
  EXPECT_EQ(at(ceiling), PlanSurface::kCeiling);
}

TEST(OrientationMap, SaysNothingOfEdgesOfOneAxis) {
  const BoxRoom room;
  const std::vector<int> one(room.segments.size(), 2);
  const OrientationMap map = compute_orientation_map(room.segments, one, room.camera, SO3());
  EXPECT_EQ(map.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_THROW((void)compute_orientation_map(room.segments, {0}, room.camera, SO3()),
               ArgumentError);
}

}  // namespace orientation_map_test
}  // namespace placegraph
