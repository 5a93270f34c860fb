#include <gtest/gtest.h>
#include <placegraph/pipeline/places/shortest_path.h>

#include <cmath>

#include "tests/support/place_links.h"

namespace placegraph {
namespace shortest_path_test {

using namespace test;

TEST(ShortestPath, LeadsAlongLinksAndLoops) {
  // Four corners of a square of 5 m sides, in a row of links, and a fifth place that nothing joins.
  KeyframeChain chain;
  PlacePartition partition;
  const Eigen::Vector3d corners[] = {{0, 0, 0}, {5, 0, 0}, {5, 0, 5}, {0, 0, 5}};
  for (int i = 0; i < 4; ++i) {
    chain.add(KeyframeId(i), i == 0 ? std::nullopt : std::optional(link(i - 1, kLong)));
    partition.found(KeyframeId(i), Sim3(SO3(), corners[i], 1), 0, 3);
  }
  chain.add(KeyframeId(4), link(3, kShort));
  partition.join(KeyframeId(4), KeyframeId(3));
  chain.add(KeyframeId(5), std::nullopt);
  partition.found(KeyframeId(5), Sim3(), 1, 3);
  EXPECT_NEAR(shortest_path(chain, partition, {}, PlaceId(0), PlaceId(3)), 15, 1e-12);
  EXPECT_NEAR(shortest_path(chain, partition, {}, PlaceId(3), PlaceId(1)), 10, 1e-12);
  EXPECT_EQ(shortest_path(chain, partition, {}, PlaceId(2), PlaceId(2)), 0);
  EXPECT_TRUE(std::isinf(shortest_path(chain, partition, {}, PlaceId(0), PlaceId(4))));
  const std::vector<Loop> loops{loop(4, 0, SE3(), 0.1, 0.01)};  // a member of place 3
  EXPECT_NEAR(shortest_path(chain, partition, loops, PlaceId(0), PlaceId(3)), 5, 1e-12);
  EXPECT_NEAR(shortest_path(chain, partition, loops, PlaceId(0), PlaceId(2)), 10, 1e-12);
}

}  // namespace shortest_path_test
}  // namespace placegraph
