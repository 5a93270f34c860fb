#include "tests/faults/small_recording.h"

namespace placegraph::faults::test {
namespace optics_test {

TEST(FaultOptics, BlackImagesAreWhereTheyShouldBe) {
  const Recording recording = small_recording();
  const auto count = [&](const char* name) {
    int black = 0;
    for (const Frame& frame : faulty(recording, name).frames)
      black += cv::countNonZero(frame.image) == 0 && cv::countNonZero(frame.right) == 0;
    return black;
  };
  EXPECT_EQ(count("black_few"), 5);
  EXPECT_EQ(count("black_many"), 18);
  EXPECT_EQ(count("black_begin"), 6);
  EXPECT_EQ(mean_of(faulty(recording, "black_begin").frames[0].image), 0);
}

TEST(FaultOptics, ExposureFaultsChangeTheMeanGreyLevel) {
  const Recording recording = small_recording();
  const auto ratio = [&](const char* name, std::size_t i) {
    return mean_of(faulty(recording, name).frames[i].image) / mean_of(recording.frames[i].image);
  };
  EXPECT_NEAR(ratio("exposure_steps", 10), 0.4, 0.02);
  EXPECT_GT(ratio("exposure_steps", 30), 1.4);
  EXPECT_GT(ratio("gain_drift", 0), 1.4);
  EXPECT_LT(ratio("gain_drift", 59), 0.2);
  EXPECT_NE(ratio("flicker", 3), ratio("flicker", 4));
  EXPECT_NEAR(ratio("night", 3), 0.1, 0.03);
  const Recording saturated = faulty(recording, "saturation");
  EXPECT_GT(cv::countNonZero(saturated.frames[0].image == 255), 64 * 96 / 2);
  EXPECT_LT(contrast_of(faulty(recording, "low_contrast").frames[0].image),
            0.1 * contrast_of(recording.frames[0].image));
}

TEST(FaultOptics, BlurTakesContrast) {
  const Recording recording = small_recording();
  for (const char* name : {"motion_blur", "motion_blur_burst", "defocus", "defocus_later"}) {
    SCOPED_TRACE(name);
    const Recording out = faulty(recording, name);
    EXPECT_LT(contrast_of(out.frames[out.faulty.last].image),
              0.9 * contrast_of(recording.frames[out.faulty.last].image));
  }
}

TEST(FaultOptics, NoiseHasItsStandardDeviation) {
  const Recording recording = small_recording();
  const auto deviation = [&](const char* name) {
    Image difference;
    cv::subtract(faulty(recording, name).frames[9].image, recording.frames[9].image, difference,
                 cv::noArray(), CV_32F);
    return contrast_of(difference);
  };
  EXPECT_NEAR(deviation("noise_20"), 20, 1);
  EXPECT_NEAR(deviation("noise_60"), 55, 6);  // grey levels end at 0 and 255
  const Recording alone = faulty(recording, "noise_alone");
  EXPECT_NEAR(mean_of(alone.frames[2].image), 128, 4);
}

TEST(FaultOptics, ColourCastVignetteAndLostRows) {
  const Recording recording = small_recording();
  const Image coloured = faulty(recording, "colour_cast").frames[0].image;
  ASSERT_EQ(coloured.type(), CV_8UC3);
  EXPECT_GT(cv::mean(coloured)[2], 4 * cv::mean(coloured)[0]);
  const Image& image = recording.frames[0].image;
  const Image vignetted = faulty(recording, "vignette").frames[0].image;
  EXPECT_LT(vignetted.at<uchar>(0, 0), 0.15 * image.at<uchar>(0, 0));
  EXPECT_GE(vignetted.at<uchar>(32, 48), image.at<uchar>(32, 48) - 1);
  const Image rows = faulty(recording, "lost_rows").frames[0].image;
  int repeated = 0;
  for (int v = 1; v < rows.rows; ++v) repeated += equal(rows.row(v), rows.row(v - 1));
  EXPECT_GT(repeated, 5);
  EXPECT_LT(repeated, 30);
}

TEST(FaultOptics, RollingShutterShearsInTheSenseOfTheRotation) {
  const Recording recording = small_recording();
  const Image out = faulty(recording, "rolling_shutter").frames[5].image;
  const Image& image = recording.frames[5].image;
  EXPECT_TRUE(equal(out.row(0), image.row(0)));
  // A degree to the right is 1.4 px: the last row shows what is further right.
  Image moved = shifted(image, -80 * CV_PI / 180 * 63 / 64, 0, cv::INTER_LINEAR);
  EXPECT_LE(cv::norm(out(cv::Rect(10, 63, 70, 1)), moved(cv::Rect(10, 63, 70, 1)), cv::NORM_INF),
            5);
}

}  // namespace optics_test
}  // namespace placegraph::faults::test
