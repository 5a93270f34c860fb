#include <gtest/gtest.h>
#include <placegraph/frontend/floor_plan/plane_sweep.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace plane_sweep_test {

/// Least cost of a path that comes from (-du, -dv) and ends at a pixel on a level, as defined, with
/// the least of the pixel before taken off.
std::vector<double> path_by_definition(const CostVolume& volume, const PathCosts& penalty, int u,
                                       int v, int du, int dv) {
  std::vector<double> costs;
  for (int d = 0; d < volume.levels; ++d) costs.push_back(volume.costs[volume.at(u, v) + d]);
  const int before_u = u - du, before_v = v - dv;
  if (before_u < 0 || before_v < 0 || before_u >= volume.width || before_v >= volume.height)
    return costs;
  const auto before = path_by_definition(volume, penalty, before_u, before_v, du, dv);
  const double least = *std::min_element(before.begin(), before.end());
  for (int d = 0; d < volume.levels; ++d) {
    double best = 1e9;
    for (int from = 0; from < volume.levels; ++from) {
      const int apart = std::abs(from - d);
      best = std::min(best, before[from] + (apart == 0   ? 0
                                            : apart == 1 ? penalty.step
                                                         : penalty.jump));
    }
    costs[d] += best - least;
  }
  return costs;
}

TEST(SumOverPaths, IsTheSumOfTheEightPathsByDefinition) {
  CostVolume volume(5, 4, 6);
  Random random(3);
  for (std::uint8_t& cost : volume.costs) cost = static_cast<std::uint8_t>(random.uniform(0, 60));
  const PathCosts penalty{5, 17};
  const auto sums = sum_over_paths(volume, penalty);
  for (int v = 0; v < volume.height; ++v)
    for (int u = 0; u < volume.width; ++u) {
      std::vector<double> expected(6, 0);
      for (int du = -1; du <= 1; ++du)
        for (int dv = -1; dv <= 1; ++dv) {
          if (du == 0 && dv == 0) continue;
          const auto path = path_by_definition(volume, penalty, u, v, du, dv);
          for (int d = 0; d < 6; ++d) expected[d] += path[d];
        }
      for (int d = 0; d < 6; ++d)
        EXPECT_EQ(sums[volume.at(u, v) + d], expected[d]) << u << ' ' << v;
    }
}

/// Grey of a wall that is patterned everywhere differently, but not left of `blank_m`.
double pattern(double x, double y, double blank_m) {
  if (x < blank_m) return 120;
  double sum = 0;
  for (int k = 1; k <= 8; ++k)
    sum += std::sin(7.3 * k * x + 2.1 * k * k * y) * std::cos(6.1 * k * y - 1.7 * k * k * x + k);
  return 120 + 18 * sum;
}

Camera test_camera() { return {160, 120, 130, 130, 79.5, 59.5}; }

/// A wall through (0, 0, 3) with normal n, seen from `T_view_cam`, with noise of one grey value.
Image view_of_wall(const Eigen::Vector3d& n, const SE3& T_view_cam, double gain = 1,
                   double blank_m = -100) {
  const Camera camera = test_camera();
  const SE3 T_cam_view = T_view_cam.inverse();
  const Eigen::Vector3d anchor(0, 0, 3);
  Random noise(static_cast<std::uint64_t>(1000 * T_view_cam.translation().norm()));
  Image image(camera.height, camera.width, CV_8UC1);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = T_cam_view.rotation().matrix() * *camera.unproject({u, v});
      const Eigen::Vector3d centre = T_cam_view.translation();
      const Eigen::Vector3d p = centre + n.dot(anchor - centre) / n.dot(ray) * ray;
      image.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(
          gain * pattern(p.x(), p.y(), blank_m) + noise.normal(0, 1));
    }
  return image;
}

const Eigen::Vector3d kWall = Eigen::Vector3d(0.4, 0.1, -1).normalized();
const SE3 kForward(SO3::exp({0.01, -0.02, 0.005}), Eigen::Vector3d(0.02, 0.01, -0.4));
const SE3 kSideways(SO3::exp({0, 0.02, 0}), Eigen::Vector3d(-0.25, 0, 0));

double true_inverse_depth(int u, int v) {
  const Eigen::Vector3d ray = *test_camera().unproject({u, v});
  return kWall.dot(ray) / kWall.dot(Eigen::Vector3d(0, 0, 3));
}

TEST(PlaneSweep, TellsTheDepthOfAWallAndHowWell) {
  const Image image = view_of_wall(kWall, SE3());
  const SweptDepth swept = sweep_planes(image, test_camera(),
                                        {{view_of_wall(kWall, kForward, 1.15), kForward},
                                         {view_of_wall(kWall, kSideways, 0.9), kSideways}});
  int measured = 0, near = 0;
  double squares = 0;
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) {
      const double z = swept.depth_m.at<float>(v, u);
      if (z <= 0) continue;
      ++measured;
      const double error = 1 / z - true_inverse_depth(u, v);
      const double sigma = swept.sigma_inverse.at<float>(v, u);
      ASSERT_GT(sigma, 0);
      near += std::abs(error) < 4 * sigma;
      squares += std::min(16.0, error * error / (sigma * sigma));
    }
  EXPECT_GT(measured, 0.75 * 160 * 120);
  EXPECT_GT(near, 0.97 * measured);
  EXPECT_LT(std::sqrt(squares / measured), 1.5);
  EXPECT_GT(std::sqrt(squares / measured), 0.1);
}

TEST(PlaneSweep, IsCertainOnlyWhereThePixelsTellTheDepth) {
  const cv::Rect blank(10, 10, 50, 100), patterned(95, 10, 50, 100);
  /// Share of the depths in both parts that is certain.
  const auto certain = [&](const PlaneSweepOptions& options) {
    const SweptDepth swept =
        sweep_planes(view_of_wall(kWall, SE3(), 1, 0), test_camera(),
                     {{view_of_wall(kWall, kSideways, 1, 0), kSideways}}, options);
    EXPECT_EQ(cv::countNonZero(swept.certain & (swept.depth_m == 0)), 0);
    std::array<double, 2> shares{};
    for (const auto& [share, part] : {std::pair{&shares[0], blank}, {&shares[1], patterned}}) {
      const int measured = cv::countNonZero(swept.depth_m(part));
      EXPECT_GT(measured, 0.2 * part.area());  // of the blank part by its neighbours
      *share = 1.0 * cv::countNonZero(swept.certain(part)) / measured;
    }
    return shares;
  };
  const auto [of_blank, of_patterned] = certain({});
  EXPECT_LT(of_blank, 0.08);
  EXPECT_GT(of_patterned, 0.12);
  PlaneSweepOptions credulous;
  credulous.distinct = 1;
  EXPECT_GT(certain(credulous)[0], 3 * of_blank);
}

TEST(PlaneSweep, HalvesWideImagesAndTheirCamera) {
  PlaneSweepOptions options;
  options.max_width_px = 100;
  const Image image = view_of_wall(kWall, SE3());
  const SweptDepth swept =
      sweep_planes(image, test_camera(), {{view_of_wall(kWall, kSideways), kSideways}}, options);
  EXPECT_EQ(swept.camera.width, 80);
  EXPECT_EQ(swept.depth_m.size(), cv::Size(80, 60));
  // The same rays.
  EXPECT_LT((*swept.camera.unproject({-0.25, -0.25}) - *test_camera().unproject({0, 0})).norm(),
            1e-12);
  EXPECT_GT(cv::countNonZero(swept.depth_m), 0.6 * 80 * 60);
}

TEST(PlaneSweep, HalvesOddSizes) {
  Camera odd = test_camera();
  odd.width = 161, odd.height = 121;
  PlaneSweepOptions options;
  options.max_width_px = 100;
  const auto wider = [&](const Image& image) {
    Image result;
    cv::copyMakeBorder(image, result, 0, 1, 0, 1, cv::BORDER_REPLICATE);
    return result;
  };
  const SweptDepth swept =
      sweep_planes(wider(view_of_wall(kWall, SE3())), odd,
                   {{wider(view_of_wall(kWall, kSideways)), kSideways}}, options);
  ASSERT_EQ(swept.depth_m.size(), cv::Size(80, 60));
  // The corners of the image stay where they were.
  for (const auto& [small, large] :
       {std::pair{Eigen::Vector2d(-0.5, -0.5), Eigen::Vector2d(-0.5, -0.5)},
        {Eigen::Vector2d(79.5, 59.5), Eigen::Vector2d(160.5, 120.5)}})
    EXPECT_LT((*swept.camera.unproject(small) - *odd.unproject(large)).norm(), 1e-12);
  int measured = 0, near = 0;
  for (int v = 0; v < 60; ++v)
    for (int u = 0; u < 80; ++u) {
      const double z = swept.depth_m.at<float>(v, u);
      if (z <= 0) continue;
      const Eigen::Vector3d ray = *swept.camera.unproject({1.0 * u, 1.0 * v});
      const double truth = kWall.dot(ray) / kWall.dot(Eigen::Vector3d(0, 0, 3));
      ++measured;
      near += std::abs(1 / z - truth) < 4 * swept.sigma_inverse.at<float>(v, u);
    }
  EXPECT_GT(measured, 0.6 * 80 * 60);
  EXPECT_GT(near, 0.95 * measured);
}

/// A camera that moves straight ahead tells nothing of the pixel that it moves to.
TEST(PlaneSweep, TellsLittleAboutThePointMovedTo) {
  const SE3 ahead(SO3(), Eigen::Vector3d(0, 0, -0.4));
  const SweptDepth swept = sweep_planes(view_of_wall(kWall, SE3()), test_camera(),
                                        {{view_of_wall(kWall, ahead), ahead}});
  const cv::Rect middle(76, 56, 8, 8);  // the epipole is at (79.5, 59.5)
  EXPECT_EQ(cv::countNonZero(swept.depth_m(middle)), 0);
  EXPECT_GT(cv::countNonZero(swept.depth_m), 0.4 * 160 * 120);
  EXPECT_GT(swept.sigma_inverse.at<float>(60, 100), swept.sigma_inverse.at<float>(60, 140));
}

/// What a view has passed is not seen in it, neither where it would be nor behind its back.
TEST(PlaneSweep, DoesNotSeeWhatLiesBehindAView) {
  const SE3 beyond(SO3(), Eigen::Vector3d(0, 0, -4));  // a metre behind the wall
  const SweptDepth swept = sweep_planes(view_of_wall(kWall, SE3()), test_camera(),
                                        {{view_of_wall(kWall, SE3()), beyond}});
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u)
      if (const float z = swept.depth_m.at<float>(v, u); z > 0) {
        EXPECT_GT(z, 4);
      }
}

TEST(PlaneSweep, TellsNothingWhereNothingMoved) {
  const Image image = view_of_wall(kWall, SE3());
  const SweptDepth alone = sweep_planes(image, test_camera(), {});
  EXPECT_EQ(alone.depth_m.size(), cv::Size(160, 120));
  EXPECT_EQ(cv::countNonZero(alone.depth_m), 0);
  const SE3 pure_rotation(SO3::exp({0, 0.1, 0}), Eigen::Vector3d::Zero());
  EXPECT_EQ(cv::countNonZero(sweep_planes(image, test_camera(),
                                          {{view_of_wall(kWall, pure_rotation), pure_rotation}})
                                 .depth_m),
            0);
}

TEST(PlaneSweep, RefusesWhatItCannotSweep) {
  const Image image = view_of_wall(kWall, SE3());
  Camera bent = test_camera();
  bent.distortion = Distortion::kRadialTangential;
  EXPECT_THROW((void)sweep_planes(image, bent, {}), ArgumentError);
  EXPECT_THROW((void)sweep_planes(image, test_camera(), {{Image(60, 80, CV_8UC1), kForward}}),
               ArgumentError);
  PlaneSweepOptions options;
  options.min_depth_m = options.max_depth_m;
  EXPECT_THROW((void)sweep_planes(image, test_camera(), {}, options), ArgumentError);
}

}  // namespace plane_sweep_test
}  // namespace placegraph
