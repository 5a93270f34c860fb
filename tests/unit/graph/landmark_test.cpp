#include <gtest/gtest.h>
#include <placegraph/graph/landmark.h>

namespace placegraph {
namespace {

TEST(HammingDistance, CountsDifferingBitsOverAllWords) {
  const BinaryDescriptor zero{};
  const BinaryDescriptor ones = {~0ull, ~0ull, ~0ull, ~0ull};
  EXPECT_EQ(hamming_distance(zero, zero), 0);
  EXPECT_EQ(hamming_distance(zero, ones), 256);
  EXPECT_EQ(hamming_distance(ones, zero), 256);
  EXPECT_EQ(hamming_distance(zero, {1, 1ull << 63, 0b101, 0}), 4);
}

}  // namespace
}  // namespace placegraph
