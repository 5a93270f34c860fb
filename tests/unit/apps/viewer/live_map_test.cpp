#include <gtest/gtest.h>

#include "apps/viewer/live_map.h"

namespace placegraph::apps {
namespace live_map_test {

SE3 at(double x) { return SE3(SO3(), Eigen::Vector3d(x, 0, 0)); }

FrameResult posed(int frame, double x, bool keyframe = false) {
  FrameResult result;
  result.frame = FrameId(frame);
  result.state = TrackingState::kTracking;
  result.T_map_cam = at(x);
  result.keyframe = keyframe;
  return result;
}

FrameView view_of(int landmark) {
  FrameView view;
  FrameView::Track& track = view.tracks.emplace_back();
  track.id = LandmarkId(landmark);
  track.point_cam = Eigen::Vector3d(0, 0, 5);
  return view;
}

/// Two places at 0 m and at 10 m, with a frame and a landmark each.
LiveMap two_places() {
  LiveMap map;
  map.add_keyframe({KeyframeId(0), FrameId(0), PlaceId(0), at(0)});
  map.add_place({PlaceId(0), KeyframeId(0), at(0), 0});
  (void)map.add_frame(posed(0, 0, true), view_of(1));
  map.add_keyframe({KeyframeId(1), FrameId(1), PlaceId(1), at(10)});
  map.add_place({PlaceId(1), KeyframeId(1), at(10), 0});
  (void)map.add_frame(posed(1, 11, true), view_of(2));
  return map;
}

double x_of(const LiveMap& map, std::size_t frame) {
  return map.frames()[frame].pose->translation().x();
}

TEST(LiveMap, FramesAndLandmarksMoveWithTheirPlaces) {
  LiveMap map = two_places();
  EXPECT_EQ(x_of(map, 1), 11);
  EXPECT_TRUE(map.landmarks()[1].isApprox(Eigen::Vector3d(11, 0, 5)));
  MapMoved moved;
  moved.poses = {{PlaceId(1), Sim3(at(8))}};
  map.move(moved);
  EXPECT_EQ(x_of(map, 0), 0);
  EXPECT_EQ(x_of(map, 1), 9);
  EXPECT_TRUE(map.landmarks()[1].isApprox(Eigen::Vector3d(9, 0, 5)));
}

TEST(LiveMap, AMergedPlaceLeavesItsFramesWhereTheyAre) {
  LiveMap map = two_places();
  map.merge({PlaceId(0), PlaceId(1)});
  EXPECT_EQ(x_of(map, 1), 11);
  MapMoved moved;
  moved.poses = {{PlaceId(0), Sim3(at(1))}};
  map.move(moved);
  EXPECT_EQ(x_of(map, 1), 12);
}

TEST(LiveMap, AScaleThatBecomesKnownChangesAllLengths) {
  LiveMap map = two_places();
  MapMoved moved;
  moved.scale = 2;
  moved.poses = {{PlaceId(1), Sim3(at(20))}};
  map.move(moved);
  EXPECT_EQ(x_of(map, 1), 22);
  EXPECT_TRUE(map.landmarks()[0].isApprox(Eigen::Vector3d(0, 0, 10)));
}

TEST(LiveMap, ReportsANewLandmarkOnceAndOnlyOfKeyframes) {
  LiveMap map = two_places();
  EXPECT_TRUE(map.add_frame(posed(2, 12, true), view_of(2)).empty());
  EXPECT_TRUE(map.add_frame(posed(3, 12), view_of(3)).empty());
  EXPECT_EQ(map.add_frame(posed(4, 12, true), view_of(3)).size(), 1u);
}

TEST(LiveMap, AFrameWithoutAPoseHasNoComponent) {
  LiveMap map = two_places();
  FrameResult lost;
  lost.frame = FrameId(2);
  (void)map.add_frame(lost, {});
  EXPECT_EQ(map.frames()[2].component, -1);
  EXPECT_FALSE(map.frames()[2].pose);
  map.join({0, 3});
  EXPECT_EQ(map.frames()[1].component, 3);
  map.clear();
  EXPECT_TRUE(map.frames().empty());
}

}  // namespace live_map_test
}  // namespace placegraph::apps
