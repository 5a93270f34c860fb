#include <gtest/gtest.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>
#include <placegraph/io/synthetic/worlds/tours.h>

#include <opencv2/core.hpp>

namespace placegraph {
namespace repeated_blocks_test {

constexpr double kBlock_m = 64;

SyntheticWorld world() {
  SyntheticOptions options;
  options.world = "repeated-blocks";
  options.difficulty = synthetic::Difficulty::kClean;
  options.width = 248;
  options.height = 75;
  return SyntheticWorld(options);
}

/// What a camera 20 m into a block sees, `shift_m` further down the street.
Image render_view(const SyntheticWorld& street, double shift_m) {
  const synthetic::Tour& tour = street.tour();
  const SE3& T = tour.T_scene_cam.front();
  const synthetic::View view{
      tour.camera, SE3(T.rotation(), T.translation() + Eigen::Vector3d(0, 0, 20 + shift_m)), 0};
  return synthetic::render(tour.scene, view, 1, false, 1).grey;
}

double mean_difference(const Image& a, const Image& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total());
}

TEST(RepeatedBlocks, LookTheSameFromBlockToBlockAndNowhereWithinOne) {
  const SyntheticWorld street = world();
  const Image here = render_view(street, 0);
  const double contrast =
      mean_difference(here, Image(cv::Mat(here.size(), here.type(), cv::mean(here))));
  for (int block = 1; block < 5; ++block) {
    // The end of the street, a few pixels high, is another.
    EXPECT_LT(mean_difference(here, render_view(street, block * kBlock_m)), 0.02 * contrast)
        << block;
    EXPECT_GT(mean_difference(here, render_view(street, (block - 0.5) * kBlock_m)), 0.2 * contrast);
  }
}

TEST(RepeatedBlocks, AreDrivenOnce) {
  const SyntheticWorld street = world();
  const auto& poses = street.tour().T_scene_cam;
  for (std::size_t i = 1; i < poses.size(); ++i)
    EXPECT_GT(poses[i].translation().z(), poses[i - 1].translation().z());
  EXPECT_GT(poses.back().translation().z() - poses.front().translation().z(), 6.5 * kBlock_m);
}

}  // namespace repeated_blocks_test
}  // namespace placegraph
