#include <gtest/gtest.h>
#include <placegraph/frontend/cloud_planes/cloud_points.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "tests/support/message_of.h"
#include "tests/support/scenes/small_cloud.h"

namespace placegraph {
namespace cloud_points_test {

double flat_wall(double x, double) { return 2 / (1 + 0.2 * x); }

TEST(CloudPoints, JoinPixelsAcrossOneThatIsMissing) {
  PointCloud cloud = test::small_cloud(6, 1, flat_wall);
  for (const std::size_t missing : {1u, 3u, 4u})
    cloud.points[missing].setConstant(std::numeric_limits<double>::quiet_NaN());
  const CloudPoints points = prepare_cloud(cloud, 1e-3);
  EXPECT_EQ(points.source, (std::vector<int>{0, 2, 5}));
  EXPECT_EQ(points.pixel, (std::vector<int>{0, -1, 1, -1, -1, 2}));
  EXPECT_EQ(points.begin, (std::vector<int>{0, 1, 2, 2}));  // two missing ones part 2 and 5
  EXPECT_EQ(points.neighbours, (std::vector<int>{1, 0}));
}

TEST(CloudPoints, AreMutualNeighboursInACloudWithoutPixels) {
  Random random(5);
  PointCloud cloud;
  for (int i = 0; i < 300; ++i)
    cloud.points.emplace_back(random.normal(), random.normal(), random.normal());
  const CloudPoints points = prepare_cloud(cloud, 1e-3);
  std::set<std::pair<int, int>> pairs;
  for (int i = 0; i < points.size(); ++i) {
    EXPECT_GE(points.begin[i + 1] - points.begin[i], 8);
    for (int n = points.begin[i]; n < points.begin[i + 1]; ++n)
      EXPECT_TRUE(pairs.insert({i, points.neighbours[n]}).second);
  }
  for (const auto& [a, b] : pairs) EXPECT_TRUE(pairs.count({b, a}) && a != b);
}

TEST(CloudPoints, MeasureHowTheNoiseGrowsWithDepth) {
  // From one to four metres; 2e-3 of the depth to a power.
  for (const int power : {0, 1, 2}) {
    Random random(6);
    const CloudPoints points = prepare_cloud(
        test::small_cloud(96, 96,
                          [&](double, double y) {
                            const double depth = 1 / (0.625 + 0.375 * y / 0.96);
                            return depth + random.normal(0, 2e-3 * std::pow(depth, power));
                          }),
        1e-4);
    EXPECT_EQ(points.noise.power, power);
    // The least noisy third of patches of 25: their quantile is below the mean by 0.4 deviations of
    // 1 / sqrt(2 * 22).
    EXPECT_NEAR(points.noise.at_1m, 2e-3, 3e-4) << power;
    EXPECT_NEAR(points.noise.sigma(2), std::pow(2.0, power) * points.noise.at_1m, 1e-12);
    for (int i = 0; i < points.size(); i += 97) {
      const double z = points.xyz[i].z();  // of the inverse depth: sigma / z^2
      EXPECT_NEAR(points.fit[i].weight * std::pow(points.noise.sigma(z) / (z * z), 2), 1, 1e-9);
    }
  }
  PointCloud stepped = test::small_cloud(20, 20, [](double, double) { return 2.0; });
  stepped.step_m = 0.06;  // the noise of quantization is a step over the root of twelve
  EXPECT_NEAR(prepare_cloud(stepped, 1e-3).noise.sigma(2), 0.06 / std::sqrt(12.0), 1e-12);
}

TEST(CloudPoints, RefuseImagesThatAreNone) {
  PointCloud cloud = test::small_cloud(4, 3, flat_wall);
  const auto message = [&] {
    return test::message_of<ArgumentError>([&] { (void)prepare_cloud(cloud, 1e-3); });
  };
  cloud.points[5].z() = -2;
  EXPECT_NE(message().find("depth that is not positive"), std::string::npos);
  cloud.points.pop_back();
  EXPECT_NE(message().find("point for every pixel"), std::string::npos);
}

}  // namespace cloud_points_test
}  // namespace placegraph
