#include <gtest/gtest.h>
#include <placegraph/eval/scene/flow_error.h>
#include <placegraph/graph/core/error.h>

#include <limits>

namespace placegraph {
namespace flow_error_test {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

TEST(FlowError, CountsWhatHasTruthInsideTheImage) {
  Image truth(2, 3, CV_32FC2, cv::Scalar::all(0)), flow = truth.clone();
  truth.at<cv::Vec2f>(0, 0) = {kUnknown, kUnknown};
  truth.at<cv::Vec2f>(0, 2) = {1, 0};  // leaves the image
  flow.at<cv::Vec2f>(1, 0) = {3, 4};   // 5 px off
  flow.at<cv::Vec2f>(1, 1) = {0, 1};   // 1 px off
  flow.at<cv::Vec2f>(1, 2) = {kUnknown, kUnknown};
  const FlowError error = flow_error(flow, truth);
  EXPECT_EQ(error.pixels, 4);
  EXPECT_EQ(error.compared, 3);
  EXPECT_DOUBLE_EQ(error.coverage, 0.75);
  EXPECT_DOUBLE_EQ(error.mean_px, 2);
  EXPECT_DOUBLE_EQ(error.median_px, 1);
  EXPECT_DOUBLE_EQ(error.share_beyond_3px, 1.0 / 3);
}

TEST(FlowError, CanBeAskedOfOneRangeOfMotion) {
  Image truth(2, 3, CV_32FC2, cv::Scalar::all(0));
  truth.at<cv::Vec2f>(0, 0) = {2, 0};
  EXPECT_EQ(flow_error(truth, truth, {0, 2}).pixels, 5);
  EXPECT_EQ(flow_error(truth, truth, {2, 10}).pixels, 1);
}

TEST(FlowError, RefusesOtherImages) {
  EXPECT_THROW((void)flow_error(Image(2, 2, CV_32FC2), Image(2, 3, CV_32FC2)), ArgumentError);
  EXPECT_THROW((void)flow_error(Image(2, 2, CV_32FC1), Image(2, 2, CV_32FC2)), ArgumentError);
}

}  // namespace flow_error_test
}  // namespace placegraph
