#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/pipeline/health/repeated_images.h>

namespace placegraph {
namespace repeated_images_test {

/// A note for images that are each of one grey level.
std::optional<DataNote> note_for(const std::vector<int>& levels) {
  RepeatedImages repeated;
  std::int64_t id = 10;
  for (const int level : levels) {
    Frame frame;
    frame.id = FrameId(id++);
    frame.image = Image(20, 30, CV_8UC1, cv::Scalar(level));
    repeated.add(frame);
  }
  return repeated.note();
}

TEST(RepeatedImages, AreCounted) {
  EXPECT_FALSE(note_for({}));
  EXPECT_FALSE(note_for({1, 2, 3, 2, 1, 2, 3}));
  EXPECT_FALSE(note_for({1, 1, 1, 2, 3}));
  const auto note = note_for({5, 1, 1, 1, 1, 2});
  ASSERT_TRUE(note);
  EXPECT_EQ(note->cause, NoteCause::kRepeatedFrames);
  EXPECT_THAT(note->text, testing::HasSubstr("3 of 6 images repeat the one before them"));
  EXPECT_THAT(note->text, testing::HasSubstr("frame 12"));
}

TEST(RepeatedImages, ArePartsOfLargerOnesToo) {
  const Image large(40, 60, CV_8UC1, cv::Scalar(7));
  RepeatedImages repeated;
  for (int i = 0; i < 5; ++i) {
    Frame frame;
    frame.id = FrameId(i);
    frame.image = large(cv::Rect(2 * i, 3, 30, 20));
    repeated.add(frame);
  }
  EXPECT_TRUE(repeated.note());
}

}  // namespace repeated_images_test
}  // namespace placegraph
