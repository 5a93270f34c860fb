#include <gtest/gtest.h>
#include <placegraph/pipeline/slam/environment_monitor.h>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace environment_monitor_test {

using namespace test;

const Frame& street_frame() {
  static const Frame frame = StreetDataset(1).frame(0, Sensor::kMono);
  return frame;
}

/// Keyframes 0 to `count` - 1, which all show the same.
EnvironmentMonitor monitor(int count, int* changes = nullptr) {
  EnvironmentMonitor monitor({}, street_camera());
  for (int k = 0; k < count; ++k) {
    const bool changed = monitor.classify(KeyframeId(k), street_frame(), nullptr, {}, false);
    if (changes) *changes += changed;
  }
  return monitor;
}
std::vector<Place> place_of(const std::vector<std::int64_t>& keyframes) {
  Place place;
  for (const std::int64_t keyframe : keyframes) {
    PlaceMember member;
    member.keyframe = KeyframeId(keyframe);
    place.members.push_back(member);
  }
  return {place};
}

TEST(EnvironmentMonitor, ObservesEveryKeyframeAndSaysWhenTheKindChanges) {
  int changes = 0;
  const EnvironmentMonitor m = monitor(12, &changes);
  ASSERT_EQ(m.observations().size(), 12u);
  int different = 0;
  std::optional<Environment> last;
  for (const EnvironmentObservation& o : m.observations()) {
    different += o.kind != last;
    last = o.kind;
    double sum = 0;
    for (const double p : o.probabilities) sum += p;
    EXPECT_NEAR(sum, 1, 1e-9);
  }
  EXPECT_EQ(changes, different);
  EXPECT_EQ(m.kind(), last);
}

TEST(EnvironmentMonitor, APlaceHasTheKindOfMostOfItsKeyframes) {
  const EnvironmentMonitor m = monitor(12);
  std::vector<Place> places = place_of({9, 10, 11});
  m.label(places);
  std::vector<Place> expected = place_of({});
  if (const auto kind = m.observations().back().kind) label_environment(expected[0], *kind);
  EXPECT_EQ(places[0].labels, expected[0].labels);
}

TEST(EnvironmentMonitor, KeyframesThatWereNotSeenLabelNothing) {
  const EnvironmentMonitor m = monitor(12);
  std::vector<Place> places = place_of({100, 101});
  m.label(places);
  EXPECT_TRUE(places[0].labels.empty());
  std::vector<Place> none = place_of({0});
  EnvironmentMonitor({}, street_camera()).label(none);
  EXPECT_TRUE(none[0].labels.empty());
}

}  // namespace environment_monitor_test
}  // namespace placegraph
