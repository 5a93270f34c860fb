#include <gtest/gtest.h>
#include <placegraph/frontend/places/place_recognizer.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/loops/keyframe_describer.h>
#include <placegraph/pipeline/map/map_learner.h>
#include <placegraph/pipeline/map/map_localizer.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/scenes/street.h"
#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace map_localizer_test {

using namespace test;

constexpr int kRoom = 6, kRooms = 8;

Image room_view(std::size_t room, double shift_px) {
  const Texture wall{.seed = 10 + room, .wavelength = 50, .octaves = 3, .contrast = 50};
  return texture_image(160, 120, wall, shift_px);
}
/// Views of rooms one after the other, a few pixels between two.
StoredMap rooms(bool in_colour = false) {
  return learn_map(kRoom * kRooms,
                   [&](std::size_t i) {
                     const Image grey = room_view(i / kRoom, 3.0 * static_cast<double>(i % kRoom));
                     if (!in_colour) return grey;
                     Image colour;
                     cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
                     return colour;
                   },
                   1000, {});
}
Frame frame_of(const Image& grey) {
  Frame frame;
  frame.image = grey;
  return frame;
}

TEST(MapLocalizer, PlacesViewsInTheirRoom) {
  const StoredMap stored = rooms();
  const MapLocalizer localizer({}, stored);
  const auto found = localizer.localize(
      kRooms, [](std::size_t i) { return frame_of(room_view(i, 7.5)); }, false);
  ASSERT_EQ(found.size(), static_cast<std::size_t>(kRooms));
  for (std::size_t i = 0; i < kRooms; ++i) {
    ASSERT_TRUE(found[i].placed) << i << " " << found[i].stage << " " << found[i].probability;
    EXPECT_EQ(found[i].keyframe->value() / kRoom, static_cast<std::int64_t>(i));
    EXPECT_EQ(found[i].frame, FrameId(1000 + found[i].keyframe->value()));
    EXPECT_EQ(found[i].place, stored.map.find_keyframe(*found[i].keyframe)->place);
    EXPECT_EQ(found[i].stage, "appearance");
    EXPECT_FALSE(found[i].T_map_cam);
    EXPECT_NE(found[i].without_pose.find("the map has no camera"), std::string::npos);
  }
}

TEST(MapLocalizer, IsUnsureOfRoomsThatItHasNotSeen) {
  const MapLocalizer localizer({}, rooms());
  const auto found = localizer.localize(
      10, [](std::size_t i) { return frame_of(room_view(100 + i, 0)); }, false);
  ASSERT_EQ(found.size(), 10u);
  int placed = 0;
  for (const Localization& estimate : found) {
    placed += estimate.placed;
    if (!estimate.placed) {
      EXPECT_EQ(estimate.stage, "appearance");
      EXPECT_LT(estimate.probability, LocalizerOptions().min_probability);
    }
  }
  EXPECT_LE(placed, 1);  // 95 % sure
}

TEST(MapLocalizer, ImagesOfOneDriveSupportEachOther) {
  const MapLocalizer localizer({}, rooms());
  const auto frames = [](std::size_t i) {
    return frame_of(room_view(2 + i / kRoom, 3.0 * static_cast<double>(i % kRoom) + 1));
  };
  const auto found = localizer.localize(2 * kRoom, frames, true);
  ASSERT_EQ(found.size(), static_cast<std::size_t>(2 * kRoom));
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(found[i].placed) << i;
    EXPECT_EQ(found[i].keyframe->value() / kRoom, static_cast<std::int64_t>(2 + i / kRoom)) << i;
  }
}

TEST(MapLocalizer, RefusesAnImageThatItCannotCompareAndPlacesTheOthers) {
  const MapLocalizer localizer({}, rooms(true));
  const auto in_colour = [](const Image& grey) {
    Frame frame = frame_of(grey);
    cv::cvtColor(grey, frame.colour, cv::COLOR_GRAY2BGR);
    return frame;
  };
  for (const bool sequence : {false, true}) {
    const auto found = localizer.localize(
        6,
        [&](std::size_t i) {
          const Image view = room_view(2, 3.0 * static_cast<double>(i) + 1);
          return i == 1 ? frame_of(view) : i == 4 ? Frame() : in_colour(view);
        },
        sequence);
    ASSERT_EQ(found.size(), 6u);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].placed, i != 1 && i != 4) << i << sequence;
      EXPECT_EQ(found[i].stage, i == 1 ? "grey" : i == 4 ? "unreadable" : "appearance") << i;
      EXPECT_EQ(found[i].place.has_value(), i != 1 && i != 4) << i;
    }
  }
}

TEST(MapLocalizer, RefusesMapsThatItCannotCompareWith) {
  StoredMap few = rooms();
  few.map.keyframes.resize(9);
  EXPECT_THROW(MapLocalizer({}, few), ArgumentError);
  LocalizerOptions other;
  other.recognizer.cues.gradients = 0;
  EXPECT_THROW(MapLocalizer(other, rooms()), ArgumentError);
  LocalizerOptions faulty;
  faulty.min_probability = 0.2;
  EXPECT_THROW(MapLocalizer(faulty, rooms()), ArgumentError);
}

TEST(MapLocalizer, AMapWhoseViewsAllLookTheSameTellsNothing) {
  const StoredMap same = learn_map(
      12, [](std::size_t) { return room_view(0, 0); }, 0, MapLearnerOptions());
  const auto found = MapLocalizer({}, same).localize(
      2, [](std::size_t) { return frame_of(room_view(0, 0)); }, false);
  ASSERT_EQ(found.size(), 2u);
  for (const Localization& estimate : found) {
    EXPECT_FALSE(estimate.placed);
    EXPECT_EQ(estimate.stage, "calibration");
    EXPECT_EQ(estimate.probability, 0.5);
  }
}

/// A map with depth: keyframes along the street, their features placed by a depth image.
struct StreetMap {
  static constexpr int kFrames = 12;
  StoredMap stored;
  Calibration calibration;

  StreetMap() {
    const StreetDataset& dataset = drive();
    calibration = dataset.calibration(Sensor::kRgbd);
    stored.origin.calibration = calibration;
    stored.map.metric = true;
    const KeyframeDescriber describer({}, {}, calibration);
    for (int i = 0; i < kFrames; ++i) {
      const Frame frame = dataset.frame(static_cast<std::size_t>(i), Sensor::kRgbd);
      Keyframe keyframe;
      keyframe.id = KeyframeId(i);
      keyframe.place = PlaceId(i);
      keyframe.frame = FrameId(i);
      keyframe.features = describer.describe(KeyframeId(i), frame, {}).features;
      keyframe.view = describe_place(frame.image, {}, false);
      stored.map.keyframes.push_back(keyframe);
      Place place;
      place.id = PlaceId(i);
      place.anchor_keyframe = KeyframeId(i);
      place.T_map_place = street_T_world_cam(i);
      place.members = {{KeyframeId(i), SE3(), 1}};
      stored.map.place_graph.places.push_back(place);
    }
  }
  static const StreetDataset& drive() {
    static const StreetDataset dataset(kFrames, 0, 0, true);
    return dataset;
  }
};

TEST(MapLocalizer, FeaturesOfKnownDepthGiveThePose) {
  const StreetMap street;
  const MapLocalizer localizer({}, street.stored);
  const SE3 T_world_cam = street_T_world_cam(4) * pose({0, 0.01, 0}, {0.05, 0, 0.15});
  const Image seen = render(street_camera(), T_world_cam, test::street(), 2).grey;
  const auto found = localizer
                         .localize(
                             1, [&](std::size_t) { return frame_of(seen); }, false)
                         .front();
  ASSERT_TRUE(found.placed) << found.stage;
  EXPECT_EQ(found.stage, "geometry");
  EXPECT_GT(found.probability, 0.99);
  EXPECT_TRUE(found.without_pose.empty());
  ASSERT_TRUE(found.T_map_cam);
  EXPECT_LT((found.T_map_cam->inverse() * T_world_cam).log().norm(), 0.05);
}

TEST(MapLocalizer, AnImageOfAnotherSizeIsByAnUnknownCamera) {
  const StreetMap street;
  Image half;
  cv::resize(StreetMap::drive().frame(4, Sensor::kMono).image, half, {224, 140});
  LocalizerOptions options;
  options.min_probability = 0.5;  // any answer
  const auto found = MapLocalizer(options, street.stored)
                         .localize(
                             1, [&](std::size_t) { return frame_of(half); }, false)
                         .front();
  EXPECT_FALSE(found.T_map_cam);
  ASSERT_TRUE(found.placed);
  EXPECT_NE(found.without_pose.find("224 x 140"), std::string::npos) << found.without_pose;
}

TEST(MapLocalizer, GeometryMayBeLeftOut) {
  const StreetMap street;
  LocalizerOptions options;
  options.geometry = false;
  const auto found = MapLocalizer(options, street.stored)
                         .localize(
                             1,
                             [](std::size_t) {
                               return frame_of(StreetMap::drive().frame(4, Sensor::kMono).image);
                             },
                             false)
                         .front();
  EXPECT_NE(found.stage, "geometry");
  EXPECT_FALSE(found.T_map_cam);
}

}  // namespace map_localizer_test
}  // namespace placegraph
