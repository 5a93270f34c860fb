#include <gtest/gtest.h>
#include <placegraph/io/graphs/printed_rounding.h>

namespace placegraph {
namespace printed_rounding_test {

TEST(PrintedRounding, IsHalfAUnitOfTheLastDigit) {
  EXPECT_DOUBLE_EQ(printed_rounding("100.1"), 0.05);
  EXPECT_DOUBLE_EQ(printed_rounding("-0.00125"), 0.000005);
  EXPECT_DOUBLE_EQ(printed_rounding("1.25e3"), 5);
  EXPECT_DOUBLE_EQ(printed_rounding("1.25e+03"), 5);
  EXPECT_DOUBLE_EQ(printed_rounding("4.0E-2"), 0.0005);
  EXPECT_EQ(printed_rounding("1e+06"), 0);
  EXPECT_EQ(printed_rounding("100"), 0);
}

TEST(PrintedRounding, IsTakenOutOfWhatItMadeIndefinite) {
  Information rank_one(3, 3);
  rank_one << 1, 0.5774, 0, 0.5774, 0.3333, 0, 0, 0, 4;
  ASSERT_NE(fault_of(rank_one), nullptr);
  const Information nearest = without_rounding(rank_one, 5e-5);
  EXPECT_EQ(fault_of(nearest), nullptr);
  EXPECT_LT((nearest - rank_one).cwiseAbs().maxCoeff(), 1e-4);
  // Not what rounding cannot explain.
  EXPECT_NE(fault_of(without_rounding(rank_one, 5e-7)), nullptr);
  EXPECT_NE(fault_of(without_rounding(rank_one, 0.1)), nullptr);
}

}  // namespace printed_rounding_test
}  // namespace placegraph
