#include <gtest/gtest.h>
#include <placegraph/backend/initialization/descent_effort.h>

namespace placegraph {
namespace descent_effort_test {

BlockOrdering ordering() {
  BlockOrdering ordering;
  ordering.operations = 5, ordering.fill = 4;
  return ordering;
}

/// By hand in the plane, three nodes and two edges: an iteration factorizes blocks of 3 (5 * 27
/// operations), solves (2 * 4 * 9) and linearizes (2 * 3 * 500).
constexpr double kIteration = 135 + 72 + 3000;

TEST(DescentEffort, CountsOperationsInIterationsOfThePoseGraph) {
  const DescentEffort effort(2, 3, 2, ordering());
  // Of rank 2 a node has one angle and two coordinates: blocks of 3 again.
  constexpr double product = 72 + 2 * (200 + 8 * 4) + 3 * (100 + 8 * 8);
  constexpr double step = 135 + 2 * (200 + 4 * 2 * 9) + 2 * product;
  EXPECT_NEAR(effort.step(2, 0), step / kIteration, 1e-12);
  EXPECT_NEAR(effort.step(2, 7), (step + 7 * product) / kIteration, 1e-12);
}

TEST(DescentEffort, CountsCertificatesWithBlocksOfRotationAndTranslation) {
  const DescentEffort effort(2, 3, 2, ordering());
  EXPECT_NEAR(effort.certificate(2, 0), 2 * 135 / kIteration, 1e-12);
  EXPECT_NEAR(effort.certificate(0, 3), 3 * 72 / kIteration, 1e-12);
}

TEST(DescentEffort, GrowsWithTheRank) {
  for (const int dim : {2, 3}) {
    const DescentEffort effort(dim, 100, 150, ordering());
    for (int rank = dim; rank < dim + 5; ++rank)
      EXPECT_GT(effort.step(rank + 1, 10), effort.step(rank, 10));
  }
}

}  // namespace descent_effort_test
}  // namespace placegraph
