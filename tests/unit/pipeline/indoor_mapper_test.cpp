#include <gtest/gtest.h>
#include <placegraph/pipeline/indoor_mapper.h>

namespace placegraph {
namespace {

/// What a camera 1.4 m above the floor sees of a room from x = -2 to 2, z = -1 to 4 and 2.6 m high,
/// with the camera at `t` and turned by `turn` about the vertical.
SurfaceSight sight_of_room(std::int64_t keyframe, const SE3& T_room_cam) {
  SurfaceSight sight;
  sight.keyframe = keyframe;
  const SE3 T_cam_room = T_room_cam.inverse();
  const auto add = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
    SurfacePoint point;
    point.point = (T_cam_room * p).cast<float>();
    point.normal = (T_cam_room.rotation().matrix() * n).cast<float>();
    point.sigma = 0.005F;
    sight.points.push_back(point);
  };
  for (double s = -1.95; s < 2; s += 0.1)
    for (double h = -1.15; h < 1.4; h += 0.1) {
      add({s, h, 4}, {0, 0, -1});
      add({s, h, -1}, {0, 0, 1});
    }
  for (double s = -0.95; s < 4; s += 0.1) {
    for (double h = -1.15; h < 1.4; h += 0.1) {
      add({-2, h, s}, {1, 0, 0});
      add({2, h, s}, {-1, 0, 0});
    }
    for (double x = -1.95; x < 2; x += 0.1) add({x, 1.4, s}, {0, -1, 0});
  }
  return sight;
}

Map map_of(const std::vector<SE3>& poses) {
  Map map;
  map.metric = true;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i);
    Keyframe keyframe;
    keyframe.id = id, keyframe.frame = id, keyframe.place = id;
    map.keyframes.push_back(keyframe);
    Place place;
    place.id = id, place.anchor_keyframe = id, place.T_map_place = poses[i];
    place.members.push_back({id, SE3(), 1});
    map.place_graph.places.push_back(place);
  }
  return map;
}

/// Where the wall at z = 4 of the room stands in the plan, and how many pieces it is in.
std::vector<double> far_walls(const IndoorMap& plan) {
  std::vector<double> at;
  for (const IndoorWall& wall : plan.walls)
    if (wall.normal[1] < -0.9) at.push_back(0.5 * (wall.a[1] + wall.b[1]));
  return at;
}

TEST(IndoorMapper, FusesTwoKeyframesAndMovesWithALoop) {
  const SE3 first, second(SO3::exp({0, 0.3, 0}), Eigen::Vector3d(0.5, 0, 1));
  // Before the loop the second place is thought to be 30 cm farther.
  const SE3 drifted(second.rotation(), second.translation() + Eigen::Vector3d(0, 0, 0.3));
  IndoorMapper mapper({}, Calibration{.camera = {640, 480, 500, 500, 320, 240},
                                      .baseline_m = 0.1,
                                      .depth = {},
                                      .camera_height_m = {}});
  mapper.add(sight_of_room(0, first));
  mapper.add(sight_of_room(1, second));
  const IndoorMap before = mapper.fuse(map_of({first, drifted}));
  ASSERT_TRUE(before.outcome) << before.outcome.reason;
  EXPECT_TRUE(before.rooms.empty() || before.rooms[0].area_m2 > 5);
  const Map map = map_of({first, second});
  const IndoorMap after = mapper.fuse(map);
  ASSERT_TRUE(after.outcome) << after.outcome.reason;
  const std::vector<double> walls = far_walls(after);
  ASSERT_EQ(walls.size(), 1U);
  EXPECT_NEAR(walls[0], 4, 0.005);  // exact points
  EXPECT_NEAR(after.floor_y, 1.4, 0.005);
  ASSERT_EQ(after.rooms.size(), 1U);
  EXPECT_EQ(after.rooms[0].places.size(), 2U);
  EXPECT_TRUE(after.rooms[0].entered);
  PlaceGraph places = map.place_graph;
  label_places(after, places);
  EXPECT_EQ(places.places[0].labels, std::vector<std::string>{after.rooms[0].label});
}

TEST(IndoorMapper, SaysWhyThereIsNoPlan) {
  const Camera camera{640, 480, 500, 500, 320, 240};
  IndoorMapper mapper(
      {}, Calibration{.camera = camera, .baseline_m = 0.1, .depth = {}, .camera_height_m = {}});
  Map map = map_of({SE3()});
  EXPECT_EQ(mapper.fuse(map).outcome.code, Outcome::Code::kTooFewData);
  map.metric = false;
  EXPECT_EQ(mapper.fuse(map).outcome.reason, "the map's unit is not the metre");
  IndoorMapper blind({}, Calibration{.camera = camera, .depth = {}, .camera_height_m = {}});
  map.metric = true;
  EXPECT_FALSE(blind.fuse(map).outcome);
}

}  // namespace
}  // namespace placegraph
