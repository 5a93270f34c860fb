#include <gtest/gtest.h>
#include <placegraph/graph/internal/core/random.h>
#include <placegraph/pipeline/internal/health/depth_agreement.h>

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace {

/// Inverse depths of a scene, measured with 2 % noise; a fifth are wrong.
std::vector<TwoInverseDepths> depths_of(bool belong, double sigma, Random& random) {
  std::vector<TwoInverseDepths> depths;
  for (int i = 0; i < 100; ++i) {
    const double w = random.uniform(0.2, 1), other = random.uniform(0.2, 1);
    const bool right = belong && i % 5 != 0;
    depths.push_back({3 * w + sigma * random.normal(), sigma,
                      (right ? w : other) * (1 + 0.02 * random.normal())});
  }
  return depths;
}

TEST(UnexplainedShare, IsSmallWhereDepthsBelongToTheViews) {
  Random random(1);
  EXPECT_LT(*unexplained_share(depths_of(true, 0.05, random)), 0.2);
  EXPECT_GT(*unexplained_share(depths_of(false, 0.05, random)), 0.6);
}

TEST(UnexplainedShare, IsUnknownForFewOrEqualDepths) {
  Random random(1);
  auto depths = depths_of(true, 0.05, random);
  depths.resize(30);
  EXPECT_FALSE(unexplained_share(depths));
  EXPECT_FALSE(unexplained_share(depths_of(true, 0.5, random)));
}

/// A walk to the side through the street, of images with depth images that `change` may replace.
std::optional<DataNote> note_of_walk(
    const std::function<Image(int, const std::function<Image(int)>&)>& depth_of) {
  constexpr int kFrames = 130;
  const Camera camera = test::street_camera();
  const auto planes = test::street();
  Calibration calibration;
  calibration.camera = camera;
  calibration.depth = DepthCamera{camera, SE3()};
  const auto T_world_cam = [](int i) {
    return test::pose({0, 0.1 * std::sin(0.1 * i), 0},
                      {2 * std::sin(0.05 * i), -1.65 + 0.3 * std::cos(0.1 * i), 0.03 * i});
  };
  const auto depth_at = [&](int i) {
    return test::render(camera, T_world_cam(i), planes, 1).depth;
  };
  DepthAgreement agreement(calibration);
  for (int i = 0; i < kFrames; ++i) {
    Frame frame;
    frame.id = FrameId(i);
    frame.image = test::render(camera, T_world_cam(i), planes, 1).grey;
    frame.depth = depth_of(i, depth_at);
    agreement.add(frame);
  }
  return agreement.note();
}

TEST(DepthAgreement, AcceptsTheDepthOfTheImages) {
  EXPECT_FALSE(note_of_walk([](int i, const auto& depth_at) { return depth_at(i); }));
}

TEST(DepthAgreement, FindsMirroredAndConstantDepths) {
  const auto mirrored = note_of_walk([](int i, const auto& depth_at) {
    Image mirrored;
    cv::flip(depth_at(i), mirrored, 1);
    return mirrored;
  });
  ASSERT_TRUE(mirrored);
  EXPECT_EQ(mirrored->cause, NoteCause::kDepthMismatch);
  EXPECT_TRUE(mirrored->doubts_scale);
  EXPECT_TRUE(note_of_walk([](int, const auto&) {
    const Camera camera = test::street_camera();
    return Image(camera.height, camera.width, CV_32FC1, cv::Scalar(2));
  }));
}

}  // namespace
}  // namespace placegraph
