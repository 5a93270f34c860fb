#include <gtest/gtest.h>
#include <placegraph/eval/uncertainty/student_t.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <numbers>

namespace placegraph {
namespace student_t_test {

// Digits of tables: Abramowitz and Stegun, table 26.10.
TEST(StudentT, QuantilesAreThoseOfTables) {
  EXPECT_NEAR(student_t_quantile(0.975, 1), 12.706, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.975, 2), 4.303, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.975, 4), 2.776, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.95, 10), 1.812, 5e-4);
  EXPECT_NEAR(student_t_quantile(0.975, 1e6), 1.960, 5e-4);
}

TEST(StudentT, OfOneDegreeIsCauchysAndOfTwoHasAClosedForm) {
  for (const double x : {-5.0, -0.3, 0.0, 0.7, 2.0, 40.0}) {
    EXPECT_NEAR(student_t_tail(x, 1), 0.5 - std::atan(x) / std::numbers::pi, 1e-13);
    EXPECT_NEAR(student_t_tail(x, 2), 0.5 - 0.5 * x / std::sqrt(2 + x * x), 1e-13);
  }
}

TEST(StudentT, QuantilesInvertTails) {
  for (const double dof : {1.0, 2.7, 8.9, 40.0, 3000.0})
    for (const double probability : {0.01, 0.2, 0.5, 0.8, 0.9995})
      EXPECT_NEAR(1 - student_t_tail(student_t_quantile(probability, dof), dof), probability,
                  1e-11);
}

TEST(StudentT, RefusesProbabilitiesThatAreNone) {
  EXPECT_THROW(student_t_quantile(0, 3), ArgumentError);
  EXPECT_THROW(student_t_quantile(1, 3), ArgumentError);
  EXPECT_THROW(student_t_quantile(0.5, 0), ArgumentError);
}

}  // namespace student_t_test
}  // namespace placegraph
