#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/map/map_learner.h>

#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace map_learner_test {

using namespace test;

constexpr int kRoom = 8;  // images of one room

/// A walk through rooms, each with a wall of its own texture that moves by a few pixels.
Image walk(std::size_t i) {
  const Texture wall{.seed = 10 + i / kRoom, .wavelength = 50, .octaves = 3, .contrast = 50};
  return texture_image(160, 120, wall, 2.0 * static_cast<double>(i % kRoom));
}
StoredMap learned(std::size_t count, std::int64_t first = 0,
                  const MapLearnerOptions& options = {}) {
  return learn_map(count, walk, first, options);
}

TEST(MapLearner, APlaceIsAStretchOfImagesThatLookTheSame) {
  const StoredMap stored = learned(3 * kRoom);
  const auto& places = stored.map.place_graph.places;
  ASSERT_EQ(places.size(), 3u);
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_EQ(places[p].id, PlaceId(p));
    // The first image of a room is like neither the room before nor any other: it may still count
    // among those before.
    const std::int64_t late =
        places[p].anchor_keyframe.value() - static_cast<std::int64_t>(p) * kRoom;
    EXPECT_GE(late, 0);
    EXPECT_LE(late, p == 0 ? 0 : 1);
    const std::int64_t end = p < 2 ? places[p + 1].anchor_keyframe.value() : 3 * kRoom;
    EXPECT_EQ(places[p].members.size(),
              static_cast<std::size_t>(end - places[p].anchor_keyframe.value()));
    EXPECT_EQ(places[p].members.front().keyframe, places[p].anchor_keyframe);
  }
}

TEST(MapLearner, EveryImageIsAKeyframeWithItsViewAndNoPose) {
  const StoredMap stored = learned(12, 100);
  ASSERT_EQ(stored.map.keyframes.size(), 12u);
  ASSERT_EQ(stored.map.frames.size(), 12u);
  ASSERT_EQ(stored.map.trajectory_online.poses.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    const auto id = static_cast<std::int64_t>(i);
    const Keyframe& keyframe = stored.map.keyframes[i];
    EXPECT_EQ(keyframe.id, KeyframeId(id));
    EXPECT_EQ(keyframe.frame, FrameId(100 + id));
    EXPECT_FALSE(keyframe.view.empty());
    EXPECT_EQ(stored.map.frames[i].frame, FrameId(100 + id));
    EXPECT_EQ(stored.map.frames[i].keyframe, KeyframeId(id));
    EXPECT_FALSE(stored.map.frames[i].T_keyframe_frame);
    EXPECT_FALSE(stored.map.trajectory_online.poses[i].T_world_body);
    const Place& place = *stored.map.place_graph.find(keyframe.place);
    EXPECT_TRUE(std::any_of(place.members.begin(), place.members.end(),
                            [&](const PlaceMember& m) { return m.keyframe == KeyframeId(id); }));
  }
  EXPECT_FALSE(stored.origin.calibration);
  EXPECT_FALSE(stored.map.metric);
}

TEST(MapLearner, TheShareThatEndsAPlaceIsAnOption) {
  MapLearnerOptions never, always;
  never.similar = 0;
  always.similar = 1;
  const std::size_t few = learned(3 * kRoom, 0, never).map.place_graph.places.size(),
                    many = learned(3 * kRoom, 0, always).map.place_graph.places.size();
  EXPECT_LE(few, 3u);
  EXPECT_GT(many, 3u);
  always.similar = 1.5;
  EXPECT_THROW((void)learned(12, 0, always), ArgumentError);
}

TEST(MapLearner, FewImagesAreNoMap) {
  EXPECT_THROW((void)learned(9), ArgumentError);
  EXPECT_NO_THROW((void)learned(10));
}

TEST(MapLearner, CuesOfNoWeightAreLeftOut) {
  MapLearnerOptions options;
  options.cues.gradients = 0;
  for (const Keyframe& keyframe : learned(10, 0, options).map.keyframes) {
    EXPECT_TRUE(keyframe.view.gradients.empty());
    EXPECT_FALSE(keyframe.view.tiny.empty());
  }
}

}  // namespace map_learner_test
}  // namespace placegraph
