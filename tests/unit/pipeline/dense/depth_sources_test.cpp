#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/dense/depth_sources.h>

#include <cmath>

#include "tests/support/message_of.h"
#include "tests/support/scenes/observed_map.h"

namespace placegraph {
namespace depth_sources_test {

constexpr double kWall = 3;  // its depth

/// Grey of a wall that is patterned everywhere differently.
double pattern(double x, double y) {
  double sum = 0;
  for (int k = 1; k <= 8; ++k)
    sum += std::sin(7.3 * k * x + 2.1 * k * k * y) * std::cos(6.1 * k * y - 1.7 * k * k * x + k);
  return 120 + 18 * sum;
}

/// A map of keyframes 0.15 m apart that look at a patterned wall, `unit` of the map's units a
/// metre, and its images.
struct WallMap {
  explicit WallMap(double unit = 1) {
    std::vector<SE3> poses;
    for (int i = 0; i < 5; ++i) poses.emplace_back(SO3(), Eigen::Vector3d(0.15 * unit * i, 0, 0));
    test::PointScene scene;
    scene.camera = camera;
    scene.T_ref_cam = poses;
    for (int k = 0; k < 9; ++k)
      scene.points_ref.emplace_back(unit * (k % 3 - 1), unit * (k / 3 - 1), unit * kWall);
    for (const SE3& T : poses) {
      auto& px = scene.px.emplace_back();
      for (const auto& p : scene.points_ref) px.push_back(*camera.project(T.inverse() * p));
    }
    map = test::observed_map(scene);
    geometry = geometry_of(map, 0);
    images.keyframes = geometry.keyframes;
    images.calibration.camera = camera;
    images.frame_of = [this](const Keyframe& keyframe) {
      const double x = 0.15 * static_cast<double>(keyframe.id.value());
      Frame frame;
      frame.image = seen_from(x);
      frame.right = seen_from(x + baseline_m);
      return frame;
    };
  }
  Image seen_from(double x) const {
    Image image(camera.height, camera.width, CV_8UC1);
    for (int v = 0; v < image.rows; ++v)
      for (int u = 0; u < image.cols; ++u)
        image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(
            pattern(x + kWall * (u - camera.cx) / camera.fx, kWall * (v - camera.cy) / camera.fy));
    return image;
  }
  Camera camera{320, 200, 260, 260, 159.5, 99.5};
  double baseline_m = 0.3;
  Map map;
  MapGeometry geometry;
  PosedImages images;
};

/// The share of pixels with a depth within 1 % of `expected`.
double share_at(const Image& depth, double expected) {
  int right = 0;
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u)
      right += std::abs(depth.at<float>(v, u) / expected - 1) < 0.01;
  return static_cast<double>(right) / static_cast<double>(depth.total());
}

TEST(DepthRangeOf, IsThatOfTheObservedLandmarks) {
  const WallMap wall;
  const DepthRange range = depth_range_of(wall.geometry);
  EXPECT_NEAR(range.near, kWall, 1e-9);
  EXPECT_NEAR(range.median, kWall, 1e-9);
  EXPECT_NEAR(range.far, kWall, 1e-9);
  EXPECT_EQ(depth_range_of({}).median, 0);
}

TEST(DepthSources, SensorHasItsGridAndTheColoursOfTheOtherCamera) {
  WallMap wall;
  const SE3 T_cam_depth(SO3(), {0.1, 0, 0});
  wall.images.calibration.depth = DepthCamera{{32, 24, 20, 20, 15.5, 11.5}, T_cam_depth, 0.004};
  wall.images.frame_of = [&](const Keyframe&) {
    Frame frame;
    frame.image = Image(wall.camera.height, wall.camera.width, CV_8UC1, cv::Scalar(0));
    frame.colour = Image(frame.image.size(), CV_8UC3, cv::Scalar(1, 2, 3));
    frame.colour.colRange(160, 320).setTo(cv::Scalar(4, 5, 6));
    frame.depth = Image(24, 32, CV_32FC1, cv::Scalar(2));
    return frame;
  };
  const auto source = depth_by_sensor(wall.images);
  EXPECT_EQ(source->size(), 5u);
  const KeyframeDepth seen = source->of(2);
  EXPECT_NEAR((seen.T_map_cam.translation() - Eigen::Vector3d(0.4, 0, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(seen.camera.width, 32);
  EXPECT_EQ(seen.depth.at<float>(3, 5), 2);
  EXPECT_FLOAT_EQ(seen.sigma_inverse.at<float>(3, 5), 0.004F);
  // The border of the colours is x = 0 of the other camera: column 15.5 - 20 * 0.1 / 2 = 14.5.
  EXPECT_EQ(seen.colour.at<cv::Vec3b>(11, 14), cv::Vec3b(1, 2, 3));
  EXPECT_EQ(seen.colour.at<cv::Vec3b>(11, 15), cv::Vec3b(4, 5, 6));
}

TEST(DepthSources, StereoFindsTheWall) {
  WallMap wall;
  wall.images.calibration.baseline_m = wall.baseline_m;
  const auto source = depth_by_stereo(wall.images, depth_range_of(wall.geometry));
  const KeyframeDepth seen = source->of(1);
  EXPECT_GT(share_at(seen.depth, kWall), 0.6);
  EXPECT_FLOAT_EQ(seen.sigma_inverse.at<float>(0, 0), static_cast<float>(0.3 / (260 * 0.3)));
  EXPECT_EQ(seen.colour.type(), CV_8UC3);
}

TEST(DepthSources, SweepFindsTheWallAtAnyScale) {
  for (const double unit : {1.0, 0.02, 700.0}) {
    const WallMap wall(unit);
    const auto source = depth_by_sweep(wall.images, depth_range_of(wall.geometry));
    const KeyframeDepth seen = source->of(2);
    EXPECT_GT(share_at(seen.depth, unit * kWall), 0.6) << unit;
    EXPECT_GT(seen.sigma_inverse.at<float>(100, 160), 0);
    EXPECT_EQ(seen.colour.size(), seen.depth.size());
  }
}

TEST(DepthSources, SweepBoundsARangeOfFalseLandmarks) {
  const WallMap wall;
  DepthRange range = depth_range_of(wall.geometry);
  range.near *= 1e-6;
  range.far *= 1e6;
  const auto source = depth_by_sweep(wall.images, range);
  EXPECT_GT(share_at(source->of(2).depth, kWall), 0.02);  // the planes are few for the range
}

TEST(DepthSources, NeedWhatTheyAreMadeOf) {
  const WallMap wall;
  const DepthRange range = depth_range_of(wall.geometry);
  EXPECT_THAT(test::message_of<ArgumentError>([&] { depth_by_sensor(wall.images); }),
              testing::HasSubstr("needs a depth camera"));
  EXPECT_THAT(test::message_of<ArgumentError>([&] { depth_by_stereo(wall.images, range); }),
              testing::HasSubstr("needs a baseline"));
  EXPECT_THAT(test::message_of<ArgumentError>([&] { depth_by_sweep(wall.images, {}); }),
              testing::HasSubstr("needs a range of depths"));
}

}  // namespace depth_sources_test
}  // namespace placegraph
