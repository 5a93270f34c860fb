#include <gtest/gtest.h>
#include <placegraph/frontend/floor_plan/plan_surfaces.h>
#include <placegraph/frontend/floor_plan/room_partition.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {
namespace plan_surfaces_test {

Camera small_camera() {
  Camera camera;
  camera.width = 80, camera.height = 60;
  camera.fx = camera.fy = 60, camera.cx = 39.5, camera.cy = 29.5;
  return camera;
}

TEST(SurfacePoints, TellThePlaneOfADepthImage) {
  const Camera camera = small_camera();
  const Eigen::Vector3d n = Eigen::Vector3d(0.3, -0.2, -1).normalized();
  Image depth(60, 80, CV_32FC1, cv::Scalar(0));
  for (int v = 0; v < 60; ++v)
    for (int u = 0; u < 80; ++u) {
      const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
      depth.at<float>(v, u) = static_cast<float>(-2 / n.dot(ray));
    }
  const auto points = surface_points(depth, camera, SE3(), 0.001);
  ASSERT_GT(points.size(), 40U);
  for (const SurfacePoint& p : points) {
    // Depth is held in float: a millionth of it.
    EXPECT_NEAR(n.dot(p.normal.cast<double>()), 1, 1e-4);
    EXPECT_NEAR(n.dot(p.point.cast<double>()), -2, 1e-4);
  }
  EXPECT_THROW((void)surface_points(Image(60, 80, CV_8UC1), camera, SE3(), 0.001), ArgumentError);
}

/// Two rooms of 4 x 3 m beside each other, a wall at x = 4 with a door from y = 1 on, and how they
/// are looked at.
struct TwoRoomsOptions {
  double door_to_m = 1.9, head_m = 2.05;
  /// Points of the wall between are told within these only.
  double observed_from_m = 0, observed_to_m = 3;
  bool through = true;  ///< the camera goes through the door, or stays in either room
};
struct TwoRooms {
  TwoRoomsOptions options;
  std::vector<PlacedPoint> points;
  std::vector<Eigen::Vector3d> path;
  VoxelEvidence voxels{{-0.5, -0.5, 0}, {8.5, 3.5, 2.6}, 0.05, 0.2};

  explicit TwoRooms(const TwoRoomsOptions& of = {}) : options(of) {
    for (double x = 0.3; x < 7.8; x += 0.5)
      if (options.through || x < 3.5) path.emplace_back(x, 1.45, 1.4);
    for (int i = 0; i < static_cast<int>(path.size()); ++i) observe(i);
  }
  /// Rays to what is nearest: outer walls, the wall between (but through the door), floor, ceiling.
  void observe(int observation) {
    const Eigen::Vector3d from = path[static_cast<std::size_t>(observation)];
    for (int a = 0; a < 90; ++a)
      for (int e = -15; e <= 15; ++e) {
        const double rotation = a * std::numbers::pi / 45, pitch = e * 0.08;
        const Eigen::Vector3d trace(std::cos(rotation) * std::cos(pitch),
                                    std::sin(rotation) * std::cos(pitch), std::sin(pitch));
        cast(from, trace, observation);
      }
  }
  void cast(const Eigen::Vector3d& from, const Eigen::Vector3d& trace, int observation) {
    double best = 1e9;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    const auto plane = [&](int axis, double at, bool door) {
      const double t = (at - from[axis]) / trace[axis];
      if (!(t > 1e-6) || t >= best) return;
      const Eigen::Vector3d p = from + t * trace;
      if (door && p[1] > 1 && p[1] < options.door_to_m && p[2] < options.head_m) return;
      best = t, normal.setZero(), normal[axis] = trace[axis] > 0 ? -1 : 1;
    };
    for (const double x : {0.0, 8.0}) plane(0, x, false);
    plane(0, from[0] < 4 ? 3.95 : 4.05, true);
    for (const double y : {0.0, 3.0}) plane(1, y, false);
    for (const double z : {0.0, 2.6}) plane(2, z, false);
    const Eigen::Vector3d to = from + best * trace;
    const bool between = normal[0] != 0 && std::abs(to[0] - 4) < 0.1;
    if (!between || (to[1] > options.observed_from_m && to[1] < options.observed_to_m))
      points.push_back({to.cast<float>(), normal.cast<float>(), 0.005F, observation});
    voxels.add_ray(from, to, 0.1, true);
  }
};

TEST(FloorPlan, OfTwoRoomsHasTheirWallsTheDoorAndBoth) {
  const TwoRooms scene;
  const auto walls = find_walls(scene.points, scene.voxels);
  for (const WallPiece& wall : walls) {
    const double at = wall.offset_m;
    double nearest = 1;
    if (wall.axis == 0)
      for (const double x : {0.0, 3.95, 4.05, 8.0}) nearest = std::min(nearest, std::abs(at - x));
    else
      for (const double y : {0.0, 3.0}) nearest = std::min(nearest, std::abs(at - y));
    EXPECT_LT(nearest, 0.005);  // exact points
  }
  const auto doors = find_doors(walls, scene.points, scene.voxels, scene.path);
  ASSERT_EQ(doors.size(), 1U);
  EXPECT_FALSE(doors[0].closed);
  EXPECT_NEAR(0.5 * (doors[0].from_m + doors[0].to_m), 1.45, 0.1);  // two steps of the profile
  EXPECT_NEAR(doors[0].head_m, 2.05, 0.15);
  const RoomPartition rooms = partition_rooms(scene.voxels, walls, doors, scene.path);
  ASSERT_EQ(rooms.rooms.size(), 2U);
  for (const auto& room : rooms.rooms) EXPECT_NEAR(room.area_m2, 3.95 * 3, 0.6);
}

std::vector<DoorPiece> doors_of(const TwoRooms& scene) {
  return find_doors(find_walls(scene.points, scene.voxels), scene.points, scene.voxels, scene.path);
}

TEST(FloorPlan, PartsRoomsAtADoorThatTheCameraTookBesideAWallThatIsHardlySeen) {
  for (const auto& [from, to] : {std::pair{0.0, 1.05}, {1.85, 3.0}}) {  // one jamb or the other
    const TwoRooms scene({.head_m = 1.95, .observed_from_m = from, .observed_to_m = to});
    const auto walls = find_walls(scene.points, scene.voxels);
    const auto doors = find_doors(walls, scene.points, scene.voxels, scene.path);
    ASSERT_EQ(doors.size(), 1U) << from;
    // Two steps of the profile; at the other jamb oblique rays come up to one farther.
    EXPECT_NEAR(doors[0].from_m, 1, from == 0 ? 0.1 : 0.16);
    EXPECT_NEAR(doors[0].to_m, 1.9, from == 0 ? 0.16 : 0.1);
    EXPECT_FALSE(doors[0].closed);
    EXPECT_EQ(partition_rooms(scene.voxels, walls, doors, scene.path).rooms.size(), 2U);
  }
}

TEST(FloorPlan, TakesNoDoorOfOneJambThatTheCameraDidNotTakeOrThatIsTooWide) {
  EXPECT_EQ(doors_of(TwoRooms({.head_m = 1.95, .observed_to_m = 1.05})).size(), 1U);
  EXPECT_TRUE(
      doors_of(TwoRooms({.head_m = 1.95, .observed_to_m = 1.05, .through = false})).empty());
  EXPECT_TRUE(
      doors_of(TwoRooms({.door_to_m = 2.55, .head_m = 1.95, .observed_to_m = 1.05})).empty());
}

TEST(FloorPlan, TakesTheCornerOfANarrowCorridorForNoDoor) {
  // 1.2 m wide: along x to the corner, then along y. The inner wall (y = 1.2, x < 3) ends at it.
  VoxelEvidence voxels({-0.5, -0.5, 0}, {5, 5, 2.6}, 0.05, 0.2);
  std::vector<Eigen::Vector3d> path;
  for (double s = 0.2; s < 3.6; s += 0.2) path.emplace_back(s, 0.6, 1.4);
  for (double s = 0.8; s < 4.4; s += 0.2) path.emplace_back(3.6, s, 1.4);
  std::vector<PlacedPoint> points;
  WallPiece inner;
  inner.axis = 1, inner.sign = -1, inner.offset_m = 1.2, inner.to_m = 3;
  for (float x = 0; x < 3; x += 0.04F)
    for (float z = 0.1F; z < 1.8F; z += 0.1F)
      points.push_back({{x, 1.2F, z}, {0, -1, 0}, 0.01F, 0});
  for (const Eigen::Vector3d& from : path)
    for (int a = 0; a < 360; ++a)  // rays end at the outer walls and the inner ones
      for (const double z : {0.7, 1.0, 1.4, 1.7}) {
        const Eigen::Vector3d trace(std::cos(deg_to_rad(a)), std::sin(deg_to_rad(a)), 0);
        Eigen::Vector3d to(from[0], from[1], z);
        const auto inside = [](const Eigen::Vector3d& p) {
          return p[0] > 0 && p[0] < 4.2 && p[1] > 0 && p[1] < 4.6 && (p[1] < 1.2 || p[0] > 3);
        };
        while (inside(to)) to += 0.02 * trace;
        voxels.add_ray({from[0], from[1], z}, to, 0.1, true);
      }
  EXPECT_TRUE(find_doors({inner}, points, voxels, path).empty());
}

/// A wall of 5 m with a leaf 1 m wide, 3 cm behind it, by points of a deviation; the wall beside
/// the leaf is seen from `wall_again_m` on, and above it.
std::vector<DoorPiece> doors_of_a_leaf(float sigma, float wall_again_m = 3) {
  WallPiece wall;
  wall.to_m = 5;
  VoxelEvidence voxels({-1, -1, 0}, {3, 6, 2.6}, 0.05, 0.2);
  std::vector<PlacedPoint> points;
  for (float y = 0; y < 5; y += 0.04F)
    for (float z = 0.1F; z < 2.5F; z += 0.1F) {
      const bool leaf = y > 2 && y < 3 && z < 2.05F;
      if (y > 3 && y < wall_again_m && z < 2.05F) continue;
      points.push_back({{leaf ? -0.03F : 0.0F, y, z}, {1, 0, 0}, sigma, 0});
    }
  return find_doors({wall}, points, voxels, {{1, 1, 1}, {1, 4, 1}});
}

TEST(FloorPlan, AsksForADeeperRecessOfALeafWherePointsAreRough) {
  const auto sure = doors_of_a_leaf(0.005F);
  ASSERT_EQ(sure.size(), 1U);
  EXPECT_TRUE(sure[0].closed);
  EXPECT_NEAR(sure[0].from_m, 2, 0.1);  // two steps of the profile
  EXPECT_NEAR(sure[0].to_m, 3, 0.1);
  EXPECT_TRUE(doors_of_a_leaf(0.09F).empty());
}

TEST(FloorPlan, EndsADoorAtItsLeafWhereTheWallBesideItIsNotSeen) {
  const auto doors = doors_of_a_leaf(0.005F, 3.57F);
  ASSERT_EQ(doors.size(), 1U);
  EXPECT_NEAR(doors[0].from_m, 2, 0.1);
  EXPECT_NEAR(doors[0].to_m, 3, 0.1);
}

/// The area [m2] told of a hall of 8 x 6 m that is seen but for 4 x 3 m in the middle of a side.
double area_of_a_hall(const std::vector<WallPiece>& walls) {
  VoxelEvidence voxels({-0.5, -0.5, 0}, {8.5, 6.5, 2.6}, 0.05, 0.1);
  const auto see = [&](double from, double to, double y) {
    for (int k = 0; k < 4; ++k) voxels.add_ray({from, y, 1}, {to, y, 1}, 0, false);
  };
  for (double y = 0.025; y < 6; y += 0.05) {
    see(0.025, y < 3 ? 2 : 8, y);
    see(6.025, 8, y);
  }
  const RoomPartition partition = partition_rooms(voxels, walls, {}, {{1, 5, 1}});
  EXPECT_EQ(partition.rooms.size(), 1U);
  return partition.rooms.empty() ? 0 : partition.rooms[0].area_m2;
}

WallPiece wall_of(int axis, int sign, double offset, double from, double to) {
  WallPiece wall;
  wall.axis = axis, wall.sign = sign, wall.offset_m = offset, wall.from_m = from, wall.to_m = to;
  return wall;
}

TEST(FloorPlan, GivesARoomWhatFurnitureHides) {
  EXPECT_NEAR(area_of_a_hall({}), 48, 1.5);
  EXPECT_NEAR(area_of_a_hall({wall_of(0, -1, 2.1, 1, 2)}), 47, 1.5);  // one face of a rack
}

TEST(FloorPlan, GivesARoomNothingThatWallsPartFromIt) {
  // All round, but for an open door on either side.
  EXPECT_NEAR(area_of_a_hall({wall_of(0, -1, 2.1, 0, 1), wall_of(0, -1, 2.1, 2, 3),
                              wall_of(0, 1, 5.9, 0, 1), wall_of(0, 1, 5.9, 2, 3),
                              wall_of(1, 1, 2.9, 2, 6)}),
              36, 1.5);
  // Walls along most of it that leave both ends open.
  EXPECT_NEAR(area_of_a_hall({wall_of(1, 1, 0.75, 2, 6), wall_of(1, 1, 1.5, 2, 6),
                              wall_of(1, 1, 2.25, 2, 6), wall_of(1, 1, 2.95, 2, 6)}),
              36, 1.5);
}

TEST(FloorPlan, HasNoWallWhereTheCameraWent) {
  WallPiece wall;
  wall.from_m = 0, wall.to_m = 5, wall.offset_m = 2;
  const auto left = cut_at_path({wall}, {{1, 3, 1}, {3, 3, 1}}, 0.5, 0.4);
  ASSERT_EQ(left.size(), 2U);
  EXPECT_NEAR(left[0].to_m, 2.5, 1e-9);
  EXPECT_NEAR(left[1].from_m, 3.5, 1e-9);
}

}  // namespace plan_surfaces_test
}  // namespace placegraph
