#include <gtest/gtest.h>
#include <placegraph/pipeline/places/rescaling.h>

#include "tests/support/place_links.h"

namespace placegraph {
namespace rescaling_test {

using namespace test;

TEST(Rescaling, InformationOfLengthsFallsAndTheirCovarianceGrowsWithTheSquare) {
  const Matrix6d information = information_of(0.1, 0.02);
  EXPECT_LT((rescaled_information<6>(information, 3) - information_of(0.3, 0.02)).norm(), 1e-9);
  const Matrix6d covariance = information.inverse();
  EXPECT_NEAR(rescaled_covariance<6>(covariance, 3)(1, 1), 0.09, 1e-12);
  EXPECT_NEAR(rescaled_covariance<6>(covariance, 3)(4, 4), 0.0004, 1e-12);
}

TEST(Rescaling, ALoopIsInTheLengthsOfItsMatchAndItsInformationInThoseOfItsQuery) {
  const Loop before = scaled_loop(4, 0, kLong, 1.5);
  const Loop match = rescaled_loop(before, true, false, 2);
  EXPECT_LT(distance_m(match.T_match_query, kLong.scaled(2)), 1e-12);
  EXPECT_NEAR(match.scale_match_query, 3, 1e-12);
  EXPECT_EQ(match.information, before.information);
  const Loop query = rescaled_loop(before, false, true, 2);
  EXPECT_LT(distance_m(query.T_match_query, kLong), 1e-12);
  EXPECT_NEAR(query.scale_match_query, 0.75, 1e-12);
  EXPECT_NEAR(query.information(0, 0), before.information(0, 0) / 4, 1e-9);
  EXPECT_EQ(query.information(4, 4), before.information(4, 4));
  const Loop both = rescaled_loop(before, true, true, 2);
  EXPECT_NEAR(both.scale_match_query, 1.5, 1e-12);
}

}  // namespace rescaling_test
}  // namespace placegraph
