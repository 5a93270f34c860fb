// `placegraph flow`.
#include <opencv2/imgcodecs.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/texture.h"

namespace placegraph {
namespace {

using test::CommandResult;
using test::read_file;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class FlowCli : public test::CliTest {
 protected:
  void SetUp() override {
    const test::Texture texture{.seed = 2, .wavelength = 24, .octaves = 3, .contrast = 45};
    cv::imwrite(dir / "a.png", test::texture_image(120, 100, texture));
    cv::imwrite(dir / "b.png", test::texture_image(120, 100, texture, -2, 1));  // flow (2, -1)
    cv::imwrite(dir / "small.png", test::texture_image(60, 50, texture));
    cv::Mat truth(100, 120, CV_16UC3, cv::Scalar(1, 32768 - 64, 32768 + 128));
    cv::imwrite(dir / "truth.png", truth);
  }
};

TEST_F(FlowCli, WritesBothFormsAPictureAndItsErrors) {
  for (const char* method : {"interpolation", "lucas-kanade", "horn-schunck", "dis"}) {
    const CommandResult result =
        run(std::string("flow a.png b.png -o f.flo --draw f.png --truth truth.png --json --force "
                        "--method ") +
            method);
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("\"coverage\""));
    EXPECT_THAT(read_file(dir / "f.png"), StartsWith("\x89PNG"));
    EXPECT_EQ(read_file(dir / "f.flo").size(), 12u + 8 * 120 * 100);
  }
  ASSERT_EQ(run("flow a.png b.png -o k.png").code, 0);
  const CommandResult same = run("flow a.png b.png --method dis --truth k.png");
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("end-point error 0.00"));
}

TEST_F(FlowCli, RefusesWithOneLineAndWritesNothing) {
  dir.write("broken.png", "no picture");
  expect_usage_error("flow a.png none.png", "none.png");
  expect_usage_error("flow a.png broken.png -o f.flo", "broken.png");
  expect_usage_error("flow a.png small.png -o f.flo", "small.png");
  expect_usage_error("flow a.png b.png --method guess", "--method");
  expect_usage_error("flow a.png b.png -o f.txt", "f.txt");
  expect_usage_error("flow a.png b.png --set lucas_kanade.window=3", "lucas_kanade.window");
  expect_usage_error("flow a.png b.png --truth a.png", "a.png: flow must have three channels");
  EXPECT_FALSE(std::filesystem::exists(dir / "f.flo"));
  dir.write("f.flo", "mine");
  expect_usage_error("flow a.png b.png -o f.flo", "f.flo");
  EXPECT_EQ(read_file(dir / "f.flo"), "mine");
}

TEST_F(FlowCli, HasNoAnswerOfBlankImages) {
  cv::imwrite(dir / "blank.png", cv::Mat(100, 120, CV_8UC1, cv::Scalar(90)));
  expect_failure("flow blank.png blank.png --method lucas-kanade", 1, "no displacement");
}

}  // namespace
}  // namespace placegraph
