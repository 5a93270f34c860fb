#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/map_index.h>

#include <numbers>

namespace placegraph {
namespace map_test {

/// Two places, the second of `component`; keyframes 100 (anchor) and 101 hang on the first, 200 on
/// the second; frames: 0 on 100, 1 on 101, 2 lost, 3 on 200.
Map make_map(int component) {
  Map map;
  const SE3 T_place_101(SO3(), {0, 0, 1});
  map.place_graph.places = {{PlaceId(0),
                             KeyframeId(100),
                             SE3(),
                             0,
                             {{KeyframeId(100), SE3()}, {KeyframeId(101), T_place_101}},
                             {},
                             {}},
                            {PlaceId(1),
                             KeyframeId(200),
                             SE3(SO3(), {50, 0, 0}),
                             component,
                             {{KeyframeId(200), SE3()}},
                             {},
                             {}}};
  map.keyframes = {{KeyframeId(100), FrameId(0), 0, PlaceId(0), SE3(), {}, 1, {}},
                   {KeyframeId(101), FrameId(1), 100, PlaceId(0), T_place_101, {}, 1, {}},
                   {KeyframeId(200), FrameId(3), 300, PlaceId(1), SE3(), {}, 1, {}}};
  map.frames = {{FrameId(0), 0, KeyframeId(100), SE3()},
                {FrameId(1), 100, KeyframeId(101), SE3(SO3(), {0.5, 0, 0})},
                {FrameId(2), 200, std::nullopt, std::nullopt},
                {FrameId(3), 300, KeyframeId(200), SE3()}};
  return map;
}

void join(Map& map) {
  RelativePoseConstraint constraint;
  constraint.from = NodeId(0);
  constraint.to = NodeId(1);
  constraint.T_from_to = SE3();
  constraint.information = Matrix6d::Identity();
  map.place_graph.constraints.push_back(constraint);
}

TEST(Map, FindsKeyframesById) {
  const Map map = make_map(0);
  EXPECT_EQ(map.find_keyframe(KeyframeId(200)), &map.keyframes[2]);
  EXPECT_EQ(map.find_keyframe(KeyframeId(2)), nullptr);
}

TEST(Map, FramesArePosedThroughKeyframeAndPlace) {
  const Trajectory trajectory = make_map(0).trajectory_optimized();
  ASSERT_EQ(trajectory.size(), 4u);
  EXPECT_TRUE(trajectory.has_times);
  EXPECT_EQ(trajectory.poses[1].stamp_ns, 100);
  ASSERT_TRUE(trajectory.poses[1].T_world_body);
  EXPECT_EQ(trajectory.poses[1].T_world_body->translation(), Eigen::Vector3d(0.5, 0, 1));
  EXPECT_FALSE(trajectory.poses[2].T_world_body);
  ASSERT_TRUE(trajectory.poses[3].T_world_body);
  EXPECT_EQ(trajectory.poses[3].T_world_body->translation(), Eigen::Vector3d(50, 0, 0));
}

TEST(Map, AFrameMovesWithItsPlace) {
  Map map = make_map(0);
  map.place_graph.places[0].T_map_place = SE3(SO3::exp({0, std::numbers::pi / 2, 0}), {10, 0, 0});
  const auto pose = map.trajectory_optimized().poses[1].T_world_body;
  ASSERT_TRUE(pose);
  // A quarter turn about y takes z to x and x to -z.
  EXPECT_NEAR((pose->translation() - Eigen::Vector3d(11, 0, -0.5)).norm(), 0, 1e-14);
}

TEST(Map, AFrameMovesWithItsKeyframe) {
  Map map = make_map(0);
  map.keyframes[1].T_place_keyframe = SE3(SO3(), {0, 3, 1});
  EXPECT_EQ(map.trajectory_optimized().poses[1].T_world_body->translation(),
            Eigen::Vector3d(0.5, 3, 1));
  EXPECT_EQ(map.trajectory_optimized().poses[0].T_world_body->translation(),
            Eigen::Vector3d(0, 0, 0));
}

TEST(Map, FramesAndLandmarksGrowWithTheUnitsOfPlaceAndKeyframe) {
  Map map = make_map(0);
  map.place_graph.places[0].T_map_place = SE3(SO3(), {10, 0, 0});
  map.place_graph.places[0].scale = 2;
  map.keyframes[1].scale = 3;  // 101, at (0, 0, 1) in the place's unit
  const Trajectory trajectory = map.trajectory_optimized();
  EXPECT_EQ(trajectory.poses[1].T_world_body->translation(), Eigen::Vector3d(13, 0, 2));
  EXPECT_NEAR(trajectory.poses[1].T_world_body->linear().determinant(), 1, 1e-14);
  EXPECT_EQ(map.position({LandmarkId(7), KeyframeId(101), {0, 1, 0}, 2}),
            Eigen::Vector3d(10, 6, 2));
  EXPECT_EQ(map.position({LandmarkId(8), KeyframeId(100), {0, 1, 0}, 2}),
            Eigen::Vector3d(10, 2, 0));
  EXPECT_THROW((void)map.position({LandmarkId(9), KeyframeId(300), {0, 1, 0}, 2}), ArgumentError);
  map.keyframes[1].place = PlaceId(9);
  EXPECT_THROW((void)map.S_map_keyframe(KeyframeId(101)), ArgumentError);
}

TEST(MapIndex, FindsWhatTheMapFinds) {
  Map map = make_map(4);
  const MapIndex index(map);
  for (const Keyframe& keyframe : map.keyframes) {
    const auto at = index.find(keyframe.id);
    ASSERT_TRUE(at);
    EXPECT_EQ(at->keyframe, map.find_keyframe(keyframe.id));
    EXPECT_EQ(at->place, map.place_graph.find(keyframe.place));
    EXPECT_EQ(at->S_map_keyframe().translation(), map.S_map_keyframe(keyframe.id).translation());
  }
  EXPECT_FALSE(index.find(KeyframeId(300)));
  map.keyframes[1].place = PlaceId(9);
  EXPECT_FALSE(MapIndex(map).find(map.keyframes[1].id));
}

TEST(Map, FramesOfAnotherComponentAreLostUntilAConstraintJoinsIt) {
  Map map = make_map(1);
  EXPECT_EQ(map.trajectory_optimized().posed(), 2u);
  EXPECT_FALSE(map.trajectory_optimized().poses[3].T_world_body);
  join(map);
  EXPECT_EQ(map.trajectory_optimized().posed(), 3u);
}

TEST(Map, ListsItsComponentsTheMainOneHasTheMostFrames) {
  Map map = make_map(4);
  auto components = map.components();
  ASSERT_EQ(components.size(), 2u);
  EXPECT_EQ(components[0].number, 0);
  EXPECT_TRUE(components[0].main);
  EXPECT_EQ(components[0].posed, 2u);
  EXPECT_EQ(components[0].last, 1u);
  EXPECT_EQ(components[1].number, 4);
  EXPECT_EQ(components[1].first, 3u);
  EXPECT_TRUE(map.trajectory_optimized(4).poses[3].T_world_body);
  EXPECT_EQ(map.trajectory_optimized(4).posed(), 1u);
  // Two more frames: the other component is the main one.
  for (int i = 4; i < 6; ++i) map.frames.push_back({FrameId(i), i * 100, KeyframeId(200), SE3()});
  EXPECT_EQ(map.main_component(), 4);
  EXPECT_EQ(map.trajectory_optimized().posed(), 3u);
  EXPECT_EQ(Map().main_component(), 0);
  EXPECT_TRUE(Map().components().empty());
}

TEST(Map, RefusesFramesAndKeyframesThatHangOnNothing) {
  Map map = make_map(0);
  map.frames[1].keyframe = KeyframeId(999);
  EXPECT_THROW(map.trajectory_optimized(), ArgumentError);
  map = make_map(0);
  map.keyframes[1].place = PlaceId(999);
  EXPECT_THROW(map.trajectory_optimized(), ArgumentError);
}

TEST(Map, ACopyIsASnapshot) {
  Map map = make_map(0);
  const Map snapshot = map;
  map.place_graph.places[0].T_map_place = SE3(SO3(), {1, 1, 1});
  EXPECT_EQ(snapshot.trajectory_optimized().poses[0].T_world_body->translation(),
            Eigen::Vector3d(0, 0, 0));
}

TEST(Map, OfNothingHasAnEmptyTrajectory) { EXPECT_EQ(Map().trajectory_optimized().size(), 0u); }

}  // namespace map_test
}  // namespace placegraph
