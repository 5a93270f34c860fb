#include <gtest/gtest.h>
#include <placegraph/graph/measurements/landmark.h>

namespace placegraph {
namespace landmark_test {

TEST(HammingDistance, CountsDifferingBitsOverAllWords) {
  const BinaryDescriptor zero{};
  const BinaryDescriptor ones = {~0ull, ~0ull, ~0ull, ~0ull};
  EXPECT_EQ(hamming_distance(zero, zero), 0);
  EXPECT_EQ(hamming_distance(zero, ones), 256);
  EXPECT_EQ(hamming_distance(ones, zero), 256);
  EXPECT_EQ(hamming_distance(zero, {1, 1ull << 63, 0b101, 0}), 4);
}

TEST(HammingDistance, OfManyIsThatOfEach) {
  const BinaryDescriptor from = {0x0123456789abcdefull, 7, ~0ull, 1};
  const std::vector<BinaryDescriptor> to = {{}, {~0ull, 0, 1, 2}, from};
  std::vector<int> distances(9, -1);
  hamming_distances(from, to, distances);
  ASSERT_EQ(distances.size(), to.size());
  for (std::size_t i = 0; i < to.size(); ++i)
    EXPECT_EQ(distances[i], hamming_distance(from, to[i]));
  EXPECT_EQ(distances[2], 0);
}

}  // namespace landmark_test
}  // namespace placegraph
