#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/defects/defects.h>
#include <placegraph/io/synthetic/render/sensor_model.h>

#include <opencv2/core.hpp>

namespace placegraph::synthetic {
namespace sensor_model_test {

struct Flat {
  View view;
  Rendering rendering;
  std::vector<AffineMap> still{AffineMap{}};
};

Flat flat_grey(float value) {
  Flat out;
  out.view.camera.width = 300;
  out.view.camera.height = 200;
  out.view.camera.fx = out.view.camera.fy = 250;
  out.view.camera.cx = 150;
  out.view.camera.cy = 100;
  out.rendering.grey = Image(200, 300, CV_32FC1, cv::Scalar(value));
  out.rendering.inverse_depth = Image(200, 300, CV_32FC1, cv::Scalar(0.1));
  out.rendering.mover = Image(200, 300, CV_16SC1, cv::Scalar(-1));
  return out;
}

TEST(SensorModel, CleanPassesGreyLevelsThrough) {
  const Flat flat = flat_grey(0.5F);
  const Image image =
      expose(flat.rendering, flat.view, flat.still, sensor_model(Difficulty::kClean), 1, 2);
  double low = 0, high = 0;
  cv::minMaxLoc(image, &low, &high);
  EXPECT_EQ(low, 128);  // 0.5 * 255, rounded
  EXPECT_EQ(high, 128);
}

TEST(SensorModel, StandardHasTwoGreyLevelsOfNoiseAndFivePercentOfExposure) {
  const SensorModel model = sensor_model(Difficulty::kStandard);
  EXPECT_EQ(model.noise_grey, 2);
  double lowest = 1e9, highest = 0;
  for (int second = 0; second < 200; second += 5) {
    Flat flat = flat_grey(0.5F);
    flat.view.time_s = second;
    const Image image = expose(flat.rendering, flat.view, flat.still, model, second, 2);
    cv::Scalar mean, sigma;
    cv::meanStdDev(image, mean, sigma);
    // 60000 pixels: sigma is known to 0.3 %; rounding adds 1/12 to the variance.
    EXPECT_NEAR(sigma[0], std::sqrt(4 + 1.0 / 12), 0.03);
    lowest = std::min(lowest, mean[0]);
    highest = std::max(highest, mean[0]);
  }
  EXPECT_GT(lowest, 127.5 * 0.95 - 0.1);
  EXPECT_LT(highest, 127.5 * 1.05 + 0.1);
  EXPECT_GT(highest - lowest, 127.5 * 0.04);  // it does wander
}

TEST(SensorModel, MotionBlurSpreadsAnEdgeOverTheMotionDuringTheShutter) {
  Flat flat = flat_grey(0);
  flat.rendering.grey.colRange(150, 300).setTo(1);
  SensorModel model;
  model.shutter_s = 0.01;
  // 10 m away, moving sideways at 40 m/s: 250 * 40 * 0.1 * 0.01 = 10 px.
  flat.still[0].offset = {40, 0, 0};
  const Image image = expose(flat.rendering, flat.view, flat.still, model, 1, 2);
  const auto* row = image.ptr<unsigned char>(100);
  EXPECT_EQ(row[149 - 7], 0);
  EXPECT_EQ(row[150 + 7], 255);
  EXPECT_NEAR(row[149], 128, 20);
  EXPECT_NEAR(0.5 * (row[147] + row[152]), 128, 3);  // symmetric: the stamp is mid-exposure
}

TEST(SensorModel, NamesItsLevelsWhenAskedForAnother) {
  EXPECT_EQ(difficulty_from("hard"), Difficulty::kHard);
  try {
    difficulty_from("easy");
    FAIL() << "accepted";
  } catch (const ArgumentError& error) {
    EXPECT_STREQ(error.what(), "difficulty: 'easy' is none of clean, standard, hard");
  }
}

}  // namespace sensor_model_test
}  // namespace placegraph::synthetic
