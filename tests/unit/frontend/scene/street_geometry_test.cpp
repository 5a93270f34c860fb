#include <gtest/gtest.h>
#include <placegraph/frontend/scene/street_geometry.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace placegraph {
namespace street_geometry_test {

constexpr double kFocalTimesBaseline = 400;  // m px
const Camera kCamera{.width = 800, .height = 400, .fx = 700, .fy = 700, .cx = 400, .cy = 200};

/// A sample at a pixel, at the depth of the plane n^T X = d.
DepthSample on_plane(double u, double v, const Eigen::Vector3d& n, double d, int superpixel = 0) {
  const Eigen::Vector3d ray((u - kCamera.cx) / kCamera.fx, (v - kCamera.cy) / kCamera.fy, 1);
  return {static_cast<float>(u), static_cast<float>(v), (ray * d / n.dot(ray)).cast<float>(),
          superpixel};
}

/// A road with a slope and a roll under a camera at 1.6 m, and its samples from 6 to 24 m.
const Eigen::Vector3d kDown = Eigen::Vector3d(0.03, 1, -0.04).normalized();
constexpr double kHeight = 1.6;

std::vector<DepthSample> road(double noise_m, Random& random) {
  std::vector<DepthSample> samples;
  for (int k = 0; k < 400; ++k) {
    const double x = random.uniform(-3, 3), z = random.uniform(6, 24);
    const double y = (kHeight - kDown.x() * x - kDown.z() * z) / kDown.y();
    samples.push_back(
        {0, 0, Eigen::Vector3d(x, y + random.normal(0, noise_m), z).cast<float>(), k % 2});
  }
  return samples;
}

TEST(GroundProfileHeight, InterpolatesTheRiseBetweenItsSteps) {
  GroundProfile ground;
  ground.down = kDown, ground.camera_height_m = 2;
  const Eigen::Vector3d point(1, 1.2, 8);
  EXPECT_NEAR(ground.height_of(point), 2 - kDown.dot(point), 1e-12);
  ground.rise_m = {0, 0.4, 1};  // at 2, 6 and 10 m
  const auto rise_at = [&](double z) {
    return 2 - kDown.dot(Eigen::Vector3d(0, 0, z)) - ground.height_of({0, 0, z});
  };
  for (const auto& [z, rise] :
       {std::pair{0.0, 0.0}, {2.0, 0.0}, {3.0, 0.1}, {6.0, 0.4}, {9.0, 0.85}, {50.0, 1.0}})
    EXPECT_NEAR(rise_at(z), rise, 1e-12) << z;
}

TEST(FitGround, FindsTheRoadUnderThingsThatStandOnIt) {
  Random random(1);
  std::vector<DepthSample> samples = road(0.02, random);
  for (std::size_t i = 0; i < samples.size(); i += 3)  // a third is up to 1.2 m above it
    samples[i].point.y() -= static_cast<float>(random.uniform(0.2, 1.2));
  const GroundProfile ground = fit_ground(samples, {0.9f, 0.6f}, 0);
  ASSERT_TRUE(ground.outcome);
  // 270 points with 2 cm of noise over 18 m; what stands near the road takes some of the weight.
  EXPECT_NEAR(ground.camera_height_m, kHeight, 0.03);
  EXPECT_LT((ground.down - kDown).norm(), 3e-3);
  for (const double z : {8.0, 20.0}) {
    const double y = (kHeight - kDown.z() * z) / kDown.y();
    EXPECT_NEAR(ground.height_of({0, y, z}), 0, 0.03) << z;
    EXPECT_NEAR(ground.height_of(Eigen::Vector3d(0, y, z) - 2 * kDown), 2, 0.03) << z;
  }
}

TEST(FitGround, FollowsAHillBeyondThePlane) {
  Random random(2);
  std::vector<DepthSample> samples = road(0.01, random);
  for (int k = 0; k < 200; ++k) {  // from 28 to 32 m the road is 0.3 m higher
    const double x = random.uniform(-3, 3), z = random.uniform(28, 32);
    const double y = (kHeight - 0.3 - kDown.x() * x - kDown.z() * z) / kDown.y();
    samples.push_back({0, 0, Eigen::Vector3d(x, y, z).cast<float>(), 0});
  }
  const GroundProfile ground = fit_ground(samples, {1, 1}, 0);
  ASSERT_EQ(ground.rise_m.size(), 8u);
  // The plane is known to 1 mm in its middle, and to a few over the distance.
  EXPECT_NEAR(ground.rise_m[3], 0, 0.01);
  EXPECT_NEAR(ground.rise_m[7], 0.3, 0.02);
}

TEST(FitGround, IsALevelPlaneWhereNoGroundIsSeen) {
  Random random(3);
  const std::vector<DepthSample> samples = road(0.01, random);
  for (const auto& shares : {std::vector<float>{0.4f, 0.3f}, {0.49f, 0.0f}}) {
    const GroundProfile ground = fit_ground(samples, shares, 1.2);
    EXPECT_EQ(ground.outcome.code, Outcome::Code::kTooFewData);
    EXPECT_NEAR(ground.height_of({3, 1.2, 9}), 0, 1e-12);
    EXPECT_NEAR(ground.height_of({3, 0.2, 30}), 1, 1e-12);
  }
  const std::vector<DepthSample> few(samples.begin(), samples.begin() + 59);
  EXPECT_FALSE(fit_ground(few, {1, 1}, 1.2).outcome);
}

TEST(PlaceRegions, RecoversPlanesAndTheirInclination) {
  const GroundProfile level{Outcome::ok(), Eigen::Vector3d::UnitY(), 1.6, {}};
  const Eigen::Vector3d ground(0, 1, 0), wall(0.6, 0, 0.8);
  std::vector<DepthSample> samples;
  for (int v = 0; v < 40; v += 4)
    for (int u = 0; u < 40; u += 4) {
      samples.push_back(on_plane(380 + u, 320 + v, ground, 1.6, 0));
      samples.push_back(on_plane(380 + u, 100 + v, wall, 9, 2));
      if (v < 8 && u < 8 && v + u > 0) samples.push_back(on_plane(u, v, wall, 9, 3));
    }
  // A twelfth of the wall's samples are far behind it.
  for (std::size_t i = 0; i < samples.size(); i += 25)
    if (samples[i].superpixel == 2) samples[i].point *= 1.5f;
  const std::vector<RegionPlace> places =
      place_regions(samples, 4, kCamera, kFocalTimesBaseline, level);
  ASSERT_EQ(places.size(), 4u);
  EXPECT_EQ(places[0].samples, 100);
  EXPECT_NEAR((places[0].plane - ground / 1.6).norm(), 0, 1e-3);
  EXPECT_NEAR(places[0].upness, 1, 1e-4);
  EXPECT_NEAR(places[0].height_m, 0, 1e-5);
  EXPECT_NEAR((places[2].plane - wall / 9).norm(), 0, 2e-3);
  EXPECT_NEAR(places[2].upness, 0, 0.02);
  EXPECT_NEAR(places[2].depth_m, 9 / 0.8, 0.3);
  EXPECT_LE(places[2].low_m, places[2].height_m);
  for (const std::size_t without : {1u, 3u}) {  // no sample, and three of them
    EXPECT_TRUE(places[without].plane.isZero());
    EXPECT_EQ(places[without].upness_sigma, 1);
  }
  EXPECT_EQ(places[3].samples, 3);
}

SceneModel classes_of_streets() {
  SceneModel model;
  model.classes = {"Sky", "Road", "Building", "Sign", "Thing"};
  model.surfaces = {Surface::kSky, Surface::kGround, Surface::kVertical, Surface::kVertical,
                    Surface::kObject};
  return model;
}

RegionPlace region_at(double height_m, double upness, double upness_sigma) {
  RegionPlace place;
  place.plane = {0, 0, 0.1};
  place.height_m = height_m, place.depth_m = 10;
  place.upness = upness, place.upness_sigma = upness_sigma;
  return place;
}

TEST(GeometryLogLikelihoods, AreDensitiesOfTheHeight) {
  // Of an unknown orientation: the integral over all heights is 1 for a class, and for the share of
  // outliers 1/14 a metre.
  const StreetGeometryOptions options;
  const SceneModel model = classes_of_streets();
  constexpr double kStep = 0.005, kLow = -4, kHigh = 18;
  std::vector<RegionPlace> regions;
  for (double height = kLow + kStep / 2; height < kHigh; height += kStep)
    regions.push_back(region_at(height, 0.5, 1));
  const std::vector<float> logs = geometry_log_likelihoods(regions, model, options);
  for (std::size_t c = 0; c < model.classes.size(); ++c) {
    double sum = 0;
    for (std::size_t i = 0; i < regions.size(); ++i)
      sum += kStep * std::exp(static_cast<double>(logs[i * model.classes.size() + c]));
    const double outliers = options.outliers * (kHigh - kLow) / 14;
    EXPECT_NEAR(sum, outliers + (c == 0 ? 0 : 1 - options.outliers), 2e-3) << model.classes[c];
  }
}

TEST(GeometryLogLikelihoods, TellGroundFromWallsByTheirInclination) {
  const SceneModel model = classes_of_streets();
  const auto logs_of = [&](const RegionPlace& place, const StreetGeometryOptions& options) {
    return geometry_log_likelihoods({place}, model, options);
  };
  const std::vector<float> flat = logs_of(region_at(0, 1, 0.1), {});
  const std::vector<float> upright = logs_of(region_at(0.3, 0, 0.1), {});
  EXPECT_EQ(std::max_element(flat.begin(), flat.end()) - flat.begin(), 1);
  EXPECT_EQ(std::max_element(upright.begin() + 1, upright.begin() + 3) - upright.begin(), 2);
  const std::vector<float> twice = logs_of(region_at(0, 1, 0.1), {.weight = 2});
  for (std::size_t c = 0; c < flat.size(); ++c) EXPECT_NEAR(twice[c], 2 * flat[c], 1e-5);
  for (const float value : logs_of(region_at(0, 1, 0.1), {.weight = 0})) EXPECT_EQ(value, 0);
  for (const float value : logs_of(RegionPlace{}, {})) EXPECT_EQ(value, 0);  // nothing is known
}

}  // namespace street_geometry_test
}  // namespace placegraph
