#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/scene/map_keyframes.h>
#include <placegraph/pipeline/scene/street_mapper.h>

#include "tests/support/ids.h"
#include "tests/support/scenes/scene.h"

namespace placegraph {
namespace map_keyframes_test {

using namespace test;

/// Two places of two keyframes each; `scaled`: the second has a unit of twice the length.
Map two_places(bool scaled = false) {
  Map map;
  for (std::int64_t p = 0; p < 2; ++p) {
    Place place;
    place.id = PlaceId(10 * p);
    place.anchor_keyframe = KeyframeId(2 * p);
    place.component = static_cast<int>(p);
    place.T_map_place = pose({0, 0.2, 0}, {5.0 * static_cast<double>(p), 0, 1});
    if (p == 1 && scaled) place.scale = 2;
    for (std::int64_t k = 2 * p; k < 2 * p + 2; ++k) {
      Keyframe keyframe;
      keyframe.id = KeyframeId(k);
      keyframe.frame = FrameId(k);
      keyframe.stamp_ns = 100 * k;
      keyframe.place = place.id;
      keyframe.T_place_keyframe = pose({0, 0, 0}, {0, 0, k % 2 == 0 ? 0.0 : 0.5});
      place.members.push_back({KeyframeId(k), keyframe.T_place_keyframe, 1});
      map.keyframes.push_back(keyframe);
    }
    map.place_graph.places.push_back(place);
  }
  return map;
}
void join(Map& map) {
  RelativePoseConstraint edge;
  edge.from = NodeId(0), edge.to = NodeId(10);
  edge.T_from_to = SE3();
  edge.information = Matrix6d::Identity();
  map.place_graph.constraints.push_back(edge);
}

TEST(MapKeyframes, StandWherePlaceAndMemberPutThem) {
  const Map map = two_places();
  const SE3 expected = map.place_graph.places[1].T_map_place * pose({0, 0, 0}, {0, 0, 0.5});
  EXPECT_LT((camera_pose(map, KeyframeId(3)).inverse() * expected).log().norm(), 1e-12);
}

TEST(MapKeyframes, AreAsFarFromTheirPlaceAsItsUnitSays) {
  const Map map = two_places(true);
  const SE3 expected = map.place_graph.places[1].T_map_place * pose({0, 0, 0}, {0, 0, 1.0});
  EXPECT_LT((camera_pose(map, KeyframeId(3)).inverse() * expected).log().norm(), 1e-12);
}

TEST(MapKeyframes, OfAnUnknownNumberAreAMistake) {
  EXPECT_THROW((void)camera_pose(two_places(), KeyframeId(17)), ArgumentError);
}

TEST(MapKeyframes, AreConnectedWhereAConstraintJoinsTheirPlaces) {
  Map map = two_places();
  EXPECT_EQ(connected_keyframes(map), (std::set{KeyframeId(0), KeyframeId(1)}));
  EXPECT_FALSE(poses_of(map)(KeyframeId(2)));
  join(map);
  EXPECT_EQ(connected_keyframes(map),
            (std::set{KeyframeId(0), KeyframeId(1), KeyframeId(2), KeyframeId(3)}));
  ASSERT_TRUE(poses_of(map)(KeyframeId(2)));
  EXPECT_LT(distance_m(*poses_of(map)(KeyframeId(2)), map.place_graph.places[1].T_map_place),
            1e-12);
}

TEST(MapKeyframes, HadOnlinePosesWhereTheirFramesHad) {
  Map map = two_places();
  const SE3 T_online = pose({0, 0, 0.1}, {7, 8, 9});
  map.trajectory_online.poses = {
      {0, std::nullopt}, {100, T_online.isometry()}, {150, SE3().isometry()}};
  const KeyframePoses online = online_poses_of(map);
  EXPECT_FALSE(online(KeyframeId(0)));  // its frame was lost
  ASSERT_TRUE(online(KeyframeId(1)));
  EXPECT_LT((online(KeyframeId(1))->inverse() * T_online).log().norm(), 1e-12);
  EXPECT_FALSE(online(KeyframeId(2)));  // no such frame
}

TEST(MapKeyframes, ApartAreThoseThatMovedOrRotatedEnoughSinceTheOneBefore) {
  Map map;
  const double z[] = {0, 0.6, 1.1, 1.2, 1.3, 2.4};
  const double yaw[] = {0, 0, 0, 0.2, 0.25, 0.25};
  for (std::int64_t k = 0; k < 6; ++k) {
    Keyframe keyframe;
    keyframe.id = KeyframeId(k);
    keyframe.place = PlaceId(k);
    Place place;
    place.id = PlaceId(k);
    place.anchor_keyframe = KeyframeId(k);
    place.T_map_place = pose({0, yaw[k], 0}, {0, 0, z[k]});
    place.members = {{KeyframeId(k), SE3(), 1}};
    map.keyframes.push_back(keyframe);
    map.place_graph.places.push_back(place);
  }
  std::vector<KeyframeId> ids;
  for (const Keyframe* keyframe : keyframes_apart(map, 1, 0.1)) ids.push_back(keyframe->id);
  EXPECT_EQ(ids, test::ids<KeyframeId>({0, 2, 3, 5}));  // 3 has turned, 5 has moved
}

}  // namespace map_keyframes_test
}  // namespace placegraph
