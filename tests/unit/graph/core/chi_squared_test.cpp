#include <gtest/gtest.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <utility>

namespace placegraph {
namespace chi_squared_test {

TEST(ChiSquared, TailsAreThoseOfTheTables) {
  EXPECT_NEAR(chi_squared_tail(3.841458821, 1), 0.05, 1e-9);
  EXPECT_NEAR(chi_squared_tail(4, 2), std::exp(-2.0), 1e-15);
  EXPECT_NEAR(chi_squared_tail(7.814727903, 3), 0.05, 1e-9);
  EXPECT_NEAR(chi_squared_tail(16.81189383, 6), 0.01, 1e-9);
  EXPECT_NEAR(chi_squared_tail(18.47530691, 7), 0.01, 1e-9);
}

TEST(ChiSquared, QuantilesInvertTheTails) {
  for (int dof = 1; dof <= 12; ++dof)
    for (const double p : {0.01, 0.5, 0.95, 0.999, 0.999999})
      EXPECT_NEAR(1 - chi_squared_tail(chi_squared_quantile(p, dof), dof), p, 1e-10);
}

TEST(ChiSquared, QuantilesOfMeanSquaresAreNearTheExactOnes) {
  for (const int dof : {6, 12, 40, 100})
    for (const auto& [probability, z] : {std::pair(0.025, -1.959964), std::pair(0.25, -0.67449),
                                         std::pair(0.5, 0.0), std::pair(0.975, 1.959964)}) {
      const double exact = chi_squared_quantile(probability, dof) / dof;
      EXPECT_NEAR(mean_square_quantile(z, dof), exact, 0.006) << dof << ' ' << probability;
    }
  EXPECT_NEAR(mean_square_quantile(1.959964, 1e6), 1 + 1.96 * std::sqrt(2e-6), 1e-5);
  EXPECT_EQ(mean_square_quantile(-10, 4), 0);
}

TEST(ChiSquared, RefusesAProbabilityThatIsNone) {
  EXPECT_THROW(chi_squared_quantile(0, 3), ArgumentError);
  EXPECT_THROW(chi_squared_quantile(1, 3), ArgumentError);
  EXPECT_THROW(chi_squared_quantile(NAN, 3), ArgumentError);
}

}  // namespace chi_squared_test
}  // namespace placegraph
