#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/pipeline/health/stereo_check.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace stereo_check_test {

using testing::HasSubstr;

/// A drive along the street by two eyes, the right one's images warped.
class WarpedStreet : public test::StreetDataset {
 public:
  explicit WarpedStreet(cv::Mat warp) : StreetDataset(4), warp_(std::move(warp)) {}
  Frame frame(std::size_t index, Sensor sensor) const override {
    Frame frame = StreetDataset::frame(index, sensor);
    Image right;
    cv::warpAffine(frame.right, right, warp_, frame.right.size(), cv::INTER_LINEAR,
                   cv::BORDER_REPLICATE);
    frame.right = right;
    return frame;
  }

 private:
  cv::Mat warp_;
};

const Camera kCamera = test::street_camera();

cv::Mat rotated(double angle_deg, double zoom, double down_px) {
  cv::Mat warp = cv::getRotationMatrix2D(
      {static_cast<float>(kCamera.cx), static_cast<float>(kCamera.cy)}, angle_deg, zoom);
  warp.at<double>(1, 2) += down_px;
  return warp;
}

std::optional<DataNote> note_of(const cv::Mat& warp) {
  const WarpedStreet street(warp);
  return odd_rows(check_rows(street), kCamera);
}

TEST(StereoCheck, SaysNothingOfARectifiedPair) {
  EXPECT_FALSE(odd_rows(check_rows(test::StreetDataset(4)), kCamera));
  EXPECT_FALSE(note_of(rotated(0, 1, 0.2)));
}

TEST(StereoCheck, SaysHowFarRowsAreOffAndWhy) {
  const auto rolled = note_of(rotated(1, 1, 0));
  ASSERT_TRUE(rolled);
  EXPECT_TRUE(rolled->doubts_scale);
  EXPECT_THAT(rolled->text, HasSubstr("as if the right camera were rolled by"));
  EXPECT_THAT(rolled->text, HasSubstr("rectify the pair first"));
  const auto lower = note_of(rotated(0, 1, 3));
  ASSERT_TRUE(lower);
  EXPECT_THAT(lower->text, HasSubstr("px off their rows"));
  EXPECT_THAT(lower->text, HasSubstr("rows too low"));
  const auto zoomed = note_of(rotated(0, 1.02, 0));
  ASSERT_TRUE(zoomed);
  EXPECT_THAT(zoomed->text, HasSubstr("% larger"));
  EXPECT_TRUE(note_of(rotated(0, 1, 30)));
}

TEST(StereoCheck, TellsSwappedCameras) {
  class Swapped : public test::StreetDataset {
   public:
    using StreetDataset::StreetDataset;
    Frame frame(std::size_t index, Sensor sensor) const override {
      Frame frame = StreetDataset::frame(index, sensor);
      std::swap(frame.image, frame.right);
      return frame;
    }
  };
  const auto note = odd_rows(check_rows(Swapped(4)), kCamera);
  ASSERT_TRUE(note);
  EXPECT_THAT(note->text, HasSubstr("are the cameras swapped?"));
}

TEST(StereoCheck, DoesNotJudgeWhatShowsNothing) {
  EXPECT_FALSE(odd_rows(check_rows(test::StreetDataset(4, 0, 4)), kCamera));
}

}  // namespace stereo_check_test
}  // namespace placegraph
