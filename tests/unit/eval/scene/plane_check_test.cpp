#include <gtest/gtest.h>
#include <placegraph/eval/scene/plane_check.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {
namespace plane_check_test {

/// `count` times each label.
std::vector<int> labels(const std::vector<std::pair<int, int>>& runs) {
  std::vector<int> result;
  for (const auto& [label, count] : runs) result.insert(result.end(), count, label);
  return result;
}

TEST(PlaneCheck, CountsWhatIsFoundWhateverItsLabel) {
  const PlaneCheck check = check_planes(labels({{1, 100}, {2, 50}, {0, 20}}),
                                        labels({{7, 95}, {0, 5}, {3, 50}, {0, 20}}), {0.8, 0});
  EXPECT_EQ(check.truth, 2);
  EXPECT_EQ(check.correct, 2);
  EXPECT_EQ(check.missed + check.noise + check.over_segmented + check.under_segmented, 0);
  ASSERT_EQ(check.matches.size(), 2u);
  EXPECT_EQ(check.matches[0].found, 7);
  EXPECT_EQ(check.matches[0].common, 95);
}

TEST(PlaneCheck, AsksForTheOverlapBothWays) {
  // Found holds the true one, but a third of it lies elsewhere.
  const PlaneCheck check = check_planes(labels({{1, 100}, {0, 50}}), labels({{1, 150}}), {0.8, 0});
  EXPECT_EQ(check.correct, 0);
  EXPECT_EQ(check.missed, 1);
  EXPECT_EQ(check.noise, 1);
}

TEST(PlaneCheck, TellsPiecesAndJoints) {
  const PlaneCheck pieces =
      check_planes(labels({{1, 100}}), labels({{1, 50}, {2, 45}, {0, 5}}), {0.8, 0});
  EXPECT_EQ(pieces.over_segmented, 1);
  EXPECT_EQ(pieces.extra_pieces, 1);
  EXPECT_EQ(pieces.missed + pieces.noise, 0);
  EXPECT_DOUBLE_EQ(pieces.over_segmented_per_plane(), 1);
  const PlaneCheck joint = check_planes(labels({{1, 60}, {2, 40}}), labels({{4, 100}}), {0.8, 0});
  EXPECT_EQ(joint.under_segmented, 1);
  EXPECT_EQ(joint.correct, 0);
  EXPECT_EQ(joint.missed + joint.noise, 0);
}

TEST(PlaneCheck, LeavesSmallPlanesOut) {
  const PlaneCheck check =
      check_planes(labels({{1, 100}, {2, 5}}), labels({{1, 100}, {0, 5}}), {0.8, 10});
  EXPECT_EQ(check.truth, 1);
  EXPECT_EQ(check.correct, 1);
  EXPECT_EQ(check.missed, 0);
}

TEST(PlaneCheck, RefusesWhatCannotBe) {
  EXPECT_THROW((void)check_planes({1, 2}, {1}, {0.8, 0}), ArgumentError);
  EXPECT_THROW((void)check_planes({1}, {1}, {0.4, 0}), ArgumentError);
  EXPECT_EQ(check_planes({}, {}, {0.8, 0}).correct_share(), 0);
}

}  // namespace plane_check_test
}  // namespace placegraph
