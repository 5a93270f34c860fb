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

TEST(NearbyViews, AreANearerAndAFartherOneOnEachSide) {
  std::vector<SE3> poses;
  for (int i = 0; i < 40; ++i) poses.push_back(SE3(SO3(), Eigen::Vector3d(0, 0, 0.15 * i)));
  // From the 30th on the camera looks elsewhere.
  for (int i = 30; i < 40; ++i) poses[i] = SE3(SO3::exp({0, 1, 0}), poses[i].translation());
  const Map map = map_of(poses);
  int read = 0;
  NearbyViews nearby(map,
                     [&](const Keyframe& keyframe) {
                       ++read;
                       Frame frame;
                       frame.image =
                           Image(2, 2, CV_8UC1, cv::Scalar(static_cast<double>(keyframe.id)));
                       return frame;
                     },
                     {0.25, 0.5, 20});
  const auto of = [&](int keyframe) {
    std::vector<int> views;
    for (const SweptView& view : nearby.of(map.keyframes[keyframe])) {
      const int id = view.image.at<std::uint8_t>(0, 0);
      EXPECT_NEAR(view.T_view_cam.translation()[2], 0.15 * (keyframe - id), 1e-12);
      views.push_back(id);
    }
    return views;
  };
  EXPECT_EQ(of(0), (std::vector<int>{2, 4}));
  EXPECT_EQ(of(20), (std::vector<int>{18, 16, 22, 24}));
  EXPECT_EQ(of(27), (std::vector<int>{25, 23, 29}));
  read = 0;
  (void)of(27);
  EXPECT_EQ(nearby.frame(map.keyframes[27]).image.at<std::uint8_t>(0, 0), 27);
  EXPECT_EQ(read, 1) << "frames are kept";
}

TEST(IndoorMapper, SweepsDepthForAnEyeThatHasMoved) {
  const Camera camera{160, 120, 130, 130, 79.5, 59.5};
  // A patterned wall 3 m ahead, from two places beside each other.
  const auto view = [&](double x) {
    Frame frame;
    frame.image = Image(camera.height, camera.width, CV_8UC1);
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d p = 3 * *camera.unproject({u, v}) + Eigen::Vector3d(x, 0, 0);
        double grey = 120;
        for (int k = 1; k < 8; ++k)
          grey += 20 * std::sin(9 * k * p.x() + k * k * p.y()) * std::cos(8 * k * p.y() - k);
        frame.image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(grey);
      }
    return frame;
  };
  const SE3 T_view_cam(SO3(), Eigen::Vector3d(-0.3, 0, 0));
  IndoorMapper mapper({}, Calibration{.camera = camera, .depth = {}, .camera_height_m = {}});
  mapper.add(0, view(0));
  EXPECT_TRUE(mapper.sights()[0].points.empty());
  mapper.add(0, view(0), {{view(0.3).image, T_view_cam}});
  ASSERT_EQ(mapper.sights().size(), 1U);
  ASSERT_GT(mapper.sights()[0].points.size(), 100U);
  int flat = 0;
  for (const SurfacePoint& p : mapper.sights()[0].points) {
    EXPECT_NEAR(p.point[2], 3, 5 * p.sigma + 0.03);
    flat += p.normal[2] < -0.95F;
  }
  EXPECT_GT(flat, 0.8 * mapper.sights()[0].points.size());
}

}  // namespace
}  // namespace placegraph
