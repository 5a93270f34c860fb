#include <gtest/gtest.h>
#include <placegraph/frontend/scene/street_labelling.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace street_labelling_test {

const Camera kCamera{320, 160, 200, 200, 159.5, 79.5};
constexpr double kBaseline_m = 0.5;

/// Depths of a street: ground 1.5 m below a level camera, a wall across at 20 m from the ground up.
Image street_depths(double wall_m = 20) {
  Image depth(kCamera.height, kCamera.width, CV_32FC1, cv::Scalar(0));
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) {
      const double y = (v - kCamera.cy) / kCamera.fy;
      const double ground = y > 0 ? 1.5 / y : 1e9;
      const double z = std::min(ground, wall_m);
      depth.at<float>(v, u) = static_cast<float>(z);
    }
  return depth;
}

/// Samples of every fourth pixel, each in the square of 16 pixels that it lies in.
std::vector<DepthSample> samples_of(const Image& depth) {
  std::vector<DepthSample> samples;
  for (int v = 2; v < depth.rows; v += 4)
    for (int u = 2; u < depth.cols; u += 4) {
      const float z = depth.at<float>(v, u);
      DepthSample s;
      s.u = static_cast<float>(u), s.v = static_cast<float>(v);
      s.point = Eigen::Vector3f(static_cast<float>((u - kCamera.cx) / kCamera.fx),
                                static_cast<float>((v - kCamera.cy) / kCamera.fy), 1) *
                z;
      s.superpixel = (v / 16) * (kCamera.width / 16) + u / 16;
      samples.push_back(s);
    }
  return samples;
}
constexpr int kRegions = (320 / 16) * (160 / 16);

std::vector<float> lower_half_is_ground() {
  std::vector<float> share(kRegions, 0);
  for (int i = kRegions * 6 / 10; i < kRegions; ++i) share[static_cast<std::size_t>(i)] = 0.9F;
  return share;
}

SceneModel model_of(const std::vector<std::pair<std::string, Surface>>& classes) {
  SceneModel model;
  model.kind = SceneModel::Kind::kUrban;
  for (const auto& [name, surface] : classes)
    model.classes.push_back(name), model.surfaces.push_back(surface);
  return model;
}

TEST(GroundProfile, FindsThePlaneUnderTheCamera) {
  const GroundProfile ground = fit_ground(samples_of(street_depths()), lower_half_is_ground(), 0);
  ASSERT_TRUE(ground.outcome) << ground.outcome.reason;
  EXPECT_NEAR(ground.camera_height_m, 1.5, 0.01);
  EXPECT_NEAR(ground.down[1], 1, 1e-4);
  EXPECT_NEAR(ground.height_of({0, 0.5, 10}), 1, 0.02);
}

TEST(GroundProfile, IsTheCamerasWhereNoneIsSeen) {
  const GroundProfile ground = fit_ground({}, {}, 1.65);
  EXPECT_EQ(ground.outcome.code, Outcome::Code::kTooFewData);
  EXPECT_NEAR(ground.height_of({0, 0.65, 10}), 1, 1e-9);
}

TEST(StreetGeometry, GroundLiesAndWallsStand) {
  const std::vector<DepthSample> samples = samples_of(street_depths());
  const GroundProfile ground = fit_ground(samples, lower_half_is_ground(), 0);
  const auto places = place_regions(samples, kRegions, kCamera, kCamera.fx * kBaseline_m, ground);
  const SceneModel model = model_of({{"Sky", Surface::kSky},
                                     {"Road", Surface::kGround},
                                     {"Building", Surface::kVertical},
                                     {"Car", Surface::kObject}});
  const std::vector<float> likelihood = geometry_log_likelihoods(places, model, {});
  const auto of = [&](int region) { return likelihood.data() + region * 4; };
  const float* road = of(8 * 20 + 10);  // rows 128 to 143: 5 m away
  EXPECT_NEAR(places[8 * 20 + 10].upness, 1, 0.02);
  EXPECT_GT(road[1], road[2] + 1);
  EXPECT_GT(road[1], road[3] + 1);
  EXPECT_GT(road[1], road[0] + 2);
  const float* wall = of(3 * 20 + 10);  // 2.4 m up the wall
  EXPECT_NEAR(places[3 * 20 + 10].upness, 0, 0.05);
  EXPECT_GT(wall[2], wall[1] + 2);
  EXPECT_GT(wall[2], wall[3] + 0.5);
  StreetGeometryOptions none;
  none.weight = 0;
  EXPECT_EQ(geometry_log_likelihoods(places, model, none),
            std::vector<float>(likelihood.size(), 0.0F));
}

TEST(StreetGeometry, SaysNothingOfRegionsWithoutDepth) {
  const GroundProfile ground = fit_ground({}, {}, 1.65);
  const auto places = place_regions({}, 3, kCamera, 100, ground);
  for (const float l : geometry_log_likelihoods(
           places, model_of({{"Sky", Surface::kSky}, {"Road", Surface::kGround}}), {}))
    EXPECT_EQ(l, 0);
}

TEST(SeenThrough, TellsWhatWasNotThereBefore) {
  // A car's back at 8 m, that the image before saw the wall behind of; a point of the wall itself,
  // one that is hidden behind it, and one out of view.
  std::vector<StreetPoint> points(4);
  points[0].point = {0.3F, 0.3F, 8};
  points[1].point = {0.3F, -0.5F, 20};
  points[2].point = {0.3F, -0.5F, 30};
  points[3].point = {30, 0, 8};
  const SE3 T_other_cam(SO3(), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(seen_through(points, T_other_cam, street_depths(), kCamera, kBaseline_m),
            (std::vector<bool>{true, false, false, false}));
  // Nothing that is uncertain by as much is said to have moved.
  points[0].sigma = 8;
  EXPECT_FALSE(seen_through(points, T_other_cam, street_depths(), kCamera, kBaseline_m)[0]);
}

TEST(SeenThrough, FollowsTheMotionOfTheCamera) {
  std::vector<StreetPoint> points(1);
  points[0].point = {0.3F, -0.5F, 18};
  // The other camera stood 2 m farther back: there the wall's point is 20 m away.
  EXPECT_FALSE(seen_through(points, SE3(SO3(), Eigen::Vector3d(0, 0, 2)), street_depths(), kCamera,
                            kBaseline_m)[0]);
  points[0].point = {0.3F, -0.5F, 8};
  EXPECT_TRUE(seen_through(points, SE3(SO3(), Eigen::Vector3d(0, 0, 2)), street_depths(), kCamera,
                           kBaseline_m)[0]);
}

}  // namespace street_labelling_test
}  // namespace placegraph
