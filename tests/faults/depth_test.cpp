#include "tests/faults/small_recording.h"

namespace placegraph::faults::test {
namespace depth_test {

TEST(FaultDepth, LeavesImagesAsTheyAre) {
  const Recording recording = small_recording();
  for (const Fault& fault : depth_faults()) {
    SCOPED_TRACE(fault.name);
    EXPECT_EQ(fault.sensors, "rgbd");
    EXPECT_TRUE(equal(fault.apply(recording, 1).frames[30].image, recording.frames[30].image));
  }
}

TEST(FaultDepth, StatesAnotherUnit) {
  const Recording recording = small_recording();
  const auto ratio = [&](const char* name) {
    const Recording out = faulty(recording, name);
    return out.stated_depth_unit_m / out.depth_unit_m;
  };
  EXPECT_NEAR(ratio("depth_unit_1000"), 1000, 1e-9);
  EXPECT_NEAR(ratio("depth_unit_5"), 5, 1e-9);
  EXPECT_NEAR(ratio("depth_unit_tenth_more"), 1.1, 1e-9);
}

TEST(FaultDepth, TakesTheDepthOfAnotherFrame) {
  const Recording recording = small_recording();
  const auto depth = [&](const char* name, std::size_t i) {
    return faulty(recording, name).frames[i].depth;
  };
  EXPECT_TRUE(equal(depth("depth_late_1", 30), recording.frames[29].depth));
  EXPECT_TRUE(equal(depth("depth_late_5", 30), recording.frames[25].depth));
  EXPECT_TRUE(equal(depth("depth_late_20", 30), recording.frames[10].depth));
  EXPECT_TRUE(equal(depth("depth_late_20", 10), recording.frames[0].depth));
  const Recording others = faulty(recording, "depth_of_others");
  int own = 0;
  for (std::size_t i = 0; i < 60; ++i)
    own += equal(others.frames[i].depth, recording.frames[i].depth);
  EXPECT_LT(own, 10);
}

TEST(FaultDepth, MovesDepthWithinTheImage) {
  const Recording recording = small_recording();
  const Image& depth = recording.frames[0].depth;
  const auto value = [&](const char* name, int v, int u) {
    return faulty(recording, name).frames[0].depth.at<float>(v, u);
  };
  EXPECT_EQ(value("depth_mirrored", 5, 10), depth.at<float>(5, 85));
  EXPECT_EQ(value("depth_upside_down", 5, 10), depth.at<float>(58, 85));
  EXPECT_EQ(value("depth_shifted", 5, 50), depth.at<float>(5, 42));
}

TEST(FaultDepth, ChangesTheValues) {
  const Recording recording = small_recording();
  const auto depth = [&](const char* name, std::size_t i = 30) {
    return faulty(recording, name).frames[i].depth;
  };
  EXPECT_EQ(mean_of(depth("depth_constant")), 2);
  EXPECT_EQ(contrast_of(depth("depth_constant")), 0);
  EXPECT_EQ(cv::countNonZero(depth("depth_none")), 0);
  EXPECT_EQ(cv::countNonZero(depth("depth_none_while")), 0);
  EXPECT_GT(cv::countNonZero(depth("depth_none_while", 50)), 0);
  const double measured = cv::countNonZero(depth("depth_holes")) / (64.0 * 96);
  EXPECT_GT(measured, 0.3);
  EXPECT_LT(measured, 0.7);
  EXPECT_NEAR(mean_of(depth("depth_offset")), mean_of(recording.frames[30].depth) + 0.5, 1e-4);
  Image ratio = depth("depth_noise") / recording.frames[30].depth;
  EXPECT_NEAR(contrast_of(ratio), 0.1, 0.01);
}

TEST(FaultDepth, OffsetLeavesWhatWasNotMeasured) {
  Recording recording = small_recording();
  recording.frames[3].depth = recording.frames[3].depth.clone();
  recording.frames[3].depth.at<float>(4, 4) = 0;
  EXPECT_EQ(faulty(recording, "depth_offset").frames[3].depth.at<float>(4, 4), 0);
}

}  // namespace depth_test
}  // namespace placegraph::faults::test
