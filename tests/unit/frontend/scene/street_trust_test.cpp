#include <gtest/gtest.h>
#include <placegraph/frontend/labels/joint_labels.h>
#include <placegraph/frontend/scene/environment.h>
#include <placegraph/graph/core/error.h>

#include <numeric>

namespace placegraph {
namespace street_trust_test {

/// Street, road, corridor, room, hall.
constexpr EnvironmentProbabilities kStreetLike{0.7, 0.1, 0.1, 0.05, 0.05};
constexpr EnvironmentProbabilities kRoomLike{0.05, 0.05, 0.2, 0.6, 0.1};

double sum(const EnvironmentProbabilities& kinds) {
  return std::accumulate(kinds.begin(), kinds.end(), 0.0);
}

TEST(StreetProbability, IsThatOfTheKindsOutdoors) {
  EXPECT_NEAR(street_probability(kStreetLike), 0.8, 1e-12);
  EXPECT_NEAR(street_probability(kRoomLike), 0.1, 1e-12);
}

TEST(SmoothedKinds, TakeTheEvidenceBeforeAndBehind) {
  const std::vector<EnvironmentProbabilities> rooms(9, kRoomLike);
  std::vector<EnvironmentProbabilities> views = rooms;
  views[4] = kStreetLike;  // one view that looks like a street
  const auto smoothed = smoothed_kinds(views), of_rooms = smoothed_kinds(rooms);
  ASSERT_EQ(smoothed.size(), views.size());
  for (std::size_t at = 0; at < views.size(); ++at) {
    EXPECT_NEAR(sum(smoothed[at]), 1, 1e-12);
    EXPECT_LT(street_probability(smoothed[at]), 0.1) << at;
    EXPECT_GE(street_probability(smoothed[at]), street_probability(of_rooms[at]));
  }
  EXPECT_TRUE(smoothed_kinds({}).empty());
}

TEST(SmoothedKinds, FollowAChangeOfTheEnvironment) {
  std::vector<EnvironmentProbabilities> views(20, kStreetLike);
  std::fill(views.begin() + 10, views.end(), kRoomLike);
  EXPECT_GT(street_probability(smoothed_kinds(views)[2]), 0.95);
  EXPECT_LT(street_probability(smoothed_kinds(views)[17]), 0.05);
}

TEST(SmoothedKinds, AreTheSameInTheOtherDirection) {
  const std::vector<EnvironmentProbabilities> views{kStreetLike, kRoomLike, kRoomLike, kStreetLike,
                                                    kStreetLike};
  const auto there = smoothed_kinds(views), back = smoothed_kinds({views.rbegin(), views.rend()});
  for (std::size_t at = 0; at < views.size(); ++at)
    for (std::size_t k = 0; k < kEnvironmentCount; ++k)
      EXPECT_NEAR(there[at][k], back[views.size() - 1 - at][k], 1e-12);
}

/// An image of three superpixels beside each other; of two classes the first has the probability
/// 0.95, 0.7 and 0.4.
class StreetLabels : public testing::Test {
 protected:
  StreetLabels() {
    view.rows = view.superpixels.rows = 1;
    view.cols = view.superpixels.cols = 3;
    view.superpixels.count = 3;
    view.superpixels.index = Image(1, 3, CV_32SC1);
    for (int i = 0; i < 3; ++i) view.superpixels.index.at<int>(0, i) = i;
  }
  std::vector<int> labels(double street, double unknown_below = 0) const {
    const SceneLabels found = street_labels(probabilities, 2, view, street, unknown_below);
    std::vector<int> numbers;
    for (int i = 0; i < 3; ++i) numbers.push_back(found.labels.at<std::uint8_t>(0, i));
    return numbers;
  }
  SceneView view;
  std::vector<float> probabilities{0.95F, 0.05F, 0.7F, 0.3F, 0.4F, 0.6F};
};

TEST_F(StreetLabels, AreNoneWhereARoomIsMoreProbable) {
  EXPECT_EQ(labels(1), (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(labels(0.9), (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(labels(0.6), (std::vector<int>{0, 0, 2}));  // 0.6 x 0.6 is less than 0.4
  EXPECT_EQ(labels(0.55), (std::vector<int>{0, 2, 2}));
  EXPECT_EQ(labels(0.4), (std::vector<int>{2, 2, 2}));
  EXPECT_EQ(labels(0), (std::vector<int>{2, 2, 2}));
}

TEST_F(StreetLabels, AreUnknownWhereTheClassIsUncertain) {
  EXPECT_EQ(labels(1, 0.65), (std::vector<int>{0, 0, 2}));
  EXPECT_EQ(labels(0.55, 0.65), (std::vector<int>{0, 2, 2}));
  EXPECT_THROW(labels(1.5), ArgumentError);
}

}  // namespace street_trust_test
}  // namespace placegraph
