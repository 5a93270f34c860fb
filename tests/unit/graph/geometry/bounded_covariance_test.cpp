#include <gtest/gtest.h>
#include <placegraph/graph/geometry/bounded_covariance.h>

namespace placegraph {
namespace bounded_covariance_test {

TEST(BoundedCovariance, IsTheInverseOfInformation) {
  Matrix6d root = Matrix6d::Identity();
  root(0, 4) = 3;
  root(5, 1) = -0.5;
  const Matrix6d information = root * root.transpose();
  EXPECT_LT((bounded_covariance(information) * information - Matrix6d::Identity()).norm(), 1e-9);
}

TEST(BoundedCovariance, AnUnknownDirectionHasALargeFiniteVariance) {
  Matrix7d information = Matrix7d::Identity();
  information(6, 6) = 0;
  information(2, 2) = 1e4;
  const Matrix7d covariance = bounded_covariance(information);
  EXPECT_NEAR(covariance(6, 6), 1e6, 1);
  EXPECT_NEAR(covariance(0, 0), 1, 1e-9);
  EXPECT_NEAR(covariance(2, 2), 1e-4, 1e-12);
}

TEST(BoundedCovariance, TheInverseIsBoundedByTheLargestEigenvalueToo) {
  Matrix6d matrix = Matrix6d::Identity();
  matrix(0, 0) = 1e14;
  matrix(1, 1) = 0;
  EXPECT_NEAR(bounded_inverse(matrix, 1e-18)(1, 1), 1e-2, 1e-6);
  EXPECT_NEAR(bounded_inverse(matrix, 1e3)(1, 1), 1e-3, 1e-9);
}

TEST(BoundedCovariance, AFloorHoldsTheEigenvaluesOfAMatrixThatCanBeInverted) {
  Matrix6d matrix = Matrix6d::Identity();
  matrix(3, 3) = 1e-3;
  EXPECT_NEAR(bounded_inverse(matrix, 1e-6)(3, 3), 1e3, 1e-9);
  EXPECT_NEAR(bounded_inverse(matrix, 1e-2)(3, 3), 1e2, 1e-9);
  EXPECT_NEAR(bounded_inverse(matrix, 1e-2)(0, 0), 1, 1e-12);
}

}  // namespace bounded_covariance_test
}  // namespace placegraph
