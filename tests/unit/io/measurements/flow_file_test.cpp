#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/measurements/flow_file.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace flow_file_test {

using testing::HasSubstr;

Image example() {
  Image flow(3, 4, CV_32FC2, cv::Scalar::all(0));
  flow.at<cv::Vec2f>(0, 0) = {1.5F, -2.25F};
  flow.at<cv::Vec2f>(1, 3) = {-300, 200.125F};
  flow.at<cv::Vec2f>(2, 2) = {std::numeric_limits<float>::quiet_NaN(), 0};
  return flow;
}

TEST(FlowFile, BothFormsKeepWhatTheyAreGiven) {
  const test::TemporaryFolder folder;
  for (const char* name : {"f.flo", "f.png"}) {
    write_flow(folder / name, example());
    const Image back = read_flow(folder / name);
    ASSERT_EQ(back.size(), cv::Size(4, 3));
    EXPECT_EQ(back.at<cv::Vec2f>(0, 0), cv::Vec2f(1.5F, -2.25F)) << name;
    EXPECT_EQ(back.at<cv::Vec2f>(1, 3), cv::Vec2f(-300, 200.125F)) << name;
    EXPECT_TRUE(std::isnan(back.at<cv::Vec2f>(2, 2)[0])) << name;
    EXPECT_EQ(back.at<cv::Vec2f>(2, 3), cv::Vec2f(0, 0)) << name;
  }
}

TEST(FlowFile, BrokenFilesAreNamedWithWhatIsWrong) {
  const test::TemporaryFolder folder;
  write_flow(folder / "f.flo", example());
  std::filesystem::resize_file(folder / "f.flo", 50);
  std::ofstream(folder / "g.flo") << "no flow at all";
  std::ofstream(folder / "h.png") << "no picture";
  const auto message = [&](const char* name) {
    return test::message_of([&] { (void)read_flow(folder / name); });
  };
  EXPECT_THAT(message("f.flo"), HasSubstr("f.flo: 50 bytes, but flow of 4x3 pixels has 108"));
  EXPECT_THAT(message("g.flo"), HasSubstr("g.flo: is not Middlebury flow"));
  EXPECT_THAT(message("h.png"), HasSubstr("h.png"));
  EXPECT_THAT(message("none.flo"), HasSubstr("none.flo: flow is missing"));
  const std::int32_t side = 20000;  // of 3.2 GB, all of which are holes
  std::ofstream large(folder / "large.flo", std::ios::binary);
  large << "PIEH";
  for (int k = 0; k < 2; ++k) large.write(reinterpret_cast<const char*>(&side), sizeof side);
  large.close();
  std::filesystem::resize_file(folder / "large.flo", 12 + std::uintmax_t{8} * side * side);
  EXPECT_THAT(message("large.flo"), HasSubstr("large.flo: flow of 20000x20000 pixels"));
  EXPECT_THROW(write_flow(folder / "f.txt", example()), ArgumentError);
  EXPECT_THROW(write_flow(folder / "f.flo", Image(3, 3, CV_8UC1)), ArgumentError);
}

}  // namespace flow_file_test
}  // namespace placegraph
