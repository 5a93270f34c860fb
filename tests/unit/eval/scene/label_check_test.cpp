#include <gtest/gtest.h>
#include <placegraph/eval/scene/label_check.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace label_check_test {

Image row_of(const std::vector<std::uint8_t>& values) { return Image(values, true).reshape(1, 1); }

TEST(LabelCheck, CountsByHand) {
  LabelCheck check(3);
  // Five scored pixels: class 0 found twice of three, class 1 once of two; one void; class 2 never
  // occurs.
  check.add(row_of({0, 0, 0, 1, 1, 9}), row_of({0, 0, 1, 1, 2, 0}));
  EXPECT_EQ(check.pixels(), 5);
  EXPECT_DOUBLE_EQ(check.pixel_accuracy(), 3.0 / 5);
  EXPECT_DOUBLE_EQ(check.class_accuracy(), (2.0 / 3 + 1.0 / 2) / 2);
  EXPECT_DOUBLE_EQ(check.iou(0), 2.0 / 3);
  EXPECT_DOUBLE_EQ(check.iou(1), 1.0 / 3);
  EXPECT_DOUBLE_EQ(check.mean_iou(), (2.0 / 3 + 1.0 / 3) / 2);
  EXPECT_EQ(check.count(1, 2), 1);
  EXPECT_TRUE(std::isnan(check.accuracy(2)));
  EXPECT_TRUE(std::isnan(check.calibration_error()));
}

TEST(LabelCheck, AnUnknownPixelIsNotRight) {
  LabelCheck check(2);
  check.add(row_of({0, 1}), row_of({0, 2}));
  EXPECT_DOUBLE_EQ(check.pixel_accuracy(), 0.5);
  EXPECT_EQ(check.count(1, 2), 1);
}

TEST(LabelCheck, TheCalibrationErrorIsTheGapOfEachBin) {
  LabelCheck check(2);
  Image confidence(1, 4, CV_32FC1);
  for (const auto& [at, value] : {std::pair{0, 0.9f}, {1, 0.9f}, {2, 0.6f}, {3, 0.6f}})
    confidence.at<float>(0, at) = value;
  check.add(row_of({0, 0, 1, 1}), row_of({0, 0, 1, 0}), confidence);
  // Two pixels of 0.9, both right: 0.1 off; two of 0.6, one right: 0.1 off.
  EXPECT_NEAR(check.calibration_error(), 0.1, 1e-6);
}

TEST(LabelCheck, RefusesImagesThatDoNotAgree) {
  LabelCheck check(2);
  EXPECT_THROW(check.add(row_of({0, 1}), row_of({0})), ArgumentError);
  EXPECT_THROW(check.add(row_of({0}), row_of({0}), Image(1, 2, CV_32FC1)), ArgumentError);
  EXPECT_THROW(LabelCheck(0), ArgumentError);
}

}  // namespace label_check_test
}  // namespace placegraph
