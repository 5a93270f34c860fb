#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/text/spelling.h>

namespace placegraph {
namespace spelling_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(EditDistance, CountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("rnu", "run"), 1U);
  EXPECT_EQ(edit_distance("ca", "abc"), 3U);
}

TEST(SimilarSpellings, AreTheNearestFirstAndAtMostThree) {
  EXPECT_THAT(similar_spellings("camera-heigth", {"camera", "camera-height", "seed"}),
              ElementsAre("camera-height"));
  EXPECT_THAT(similar_spellings("abcdefgh", {"abcdefgx", "abcdefgh", "abcdefxx", "abcdexxx"}),
              ElementsAre("abcdefgh", "abcdefgx", "abcdefxx"));
}

TEST(SimilarSpellings, LeaveOutWhatSharesLessThanHalf) {
  EXPECT_THAT(similar_spellings("xyz", {"run", "map"}), IsEmpty());
  EXPECT_THAT(similar_spellings("rn", {"run"}), ElementsAre("run"));
}

TEST(DidYouMean, NamesTheSpellingsOrNothing) {
  EXPECT_EQ(did_you_mean("evla", {"evals", "eval", "map"}), "; did you mean eval or evals?");
  EXPECT_EQ(did_you_mean("qqqq", {"eval"}), "");
}

}  // namespace spelling_test
}  // namespace placegraph
