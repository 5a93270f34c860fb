#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/place_transitions.h>

namespace placegraph {
namespace place_transitions_test {

/// Keyframe i is of place `places[i]`; frame i hangs on keyframe i, or is lost where it is -1.
Map map_of(const std::vector<int>& places, const std::vector<int>& components) {
  Map map;
  for (std::size_t i = 0; i < components.size(); ++i) {
    Place place;
    place.id = PlaceId(i);
    place.component = components[i];
    map.place_graph.places.push_back(place);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i);
    FrameRecord frame{FrameId(id), 10 * id, std::nullopt, std::nullopt, 0};
    if (places[i] >= 0) {
      Keyframe keyframe;
      keyframe.id = KeyframeId(id);
      keyframe.frame = FrameId(id);
      keyframe.place = PlaceId(places[i]);
      map.keyframes.push_back(keyframe);
      frame.keyframe = KeyframeId(id);
      frame.T_keyframe_frame = SE3();
    }
    map.frames.push_back(frame);
  }
  return map;
}

TEST(PlaceTransitions, CountsEveryWayFromPlaceToPlaceByDirection) {
  const auto found = place_transitions(map_of({0, 0, 1, 2, 1, 2, 2, 0}, {0, 0, 0}));
  ASSERT_EQ(found.size(), 4u);
  const std::vector<std::array<std::int64_t, 3>> expected{
      {0, 1, 1}, {1, 2, 2}, {2, 0, 1}, {2, 1, 1}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(found[i].from, PlaceId(expected[i][0]));
    EXPECT_EQ(found[i].to, PlaceId(expected[i][1]));
    EXPECT_EQ(found[i].count, expected[i][2]);
  }
}

TEST(PlaceTransitions, DoNotLeadOverLostFramesOrIntoAnotherComponent) {
  EXPECT_TRUE(place_transitions(map_of({0, -1, 1}, {0, 0})).empty());
  EXPECT_TRUE(place_transitions(map_of({0, 1}, {0, 1})).empty());
  EXPECT_TRUE(place_transitions({}).empty());
}

TEST(PlaceTransitions, RefuseAFrameWhoseKeyframeIsNotThere) {
  Map map = map_of({0, 0}, {0});
  map.frames[1].keyframe = KeyframeId(7);
  EXPECT_THROW((void)place_transitions(map), ArgumentError);
}

}  // namespace place_transitions_test
}  // namespace placegraph
