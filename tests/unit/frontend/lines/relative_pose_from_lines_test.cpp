#include <gtest/gtest.h>
#include <placegraph/frontend/lines/relative_pose_from_lines.h>

#include "tests/support/scenes/line_scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace relative_pose_from_lines_test {

using namespace test;
using Code = Outcome::Code;

Eigen::Vector3d random_unit(Random& random) {
  return Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

Eigen::Vector3d disturbed_unit(const Eigen::Vector3d& v, double sigma, Random& random) {
  const Eigen::Vector3d a = v.unitOrthogonal(), b = v.cross(a);
  return (v + sigma * random.normal() * a + sigma * random.normal() * b).normalized();
}

TEST(RotationFromDirections, CarriesThemOverWhateverTheirSigns) {
  Random random = seeded_random(30);
  const SO3 R = SO3::exp({0.1, -0.3, 0.2});
  std::vector<DirectionPair> pairs;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d v = random_unit(random);
    pairs.push_back({v, (i % 2 ? -1.0 : 1.0) * (R * v), 0.01});
  }
  const auto result = rotation_from_directions(pairs);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT((R.inverse() * result.R_cur_ref).log().norm(), 1e-9);
}

TEST(RotationFromDirections, ClaimsACovarianceThatItsErrorsBearOut) {
  Random random = seeded_random(31);
  const SO3 R = SO3::exp({0.02, 0.1, -0.05});
  constexpr int kRuns = 200;
  double nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<DirectionPair> pairs;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d v = random_unit(random);
      const double sigma = random.uniform(0.002, 0.02);
      pairs.push_back({v, disturbed_unit(R * v, sigma, random), sigma});
    }
    const auto result = rotation_from_directions(pairs, R);
    ASSERT_TRUE(result.outcome);
    const Eigen::Vector3d error = (R.inverse() * result.R_cur_ref).log();
    nees += error.dot(result.information * error) / (3.0 * kRuns);
  }
  EXPECT_GT(nees, 0.5);
  EXPECT_LT(nees, 2);
}

TEST(RotationFromDirections, OfOneDirectionIsOpenAboutIt) {
  EXPECT_EQ(rotation_from_directions({}).outcome.code, Code::kTooFewData);
  const SO3 R = SO3::exp({0.1, 0, 0});
  const Eigen::Vector3d v = Eigen::Vector3d::UnitZ();
  const auto result = rotation_from_directions({{v, R * v, 0.01}, {v, R * v, 0.01}});
  EXPECT_EQ(result.outcome.code, Code::kDegenerate);
  EXPECT_LT((result.R_cur_ref * v - R * v).norm(), 1e-9) << "but the direction is carried over";
  EXPECT_NEAR(v.dot(result.information * v), 0, 1e-6);
  EXPECT_NEAR(result.information(0, 0), 2e4, 1);
}

/// Normals of random lines in three views, and the truth.
struct ThreeViews {
  SE3 T_21, T_31;  ///< X_2 = T_21 X_1
  std::vector<LineNormals> lines;
};
ThreeViews three_views(int count, double sigma_rad, Random& random) {
  ThreeViews views;
  views.T_21 = SE3(SO3::exp({0.02, -0.05, 0.01}), Eigen::Vector3d(-0.5, 0.1, -0.2));
  views.T_31 = SE3(SO3::exp({-0.01, -0.08, 0.03}), Eigen::Vector3d(-0.9, -0.1, -0.7));
  const LineScene scene = random_lines(count, random);
  for (std::size_t i = 0; i < scene.from.size(); ++i) {
    LineNormals m;
    const SE3 cameras[3] = {SE3(), views.T_21.inverse(), views.T_31.inverse()};
    for (int k = 0; k < 3; ++k)
      m[k] = disturbed_unit(transform_to(cameras[k], scene.line(i)).head<3>().normalized(),
                            sigma_rad, random);
    views.lines.push_back(m);
  }
  return views;
}

TEST(TranslationFromThreeViews, IsExactFromFiveLinesUpToOneScale) {
  Random random = seeded_random(32);
  const ThreeViews views = three_views(5, 0, random);
  const auto result =
      translation_from_three_views(views.lines, views.T_21.rotation(), views.T_31.rotation(), 1e-6);
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  Eigen::Matrix<double, 6, 1> truth, found;
  truth << views.T_21.translation(), views.T_31.translation();
  found << result.t_21, result.t_31;
  EXPECT_NEAR(std::abs(truth.normalized().dot(found)), 1, 1e-9);
}

TEST(TranslationFromThreeViews, ClaimsACovarianceThatItsErrorsBearOut) {
  Random random = seeded_random(33);
  constexpr int kRuns = 60;
  constexpr double kSigma = 5e-4;
  double nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    const ThreeViews views = three_views(40, kSigma, random);
    const auto result = translation_from_three_views(views.lines, views.T_21.rotation(),
                                                     views.T_31.rotation(), kSigma);
    ASSERT_TRUE(result.outcome) << result.outcome.reason;
    Eigen::Matrix<double, 6, 1> truth, found;
    truth << views.T_21.translation(), views.T_31.translation();
    found << result.t_21, result.t_31;
    if (truth.dot(found) < 0) found = -found;
    const Eigen::Matrix<double, 6, 1> error = found - truth.normalized();
    const auto information = result.covariance.completeOrthogonalDecomposition().pseudoInverse();
    nees += error.dot(information * error) / (5.0 * kRuns);
  }
  EXPECT_GT(nees, 0.5);
  EXPECT_LT(nees, 2);
}

TEST(TranslationFromThreeViews, SaysSoWhereThereIsNone) {
  Random random = seeded_random(34);
  ThreeViews views = three_views(30, 1e-3, random);
  EXPECT_EQ(translation_from_three_views({views.lines.begin(), views.lines.begin() + 4},
                                         views.T_21.rotation(), views.T_31.rotation())
                .outcome.code,
            Code::kTooFewData);
  // Lines of one direction: the way along them is open.
  ThreeViews upright = views;
  upright.lines.resize(20);
  for (LineNormals& m : upright.lines) {
    const Line3 line = Line3::from_direction({random.uniform(-2, 2), 0, random.uniform(4, 8)},
                                             Eigen::Vector3d::UnitY());
    const SE3 cameras[3] = {SE3(), views.T_21.inverse(), views.T_31.inverse()};
    for (int k = 0; k < 3; ++k)
      m[k] = disturbed_unit(transform_to(cameras[k], line).head<3>().normalized(), 1e-4, random);
  }
  EXPECT_EQ(translation_from_three_views(upright.lines, views.T_21.rotation(),
                                         views.T_31.rotation(), 1e-4)
                .outcome.code,
            Code::kDegenerate);
  // The camera only turned: planes through one centre, none of which moved.
  for (LineNormals& m : views.lines) {
    m[1] = disturbed_unit(views.T_21.rotation() * m[0], 1e-3, random);
    m[2] = disturbed_unit(views.T_31.rotation() * m[0], 1e-3, random);
  }
  EXPECT_EQ(
      translation_from_three_views(views.lines, views.T_21.rotation(), views.T_31.rotation(), 1e-3)
          .outcome.code,
      Code::kTooFewData);
}

TEST(TranslationFromTwoViews, IsNeverReported) {
  EXPECT_EQ(translation_from_two_views(1000).code, Code::kDegenerate);
  // Whatever translation is tried, the two planes of every line still meet in a line.
  Random random = seeded_random(35);
  const ThreeViews views = three_views(20, 0, random);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Vector3d t = random_unit(random);
    for (const LineNormals& m : views.lines) {
      const Eigen::Vector3d n_2 = views.T_21.rotation().inverse() * m[1];
      const Eigen::Vector3d c = -(views.T_21.rotation().inverse() * t);
      const auto line = meet(m[0], 0, n_2, n_2.dot(c));
      ASSERT_TRUE(line);
      EXPECT_NEAR(m[0].dot(line->nearest_point()), 0, 1e-9);
      EXPECT_NEAR(n_2.dot(line->nearest_point() - c), 0, 1e-9);
    }
  }
}

/// Lines on a floor 1.4 m below, seen from two places.
std::vector<PlaneLineObservation> floor_lines(const std::vector<double>& headings, const SE3& T_12,
                                              double sigma, Random& random) {
  std::vector<PlaneLineObservation> lines;
  for (const double heading : headings) {
    const Eigen::Vector3d p(random.uniform(-2, 2), 1.4, random.uniform(3, 6));
    const Line3 line = Line3::from_direction(p, {std::cos(heading), 0, std::sin(heading)});
    lines.push_back(
        {disturbed_unit(transform_to(SE3(), line).head<3>().normalized(), sigma, random),
         disturbed_unit(transform_to(T_12, line).head<3>().normalized(), sigma, random),
         std::max(1e-6, sigma)});
  }
  return lines;
}

TEST(MotionFromFloorLines, IsMetricAndExactFromTwoDirections) {
  Random random = seeded_random(36);
  const SE3 T_12(SO3::exp({0.02, 0.1, -0.01}), Eigen::Vector3d(0.3, 0.05, 0.8));
  const Plane3 floor(Eigen::Vector3d::UnitY(), 1.4);
  const auto result = motion_from_floor_lines(floor_lines({0.1, 1.5}, T_12, 0, random), floor, 1.35,
                                              T_12.rotation().inverse());
  ASSERT_TRUE(result.outcome) << result.outcome.reason;
  EXPECT_LT((result.displacement_ref - T_12.translation()).norm(), 1e-6);
}

TEST(MotionFromFloorLines, ClaimsACovarianceThatItsErrorsBearOut) {
  Random random = seeded_random(37);
  const SE3 T_12(SO3::exp({0.02, 0.1, -0.01}), Eigen::Vector3d(0.3, 0, 0.8));
  const Plane3 floor(Eigen::Vector3d::UnitY(), 1.4);
  constexpr int kRuns = 100;
  double nees = 0;
  for (int run = 0; run < kRuns; ++run) {
    const auto result =
        motion_from_floor_lines(floor_lines({0, 0.7, 1.6, 2.2, 0.1, 1.5}, T_12, 1e-3, random),
                                floor, 1.4, T_12.rotation().inverse());
    ASSERT_TRUE(result.outcome);
    const Eigen::Vector3d error = result.displacement_ref - T_12.translation();
    const auto information = result.covariance.completeOrthogonalDecomposition().pseudoInverse();
    nees += error.dot(information * error) / (2.0 * kRuns);
  }
  EXPECT_GT(nees, 0.5);
  EXPECT_LT(nees, 2);
}

TEST(MotionFromFloorLines, OfOneDirectionLeavesTheWayAlongItOpen) {
  Random random = seeded_random(38);
  const SE3 T_12(SO3(), Eigen::Vector3d(0.3, 0, 0.8));
  const Plane3 floor(Eigen::Vector3d::UnitY(), 1.4);
  const auto result =
      motion_from_floor_lines(floor_lines({0, 0, 0}, T_12, 0, random), floor, 1.4, SO3());
  EXPECT_EQ(result.outcome.code, Code::kDegenerate);
  EXPECT_NEAR(result.displacement_ref.z(), 0.8, 1e-6) << "across the lines it is known";
  EXPECT_NEAR(result.displacement_ref.x(), 0, 1e-6);
  EXPECT_EQ(
      motion_from_floor_lines(floor_lines({0}, T_12, 0, random), floor, 1.4, SO3()).outcome.code,
      Code::kTooFewData);
}

}  // namespace relative_pose_from_lines_test
}  // namespace placegraph
