#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/recognition/loop_truth.h>

namespace placegraph {
namespace loop_truth_test {

using ::testing::ElementsAre;

TEST(LoopTruth, OfAMatrixThatIsNotSquareIsOfTwoSets) {
  const LoopTruth truth = loop_truth_of_matrix({true, false, true, false, false, true}, 3);
  EXPECT_EQ(truth.protocol, LoopProtocol::kQueryDatabase);
  ASSERT_EQ(truth.queries.size(), 2u);
  EXPECT_THAT(truth.queries.at(FrameId(0)).matches, ElementsAre(FrameId(0), FrameId(2)));
  EXPECT_EQ(truth.queries.at(FrameId(1)).last, FrameId(2));
}

TEST(LoopTruth, OfASquareMatrixIsUndecidedAndKeepsItsDiagonal) {
  const LoopTruth truth = loop_truth_of_matrix({true, true, false, true}, 2);
  EXPECT_EQ(truth.protocol, LoopProtocol::kUndecided);
  EXPECT_THAT(truth.queries.at(FrameId(0)).matches, ElementsAre(FrameId(0), FrameId(1)));
  EXPECT_EQ(to_string(truth.protocol), "undecided");
  EXPECT_THROW(loop_truth_of_matrix({true, false, true}, 2), ArgumentError);
}

}  // namespace loop_truth_test
}  // namespace placegraph
