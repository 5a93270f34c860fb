#include <gtest/gtest.h>
#include <placegraph/frontend/planes/homography_fit.h>

#include <numbers>
#include <numeric>

#include "tests/support/scenes/planes_world.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace homography_fit_test {

using namespace test;
using Eigen::Matrix3d;
using Eigen::Vector2d;

const SE3 kMotion = pose({0.03, -0.05, 0.02}, {0.5, -0.2, 0.3});
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<int> all(int n) {
  std::vector<int> which(static_cast<std::size_t>(n));
  std::iota(which.begin(), which.end(), 0);
  return which;
}

Matrix3d true_homography(const PlanesWorld& world) {
  const Matrix3d H = homography_from_plane(world.camera.K(), world.T_cur_ref, world.planes_ref[0]);
  return H / H.norm();
}

TEST(TransferError, OfAShiftIsHalfTheSquareOfTheDistance) {
  Matrix3d H = Matrix3d::Identity();
  H(0, 2) = 10;
  const TransferError error = transfer_error(H, {5, 7}, {18, 11});
  EXPECT_NEAR((error.residual - Vector2d(3, 4)).norm(), 0, 1e-12);
  EXPECT_NEAR(error.squared, 12.5, 1e-12);  // noise of both views adds up
  EXPECT_NEAR(error.log_determinant, std::log(4.0), 1e-12);
}

TEST(TransferError, IsTheSameBothWaysToFirstOrder) {
  Random random = seeded_random(61);
  const PlanesWorld world = make_planes_world(1, 50, 0, 0.05, kMotion, random);
  const Matrix3d H = true_homography(world), back = H.inverse();
  for (std::size_t i = 0; i < 50; ++i) {
    const double forth =
        transfer_error(H, world.matches.px_ref[i], world.matches.px_cur[i]).squared;
    EXPECT_NEAR(transfer_error(back, world.matches.px_cur[i], world.matches.px_ref[i]).squared,
                forth, 0.01 * forth);
  }
}

TEST(TransferError, DoesNotDependOnTheSignOfTheHomographyAndIsInfiniteBeyondTheHorizon) {
  Matrix3d H = Matrix3d::Identity();
  H(2, 0) = -0.01;  // the horizon stands at x = 100
  EXPECT_NEAR(transfer_error(H, {50, 20}, {100, 40}).squared, 0, 1e-12);
  EXPECT_NEAR(transfer_error(-H, {50, 20}, {100, 40}).squared, 0, 1e-12);
  EXPECT_EQ(transfer_error(H, {150, 20}, {-300, -40}).squared, kInfinity);
}

TEST(TransferNoise, IsADensityOfUnitMass) {
  for (const double freedom : {3.0, 8.0, kInfinity}) {
    const TransferNoise noise{1.5, freedom};
    double mass = 0;
    constexpr double kStep = 0.01;
    for (double r = kStep / 2; r < 300; r += kStep) {
      TransferError error;
      error.squared = r * r;
      mass += 2 * std::numbers::pi * r * kStep * std::exp(-noise.cost(error));
    }
    EXPECT_NEAR(mass, 1, 1e-3) << freedom;
  }
}

TEST(HomographyThrough, MeetsItsFourMatches) {
  Random random = seeded_random(62);
  const PlanesWorld world = make_planes_world(1, 40, 0, 0, kMotion, random);
  int found = 0;
  for (int i = 0; i + 3 < 40; i += 4) {
    const auto H = homography_through(world.matches, {i, i + 1, i + 2, i + 3});
    if (!H) continue;
    ++found;
    EXPECT_LT((*H - true_homography(world)).norm(), 1e-6);
  }
  EXPECT_GE(found, 5);
}

TEST(HomographyThrough, RefusesThreeInALineAndRotatedTriangles) {
  const PointMatches line{{{0, 0}, {10, 10}, {20, 20}, {0, 30}},
                          {{0, 0}, {10, 10}, {20, 20}, {0, 30}}};
  EXPECT_FALSE(homography_through(line, {0, 1, 2, 3}));
  const PointMatches rotated{{{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                             {{0, 0}, {-10, 0}, {-10, 10}, {0, 10}}};
  EXPECT_FALSE(homography_through(rotated, {0, 1, 2, 3}));
  const PointMatches once{{{0, 0}, {0, 0}, {10, 10}, {0, 10}}, {{0, 0}, {0, 0}, {10, 10}, {0, 10}}};
  EXPECT_FALSE(homography_through(once, {0, 1, 2, 3}));
}

TEST(RefineHomography, StatesItsUncertaintyTruly) {
  // Normalized squared errors of eight degrees of freedom: their mean over 60 runs is 8 +- 0.52.
  Random random = seeded_random(63);
  double sum = 0;
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    const PlanesWorld world = make_planes_world(1, 60, 0, 0.5, kMotion, random);
    const HomographyFit fit =
        refine_homography(true_homography(world), world.matches, all(60), {0.5, kInfinity}, 10);
    ASSERT_TRUE(fit.outcome) << fit.outcome.reason;
    const Matrix3d error = fit.H_cur_ref - true_homography(world);
    Eigen::Matrix<double, 9, 1> e;
    e << error.row(0).transpose(), error.row(1).transpose(), error.row(2).transpose();
    // Entries differ by orders of magnitude: whitened by the square root of the diagonal.
    const Eigen::Matrix<double, 9, 1> scale = fit.covariance.diagonal().cwiseSqrt();
    const Eigen::Matrix<double, 9, 9> correlation =
        scale.cwiseInverse().asDiagonal() * fit.covariance * scale.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> eigen(correlation);
    const Eigen::Matrix<double, 9, 1> y = eigen.eigenvectors().transpose() * e.cwiseQuotient(scale);
    for (int i = 1; i < 9; ++i) sum += y[i] * y[i] / eigen.eigenvalues()[i];
  }
  EXPECT_NEAR(sum / kRuns, 8, 4 * 0.52);
}

TEST(RefineHomography, IsHardlyMovedByAFewWildMatchesUnderHeavyTails) {
  Random random = seeded_random(64);
  PlanesWorld world = make_planes_world(1, 60, 0, 0.3, kMotion, random);
  for (std::size_t i = 0; i < 5; ++i) world.matches.px_cur[i] += Vector2d(12, -9);
  const auto worst = [&](double freedom) {
    const HomographyFit fit =
        refine_homography(true_homography(world), world.matches, all(60), {0.3, freedom}, 30);
    double px = 0;
    for (const Vector2d& p : world.matches.px_ref)
      px = std::max(px, ((fit.H_cur_ref * p.homogeneous()).hnormalized() -
                         (true_homography(world) * p.homogeneous()).hnormalized())
                            .norm());
    return px;
  };
  EXPECT_LT(worst(3), 1);
  EXPECT_GT(worst(kInfinity), 2);
}

TEST(RefineHomography, SaysWhereTheMatchesFixNothing) {
  const PointMatches three{{{0, 0}, {9, 0}, {0, 9}}, {{0, 0}, {9, 0}, {0, 9}}};
  EXPECT_EQ(refine_homography(Matrix3d::Identity(), three, all(3), {}, 5).outcome.code,
            Outcome::Code::kTooFewData);
  PointMatches line;
  for (int i = 0; i < 20; ++i) {
    line.px_ref.emplace_back(3 * i, 2 * i);
    line.px_cur.emplace_back(3 * i, 2 * i);
  }
  EXPECT_EQ(refine_homography(Matrix3d::Identity(), line, all(20), {}, 5).outcome.code,
            Outcome::Code::kDegenerate);
}

}  // namespace homography_fit_test
}  // namespace placegraph
