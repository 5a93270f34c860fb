#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/disjoint_sets.h>

namespace placegraph {
namespace disjoint_sets_test {

using testing::ElementsAre;

TEST(DisjointSets, AreNumberedInTheOrderOfTheirLowestMembers) {
  DisjointSets sets(6);
  EXPECT_THAT(sets.numbers(), ElementsAre(0, 1, 2, 3, 4, 5));
  sets.join(5, 1);
  sets.join(4, 2);
  sets.join(1, 3);
  sets.join(3, 5);
  EXPECT_EQ(sets.root(5), 1);
  EXPECT_EQ(sets.root(3), 1);
  EXPECT_THAT(sets.numbers(), ElementsAre(0, 1, 2, 1, 2, 1));
}

TEST(DisjointSets, MayBeEmpty) { EXPECT_THAT(DisjointSets(0).numbers(), ElementsAre()); }

}  // namespace disjoint_sets_test
}  // namespace placegraph
