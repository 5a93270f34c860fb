#include <numbers>

#include <gtest/gtest.h>
#include <placegraph/eval/loops/place_check.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {
namespace place_check_test {

/// A round of `stations` places 10 m apart along a circle, one view a frame, `rounds` times; the
/// view of frame i is put into place `place_of(i)`.
struct Rounds {
  Map map;
  Trajectory truth;
};

template <class PlaceOf>
Rounds drive(int stations, int rounds, PlaceOf place_of) {
  Rounds result;
  const double step = 2 * std::numbers::pi / stations, radius = 10 / step;
  for (int i = 0; i < stations * rounds; ++i) {
    const Eigen::AngleAxisd rotation(step * i, Eigen::Vector3d::UnitY());
    Eigen::Isometry3d T_world_cam = Eigen::Isometry3d::Identity();
    T_world_cam.linear() = rotation.toRotationMatrix();
    T_world_cam.translation() = rotation * Eigen::Vector3d(-radius, 0, 0);
    result.truth.poses.push_back({i, T_world_cam});
    Keyframe keyframe;
    keyframe.id = KeyframeId(i);
    keyframe.frame = FrameId(i);
    keyframe.place = PlaceId(place_of(i));
    if (!result.map.place_graph.find(keyframe.place)) {
      Place place;
      place.id = PlaceId(keyframe.place);
      place.anchor_keyframe = KeyframeId(i);
      result.map.place_graph.places.push_back(place);
    }
    result.map.keyframes.push_back(keyframe);
    result.map.frames.push_back({FrameId(i), i, KeyframeId(i), SE3()});
  }
  return result;
}

PlaceCheckOptions round_of(int stations) {
  PlaceCheckOptions options;
  options.revisit.min_age = stations;
  return options;
}

TEST(PlaceCheck, FindsNothingWrongWithTwoRoundsOverTheSamePlaces) {
  const Rounds rounds = drive(40, 2, [](int i) { return i % 40; });
  const PlaceCheck check = check_places(rounds.map, rounds.truth, round_of(40));
  EXPECT_EQ(check.places, 40);
  EXPECT_EQ(check.pairs, 40);
  EXPECT_EQ(check.purity(), 1);
  EXPECT_EQ(check.revisited_places, 40);
  EXPECT_EQ(check.added_places, 0);
  EXPECT_EQ(check.adjacent, 40);
  EXPECT_EQ(check.adjacency_precision(), 1);
  EXPECT_EQ(check.adjacency_recall(), 1);
}

TEST(PlaceCheck, CountsThePlacesThatASecondRoundAdds) {
  const Rounds rounds = drive(40, 2, [](int i) { return i == 43 || i == 44 ? i : i % 40; });
  const PlaceCheck check = check_places(rounds.map, rounds.truth, round_of(40));
  EXPECT_EQ(check.places, 42);
  EXPECT_EQ(check.revisited_places, 40);
  EXPECT_EQ(check.added_places, 2);
  EXPECT_DOUBLE_EQ(check.growth(), 0.05);
}

TEST(PlaceCheck, SeesViewsOfPlacesFarApartInOneAndTheWaysThatAreNone) {
  // Frame 60 is put where frame 5 was, which is 150 m off.
  const Rounds rounds = drive(40, 2, [](int i) { return i == 60 ? 5 : i % 40; });
  const PlaceCheck check = check_places(rounds.map, rounds.truth, round_of(40));
  EXPECT_EQ(check.pairs, 38 + 3);  // two views of 38 places, three of one, one of another
  EXPECT_EQ(check.pure_pairs, check.pairs - 2);
  EXPECT_EQ(check.adjacent, 42);
  EXPECT_EQ(check.common, 40);
  EXPECT_DOUBLE_EQ(check.adjacency_precision(), 40.0 / 42);
  EXPECT_EQ(check.adjacency_recall(), 1);
}

TEST(PlaceCheck, RefusesFramesBeyondTheTruth) {
  Rounds rounds = drive(10, 1, [](int i) { return i; });
  rounds.truth.poses.pop_back();
  EXPECT_THROW((void)check_places(rounds.map, rounds.truth), ArgumentError);
}

}  // namespace place_check_test
}  // namespace placegraph
