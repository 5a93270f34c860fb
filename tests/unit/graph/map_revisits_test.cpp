#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/map_revisits.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace placegraph {
namespace map_revisits_test {

/// A frame a metre along x, each a keyframe of the place given for it, at `x[i]`.
Map walk(const std::vector<int>& places, const std::vector<double>& x) {
  Map map;
  for (int id = 0; id <= *std::max_element(places.begin(), places.end()); ++id) {
    Place place;
    place.id = PlaceId(id);
    map.place_graph.places.push_back(place);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto id = static_cast<std::int64_t>(i);
    Keyframe keyframe;
    keyframe.id = KeyframeId(id);
    keyframe.frame = FrameId(id);
    keyframe.place = PlaceId(places[i]);
    keyframe.T_place_keyframe = SE3(SO3(), {x[i], 0, 0});
    map.keyframes.push_back(keyframe);
    map.frames.push_back({FrameId(id), 10 * id, KeyframeId(id), SE3()});
  }
  return map;
}

TEST(MapRevisits, AreTheNearestOlderFramesOfThePlaceAndItsNeighbours) {
  const Map map = walk({0, 0, 1, 1, 2, 0, 1}, {0, 1, 2, 3, 9, 1.2, 2.4});
  const auto found = map_revisits(map, {.min_age = 3});
  ASSERT_EQ(found.size(), 4u);
  const auto of = [&](std::int64_t query) {
    return *std::find_if(found.begin(), found.end(),
                         [&](const LoopPrediction& p) { return p.query == FrameId(query); });
  };
  EXPECT_EQ(of(5).candidate, FrameId(1));
  EXPECT_NEAR(of(5).score, 1 / 1.2, 1e-12);
  EXPECT_EQ(of(6).candidate, FrameId(2));
  EXPECT_NEAR(of(6).score, 1 / 1.4, 1e-12);
  EXPECT_EQ(of(4).candidate, FrameId(1));  // a step into another place, far away
  EXPECT_LT(of(4).score, 0.12);
}

TEST(MapRevisits, AreNoneWhereOnlyThePosesLieNear) {
  // The same way again, in places of its own: nothing has shown that it is the same.
  const Map map = walk({0, 1, 2, 3, 4, 5}, {0, 1, 2, 0, 1, 2});
  EXPECT_TRUE(map_revisits(map, {.min_age = 3}).empty());
}

TEST(MapRevisits, LookTheSameWay) {
  Map map = walk({0, 0, 0, 0}, {0, 1, 2, 0.5});
  map.keyframes[3].T_place_keyframe = SE3(SO3::exp({0, std::numbers::pi, 0}), {0.5, 0, 0});
  EXPECT_TRUE(map_revisits(map, {.min_age = 2, .max_angle_deg = 30}).size() == 1);  // frame 2
  EXPECT_THROW((void)map_revisits(map, {.min_age = 0}), ArgumentError);
}

}  // namespace map_revisits_test
}  // namespace placegraph
