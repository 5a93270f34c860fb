#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/node_index.h>

#include <limits>

namespace placegraph {
namespace node_index_test {

constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();

std::vector<NodeId> nodes(const std::vector<std::int64_t>& numbers) {
  return {numbers.begin(), numbers.end()};
}

void expect_finds_all(const std::vector<std::int64_t>& numbers) {
  const std::vector<NodeId> ids = nodes(numbers);
  const NodeIndex index(ids);
  for (std::size_t i = 0; i < ids.size(); ++i)
    EXPECT_EQ(index.find(ids[i]), static_cast<int>(i)) << ids[i];
}

TEST(NodeIndex, FindsIdsThatLieTogetherAndIdsThatLieFarApart) {
  expect_finds_all({0, 1, 2, 3});
  expect_finds_all({7, 3, 5, -2});
  expect_finds_all({-1'000'000'000'000, 0, 1'000'000'000'000});
  expect_finds_all({kMax, kMin, 0});
  expect_finds_all({kMax - 1, kMax});
  expect_finds_all({kMin + 1, kMin});
}

TEST(NodeIndex, FindsNothingThatIsNotThere) {
  for (const std::vector<std::int64_t>& ids :
       {std::vector<std::int64_t>{}, {3, 5}, {kMin, kMax}, {kMax}, {kMin}}) {
    const NodeIndex index(nodes(ids));
    for (const NodeId id : {NodeId(2), NodeId(4), NodeId(6), NodeId(kMin + 1)}) {
      EXPECT_FALSE(index.find(id));
      EXPECT_FALSE(index.contains(id));
      EXPECT_THROW(index.at(id), ArgumentError);
    }
  }
}

TEST(NodeIndex, CountsTheFirstOfEqualIds) {
  EXPECT_EQ(NodeIndex(nodes({4, 5, 4})).at(NodeId(4)), 0);
  EXPECT_EQ(NodeIndex(nodes({kMin, 5, kMax, 5})).at(NodeId(5)), 1);
}

}  // namespace node_index_test
}  // namespace placegraph
