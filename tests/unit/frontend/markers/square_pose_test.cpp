#include <gtest/gtest.h>
#include <placegraph/frontend/markers/marker_dictionary.h>
#include <placegraph/frontend/markers/marker_explanation.h>
#include <placegraph/frontend/markers/square_pose.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/message_of.h"
#include "tests/support/scenes/marker_scene.h"

namespace placegraph {
namespace square_pose_test {

using Code = Outcome::Code;
using Eigen::Vector3d;

const Camera kCamera = test::MarkerScene::usual_camera();
constexpr double kSigma_px = 0.1;

/// A square of half side 0.1 m that faces the z axis, seen exactly.
SeenSquare seen_square(const Vector3d& centre, const SE3& T_ref_cam) {
  SeenSquare square;
  const double x[4] = {-0.1, 0.1, 0.1, -0.1}, y[4] = {0.1, 0.1, -0.1, -0.1};
  for (int k = 0; k < 4; ++k) {
    square.corners_ref[k] = centre + Vector3d(x[k], y[k], 0);
    square.corners_px[k] = *kCamera.project(T_ref_cam.inverse() * square.corners_ref[k]);
  }
  square.information /= kSigma_px * kSigma_px;
  return square;
}

SeenPoint seen_point(const Vector3d& point_ref, const SE3& T_ref_cam) {
  return {*kCamera.project(T_ref_cam.inverse() * point_ref), point_ref,
          Eigen::Matrix2d::Identity() / (kSigma_px * kSigma_px)};
}

const SE3 kTruth = test::looking_at_origin(1.2, 0.5, 0.3, 0.4);

void add_noise(SeenSquare& square, Random& random) {
  for (Eigen::Vector2d& px : square.corners_px)
    px += Eigen::Vector2d(random.normal(0, kSigma_px), random.normal(0, kSigma_px));
}

TEST(SquarePose, IsTheMinimumOfAllErrorsTogether) {
  Random random(1);
  std::vector<SeenSquare> squares = {seen_square({0, 0, 0}, kTruth),
                                     seen_square({0.3, 0.1, 0.05}, kTruth)};
  for (SeenSquare& square : squares) add_noise(square, random);
  std::vector<SeenPoint> points = {seen_point({-0.2, 0.2, 0.1}, kTruth)};
  points[0].px.x() += 0.2;
  const auto chi2_at = [&](const SE3& T_ref_cam) {
    return square_chi2(kCamera, squares[0], T_ref_cam) +
           square_chi2(kCamera, squares[1], T_ref_cam) + point_chi2(kCamera, points[0], T_ref_cam);
  };
  const SE3 start = kTruth.plus(0.03 * Vector6d::Ones());
  const SquarePose pose = refine_square_pose(kCamera, squares, points, start);
  ASSERT_TRUE(pose.outcome) << pose.outcome.reason;
  EXPECT_EQ(pose.rows, 18);
  EXPECT_NEAR(pose.chi2, chi2_at(pose.T_ref_cam), 1e-9);
  for (int k = 0; k < 6; ++k)
    for (const double sign : {-1.0, 1.0}) {
      // A standard deviation along one axis raises the error by at least one: by the conditional
      // deviation, 1 / sqrt(H_kk), by exactly one up to curvature.
      const double H_kk = pose.covariance.inverse()(k, k);
      const SE3 beside = pose.T_ref_cam.plus(sign / std::sqrt(H_kk) * Vector6d::Unit(k));
      EXPECT_NEAR(chi2_at(beside) - pose.chi2, 1, 0.1) << k;
    }
}

TEST(SquarePose, SaysWhyThereIsNone) {
  const std::vector<SeenPoint> two = {seen_point({0.1, 0, 0}, kTruth),
                                      seen_point({0, 0.1, 0}, kTruth)};
  EXPECT_EQ(refine_square_pose(kCamera, {}, two, kTruth).outcome.code, Code::kTooFewData);
  std::vector<SeenPoint> line;
  for (const double x : {-0.2, -0.1, 0.1, 0.2}) line.push_back(seen_point({x, 0, 0}, kTruth));
  EXPECT_EQ(refine_square_pose(kCamera, {}, line, kTruth).outcome.code, Code::kDegenerate);
  const SeenSquare square = seen_square({0, 0, 0}, kTruth);
  const SE3 away(kTruth.rotation() * SO3::exp({0, 3.1, 0}), kTruth.translation());
  EXPECT_EQ(refine_square_pose(kCamera, {square}, {}, away).outcome.code, Code::kNoConsensus);
  EXPECT_TRUE(std::isinf(square_chi2(kCamera, square, away)));
  EXPECT_TRUE(std::isinf(point_chi2(kCamera, two[0], away)));
}

TEST(PlanarRival, OfTheRivalIsTheFirstPose) {
  // Far away, where both explain the corners.
  const SE3 truth = test::looking_at_origin(3, 0.5, 0.3, 0.4);
  const SeenSquare square = seen_square({0, 0, 0}, truth);
  const SquarePose first = refine_square_pose(kCamera, {square}, {}, truth);
  const auto rival_of = [&](const SquarePose& pose) {
    return find_planar_rival(kCamera, {square}, {}, pose.T_ref_cam, Vector3d::Zero(),
                             Vector3d::UnitZ());
  };
  const SquarePose rival = rival_of(first);
  ASSERT_TRUE(first.outcome && rival.outcome);
  EXPECT_FALSE(same_minimum(first, rival));
  EXPECT_GT(rival.chi2, first.chi2);
  const SquarePose back = rival_of(rival);
  EXPECT_TRUE(same_minimum(first, back));
  EXPECT_LT((back.T_ref_cam.inverse() * truth).log().norm(), 1e-4);
  const SE3 frontal(SO3::exp({3.14159265358979, 0, 0}), Vector3d(0, 0, 2));
  SquarePose seen_frontally;
  seen_frontally.T_ref_cam = frontal;
  EXPECT_EQ(rival_of(seen_frontally).outcome.code, Code::kInconsistent);
}

TEST(LogLikelihoodOfStudent, IsThatOfFourDegreesOfFreedom) {
  EXPECT_EQ(log_likelihood(0, 8), 0);
  // -(4 + n) / 2 log(1 + chi2 / 4).
  EXPECT_NEAR(log_likelihood(4, 2), -3 * std::log(2), 1e-12);
  EXPECT_NEAR(log_likelihood(12, 8), -6 * std::log(4), 1e-12);
}

TEST(ExplainMarkers, LeavesOutTheSquareThatMoved) {
  std::vector<SeenSquare> squares;
  for (const Vector3d& centre :
       {Vector3d(0, 0, 0), Vector3d(0.35, 0, 0), Vector3d(0, 0.35, 0), Vector3d(-0.35, 0.1, 0)})
    squares.push_back(seen_square(centre, kTruth));
  for (Eigen::Vector2d& px : squares[2].corners_px) px += Eigen::Vector2d(9, -5);
  const MarkerExplanations all = explain_markers(kCamera, squares, {}, {}, 30, {}, std::nullopt);
  ASSERT_TRUE(all.outcome) << all.outcome.reason;
  const auto best = std::max_element(all.found.begin(), all.found.end(),
                                     [](const MarkerExplanation& a, const MarkerExplanation& b) {
                                       return a.log_likelihood_sum < b.log_likelihood_sum;
                                     });
  EXPECT_EQ(best->squares, (std::vector<int>{0, 1, 3}));
  EXPECT_LT((best->pose.T_ref_cam.inverse() * kTruth).log().norm(), 1e-5);
  EXPECT_EQ(explain_markers(kCamera, {}, {}, {}, 30, {}, std::nullopt).outcome.code,
            Code::kTooFewData);
}

TEST(MarkerFamilies, HaveTheSizesOfTheirNames) {
  std::set<std::string> names;
  for (const std::string& name : marker_dictionaries()) {
    EXPECT_TRUE(names.insert(name).second) << name;
    const MarkerFamily family = marker_family(name);
    if (name.find("aruco_") != 0 || name == "aruco_original") continue;
    EXPECT_EQ(family.bits_per_side, name[6] - '0') << name;  // aruco_5x5_250
    EXPECT_EQ(family.count(), std::stoi(name.substr(10))) << name;
  }
  EXPECT_EQ(marker_family("apriltag_36h11").count(), 587);
  EXPECT_EQ(marker_family("apriltag_36h11").bits_per_side, 6);
  const std::string message =
      test::message_of<ArgumentError>([] { (void)marker_family("aruco_9x9_50"); });
  EXPECT_NE(message.find("aruco_9x9_50"), std::string::npos);
  EXPECT_NE(message.find("apriltag_36h11"), std::string::npos);
}

}  // namespace square_pose_test
}  // namespace placegraph
