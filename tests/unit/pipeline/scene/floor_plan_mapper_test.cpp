#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/map/map_floor_plan.h>
#include <placegraph/pipeline/scene/floor_plan.h>
#include <placegraph/pipeline/scene/floor_plan_mapper.h>

#include "tests/support/ids.h"
#include "tests/support/scenes/boards.h"
#include "tests/support/scenes/posed_map.h"

namespace placegraph {
namespace floor_plan_mapper_test {

using namespace test;

/// What a camera 1.4 m above the floor sees of a room from x = -2 to 2, z = -1 to 4 and 2.6 m high,
/// with the camera at `t` and turned by `turn` about the vertical.
KeyframeSurfacePoints observation_of_room(std::int64_t keyframe, const SE3& T_room_cam) {
  KeyframeSurfacePoints observation;
  observation.keyframe = KeyframeId(keyframe);
  const SE3 T_cam_room = T_room_cam.inverse();
  const auto add = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
    SurfacePoint point;
    point.point = (T_cam_room * p).cast<float>();
    point.normal = (T_cam_room.rotation().matrix() * n).cast<float>();
    point.sigma = 0.005F;
    observation.points.push_back(point);
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
  return observation;
}

/// Where the wall at z = 4 of the room stands in the plan, and how many pieces it is in.
std::vector<double> far_walls(const FloorPlan& plan) {
  std::vector<double> at;
  for (const PlanWall& wall : plan.walls)
    if (wall.normal[1] < -0.9) at.push_back(0.5 * (wall.a[1] + wall.b[1]));
  return at;
}

TEST(FloorPlanMapper, FusesTwoKeyframesAndMovesWithALoop) {
  const SE3 first, second(SO3::exp({0, 0.3, 0}), Eigen::Vector3d(0.5, 0, 1));
  // Before the loop the second place is thought to be 30 cm farther.
  const SE3 drifted(second.rotation(), second.translation() + Eigen::Vector3d(0, 0, 0.3));
  FloorPlanMapper mapper({}, Calibration{.camera = {640, 480, 500, 500, 320, 240},
                                         .baseline_m = 0.1,
                                         .depth = {},
                                         .camera_height_m = {}});
  mapper.add(observation_of_room(0, first));
  mapper.add(observation_of_room(1, second));
  const FloorPlan before = mapper.fuse(posed_map({first, drifted}));
  ASSERT_TRUE(before.outcome) << before.outcome.reason;
  // The far wall stands where each of the two sees it. The room is what lies before the nearer one
  // of the two walls of each kind: x from -2 to 2, z from -0.7 to 4, up to a row of cells each way.
  const std::vector<double> twice = far_walls(before);
  ASSERT_EQ(twice.size(), 2U);
  EXPECT_NEAR(std::min(twice[0], twice[1]), 4, 0.005);
  EXPECT_NEAR(std::max(twice[0], twice[1]), 4.3, 0.005);
  ASSERT_EQ(before.rooms.size(), 1U);
  EXPECT_NEAR(before.rooms[0].area_m2, 4 * 4.7, FloorPlanMapperOptions().cell_m * (4 + 4.7));
  const Map map = posed_map({first, second});
  const FloorPlan after = mapper.fuse(map);
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

TEST(FloorPlanMapper, SaysWhyThereIsNoPlan) {
  const Camera camera{640, 480, 500, 500, 320, 240};
  FloorPlanMapper mapper(
      {}, Calibration{.camera = camera, .baseline_m = 0.1, .depth = {}, .camera_height_m = {}});
  Map map = posed_map({SE3()});
  EXPECT_EQ(mapper.fuse(map).outcome.code, Outcome::Code::kTooFewData);
  map.metric = false;
  EXPECT_EQ(mapper.fuse(map).outcome.reason, "the map is not metric");
  EXPECT_EQ(
      map_floor_plan(map, Calibration{.camera = camera, .depth = {}, .camera_height_m = {}},
                     [](const Keyframe&) -> Frame { throw ArgumentError("no frame is needed"); })
          .outcome.reason,
      "the map is not metric");
}

/// Keyframes whose frames are of the grey of their number, and which ones were read.
struct GreyFrames {
  std::vector<KeyframeId> read;
  NearbyViews views_of(const Map& map) {
    return {map,
            [this](const Keyframe& keyframe) {
              read.push_back(keyframe.id);
              Frame frame;
              frame.image =
                  Image(2, 2, CV_8UC1, cv::Scalar(static_cast<double>(keyframe.id.value())));
              return frame;
            },
            {0.25, 0.5, 20}};
  }
};

std::vector<int> numbers_of(const std::vector<SweptView>& views) {
  std::vector<int> numbers;
  for (const SweptView& view : views) numbers.push_back(view.image.at<std::uint8_t>(0, 0));
  return numbers;
}

TEST(NearbyViews, AreANearerAndAFartherOneOnEachSide) {
  std::vector<SE3> poses;
  for (int i = 0; i < 40; ++i) poses.push_back(SE3(SO3(), Eigen::Vector3d(0, 0, 0.15 * i)));
  // From the 30th on the camera looks elsewhere.
  for (int i = 30; i < 40; ++i) poses[i] = SE3(SO3::exp({0, 1, 0}), poses[i].translation());
  const Map map = posed_map(poses);
  GreyFrames frames;
  NearbyViews nearby = frames.views_of(map);
  const auto of = [&](int keyframe) {
    const std::vector<SweptView> views = nearby.of(map.keyframes[keyframe]);
    const std::vector<int> numbers = numbers_of(views);
    for (std::size_t i = 0; i < views.size(); ++i)
      EXPECT_NEAR(views[i].T_view_cam.translation()[2], 0.15 * (keyframe - numbers[i]), 1e-12);
    return numbers;
  };
  EXPECT_EQ(of(0), (std::vector<int>{2, 4}));
  EXPECT_EQ(of(20), (std::vector<int>{18, 16, 22, 24}));
  EXPECT_EQ(of(27), (std::vector<int>{25, 23, 29}));
  frames.read.clear();
  (void)of(27);
  EXPECT_EQ(nearby.frame(map.keyframes[27]).image.at<std::uint8_t>(0, 0), 27);
  EXPECT_EQ(frames.read, test::ids<KeyframeId>({27})) << "frames are kept";
}

TEST(NearbyViews, AreOnlyThoseThatHaveMovedALittle) {
  // It stands still, goes on in small steps, and then leaps.
  std::vector<SE3> poses(3);
  for (const double z : {0.1, 0.3, 2.3, 2.6}) poses.push_back(SE3(SO3(), Eigen::Vector3d(0, 0, z)));
  const Map map = posed_map(poses);
  GreyFrames frames;
  NearbyViews nearby = frames.views_of(map);
  EXPECT_EQ(numbers_of(nearby.of(map.keyframes[0])), std::vector<int>{4});
  EXPECT_EQ(numbers_of(nearby.of(map.keyframes[4])), std::vector<int>{2});
  EXPECT_EQ(numbers_of(nearby.of(map.keyframes[5])), std::vector<int>{6});
}

TEST(NearbyViews, AreOfTheMapThatHangsTogether) {
  std::vector<SE3> poses;
  for (int i = 0; i < 6; ++i) poses.push_back(SE3(SO3(), Eigen::Vector3d(0, 0, 0.3 * i)));
  Map map = posed_map(poses);
  for (int i = 3; i < 6; ++i) map.place_graph.places[i].component = 1;  // lost, and never found
  GreyFrames frames;
  NearbyViews nearby = frames.views_of(map);
  EXPECT_EQ(numbers_of(nearby.of(map.keyframes[2])), (std::vector<int>{1, 0}));
  EXPECT_TRUE(nearby.of(map.keyframes[3]).empty());
  const Keyframe copy = map.keyframes[2];
  EXPECT_EQ(nearby.of(copy).size(), 2U);
  Keyframe other = copy;
  other.id = KeyframeId(17);
  EXPECT_THROW((void)nearby.of(other), ArgumentError);
}

TEST(FloorPlanMapper, SweepsDepthForACameraThatHasMoved) {
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
  FloorPlanMapper mapper({}, Calibration{.camera = camera, .depth = {}, .camera_height_m = {}});
  mapper.add(KeyframeId(0), view(0));
  EXPECT_TRUE(mapper.observations()[0].points.empty());
  mapper.add(KeyframeId(0), view(0), {{view(0.3).image, T_view_cam}});
  ASSERT_EQ(mapper.observations().size(), 1U);
  ASSERT_GT(mapper.observations()[0].points.size(), 100U);
  const double count = static_cast<double>(mapper.observations()[0].points.size());
  int flat = 0, right = 0;
  for (const SurfacePoint& p : mapper.observations()[0].points) {
    right += std::abs(p.point[2] - 3) < 5 * p.sigma + 0.03;
    flat += p.normal[2] < -0.95F;
  }
  EXPECT_GT(right, 0.95 * count);
  EXPECT_GT(flat, 0.8 * count);
  EXPECT_EQ(mapper.fuse(posed_map({SE3()})).outcome.code, Outcome::Code::kDegenerate)
      << "a wall alone is no building, but one eye of unknown height may see one";
}

/// A depth image of a wall `ahead_m` before the camera, 0.3 m to the left of which there is none.
Frame wall_in_depth(const Camera& camera, double ahead_m) {
  Frame frame;
  frame.image = Image(camera.height, camera.width, CV_8UC1, cv::Scalar(90));
  frame.depth = Image(camera.height, camera.width, CV_32FC1, cv::Scalar(0));
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u)
      if (camera.unproject({u, v})->x() * ahead_m > -0.3)
        frame.depth.at<float>(v, u) = static_cast<float>(ahead_m);
  return frame;
}

TEST(FloorPlanMapper, TakesTheDepthsOfADepthCamera) {
  const Camera camera{160, 120, 130, 130, 79.5, 59.5};
  const SE3 T_cam_depth(SO3(), Eigen::Vector3d(0.5, 0, 0));
  FloorPlanMapper mapper({}, Calibration{.camera = camera,
                                         .baseline_m = 0,
                                         .depth = DepthCamera{camera, T_cam_depth, 0.005},
                                         .camera_height_m = {}});
  mapper.add(KeyframeId(3), wall_in_depth(camera, 2.5));
  ASSERT_EQ(mapper.observations().size(), 1U);
  EXPECT_EQ(mapper.observations()[0].keyframe, KeyframeId(3));
  ASSERT_GT(mapper.observations()[0].points.size(), 30U);
  float leftmost = 10;
  for (const SurfacePoint& p : mapper.observations()[0].points) {
    EXPECT_NEAR(p.point[2], 2.5, 1e-3);
    leftmost = std::min(leftmost, p.point[0]);
    if (p.normal.squaredNorm() > 0.5F) {
      EXPECT_LT(p.normal[2], -0.99F);
    }
  }
  // In the frame of the camera, not of its depth sensor.
  EXPECT_NEAR(leftmost, 0.2, 0.1);
  mapper.add(KeyframeId(3), wall_in_depth(camera, 1.5));
  ASSERT_EQ(mapper.observations().size(), 1U) << "what was told before is replaced";
  EXPECT_NEAR(mapper.observations()[0].points[0].point[2], 1.5, 1e-3);
}

TEST(FloorPlanMapper, MonocularOfKnownHeightSeesTheFloor) {
  FloorPlanMapperOptions options;
  Calibration calibration;
  calibration.camera = boards_camera();
  Frame frame;
  frame.image = boards_image(SE3());
  FloorPlanMapper blind(options, calibration);
  blind.add(KeyframeId(0), frame);
  EXPECT_TRUE(blind.observations()[0].points.empty()) << "nothing gives lengths";
  calibration.camera_height_m = kBoardsHeight_m;
  FloorPlanMapper mapper(options, calibration);
  mapper.add(KeyframeId(0), frame);
  ASSERT_GT(mapper.observations()[0].points.size(), 20U);
  int floor = 0, on_floor = 0;
  for (const SurfacePoint& p : mapper.observations()[0].points)
    if (p.normal[1] < -0.9F) {
      ++floor;
      on_floor += std::abs(p.point[1] - kBoardsHeight_m) < 0.15;
    }
  ASSERT_GT(floor, 10);
  EXPECT_GT(on_floor, 0.9 * floor);
}

TEST(FloorPlanMapper, AMapIsReadByItsKeyframesThatAreApart) {
  const Camera camera{160, 120, 130, 130, 79.5, 59.5};
  const Calibration calibration{.camera = camera,
                                .baseline_m = 0,
                                .depth = DepthCamera{camera, SE3(), 0.005},
                                .camera_height_m = {}};
  std::vector<SE3> poses;
  for (int i = 0; i < 6; ++i) poses.push_back(SE3(SO3(), Eigen::Vector3d(0.1 * i, 0, 0)));
  std::vector<KeyframeId> read;
  const FloorPlan plan =
      map_floor_plan(posed_map(poses), calibration, [&](const Keyframe& keyframe) {
        read.push_back(keyframe.id);
        return wall_in_depth(camera, 2);
      });
  EXPECT_EQ(read, test::ids<KeyframeId>({0, 2, 4})) << "0.15 m apart";
  EXPECT_EQ(plan.outcome.code, Outcome::Code::kDegenerate) << "a wall alone is no building";
}

TEST(FloorPlanMapper, RefusesOptionsThatCannotBe) {
  FloorPlanMapperOptions options;
  options.cell_m = 0;
  EXPECT_THROW(FloorPlanMapper(options, {}), ArgumentError);
  NearbyViewOptions views{0.5, 0.2, 20};
  EXPECT_THROW(views.check(), ArgumentError);
}

TEST(FloorPlanMapper, LabelsPlacesOncePerRoom) {
  FloorPlan plan;
  plan.rooms.resize(2);
  plan.rooms[0].label = "room 1", plan.rooms[0].places = test::ids<PlaceId>({4});
  plan.rooms[1].label = "corridor 1", plan.rooms[1].places = test::ids<PlaceId>({4, 5});
  PlaceGraph graph;
  for (const PlaceId id : test::ids<PlaceId>({4, 5, 6})) graph.places.emplace_back().id = id;
  graph.places[1].labels = {"kitchen"};
  label_places(plan, graph);
  label_places(plan, graph);
  EXPECT_EQ(graph.places[0].labels, (std::vector<std::string>{"room 1", "corridor 1"}));
  EXPECT_EQ(graph.places[1].labels, (std::vector<std::string>{"kitchen", "corridor 1"}));
  EXPECT_TRUE(graph.places[2].labels.empty());
}

}  // namespace floor_plan_mapper_test
}  // namespace placegraph
