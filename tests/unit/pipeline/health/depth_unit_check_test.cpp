#include <gtest/gtest.h>
#include <placegraph/pipeline/health/depth_unit_check.h>

namespace placegraph {
namespace depth_unit_check_test {

/// A floor that recedes from 0.7 to 4 m, with a part that was not measured, in another unit.
std::optional<DataNote> note_for(double unit) {
  DepthUnitCheck range;
  for (int i = 0; i < 40; ++i) {
    Frame frame;
    frame.id = FrameId(i);
    frame.depth = Image::zeros(240, 320, CV_32FC1);
    for (int v = 40; v < 240; ++v)
      for (int u = 0; u < 320; ++u)
        frame.depth.at<float>(v, u) = static_cast<float>(unit * (0.7 + 3.3 * (240 - v) / 200));
    range.add(frame);
  }
  return range.note();
}

TEST(DepthUnitCheck, AcceptsWhatDepthCamerasMeasure) {
  EXPECT_FALSE(note_for(1));
  EXPECT_FALSE(note_for(0.4));
  EXPECT_FALSE(note_for(2.5));
}

TEST(DepthUnitCheck, FindsAnotherUnit) {
  for (const double unit : {0.001, 0.1, 5.0, 1000.0}) {
    const auto note = note_for(unit);
    ASSERT_TRUE(note) << unit;
    EXPECT_EQ(note->cause, NoteCause::kDepthUnit);
    EXPECT_TRUE(note->doubts_scale);
  }
}

TEST(DepthUnitCheck, NeedsDepths) {
  DepthUnitCheck range;
  Frame frame;
  range.add(frame);
  frame.depth = Image::zeros(240, 320, CV_32FC1);
  for (int i = 0; i < 40; ++i) range.add(frame);
  EXPECT_FALSE(range.note());
}

}  // namespace depth_unit_check_test
}  // namespace placegraph
