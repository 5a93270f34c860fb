// `placegraph image flow`.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes/texture.h"

namespace placegraph {
namespace flow_cli_test {

using test::CommandResult;
using test::read_file;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class FlowCli : public test::CliTest {
 protected:
  void SetUp() override {
    const test::Texture texture{.seed = 2, .wavelength = 24, .octaves = 3, .contrast = 45};
    test::write_picture(dir / "a.png", test::texture_image(120, 100, texture));
    test::write_picture(dir / "b.png",
                        test::texture_image(120, 100, texture, -2, 1));  // flow (2, -1)
    test::write_picture(dir / "small.png", test::texture_image(60, 50, texture));
    cv::Mat truth(100, 120, CV_16UC3, cv::Scalar(1, 32768 - 64, 32768 + 128));
    test::write_picture(dir / "truth.png", truth);
  }
};

TEST_F(FlowCli, WritesBothFormsAPictureAndItsErrors) {
  for (const char* method : {"interpolation", "lucas-kanade", "horn-schunck", "dis"}) {
    const CommandResult result = run(
        std::string("image flow a.png b.png -o f.flo --draw f.png --truth truth.png --json --force "
                    "--method ") +
        method);
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("\"coverage\""));
    EXPECT_THAT(read_file(dir / "f.png"), StartsWith("\x89PNG"));
    EXPECT_EQ(read_file(dir / "f.flo").size(), 12u + 8 * 120 * 100);
  }
  ASSERT_EQ(run("image flow a.png b.png -o k.png").code, 0);
  const CommandResult same = run("image flow a.png b.png --method dis --truth k.png");
  ASSERT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("end-point error 0.00"));
}

TEST_F(FlowCli, RefusesWithOneLineAndWritesNothing) {
  dir.write("broken.png", "no picture");
  expect_usage_error("image flow a.png none.png", "none.png");
  expect_usage_error("image flow a.png broken.png -o f.flo", "broken.png");
  expect_usage_error("image flow a.png small.png -o f.flo", "small.png");
  expect_usage_error("image flow a.png b.png --method guess", "--method");
  expect_usage_error("image flow a.png b.png -o f.txt", "f.txt");
  expect_usage_error("image flow a.png b.png --set lucas_kanade.window=3", "lucas_kanade.window");
  expect_usage_error("image flow a.png b.png --truth a.png",
                     "a.png: flow must have three channels");
  EXPECT_FALSE(std::filesystem::exists(dir / "f.flo"));
  dir.write("f.flo", "mine");
  expect_usage_error("image flow a.png b.png -o f.flo", "f.flo");
  EXPECT_EQ(read_file(dir / "f.flo"), "mine");
}

TEST_F(FlowCli, TellsWhatFlowTellsAtOnce) {
  // Straight towards a plane at 2 m by 0.1 m in 0.1 s: contact in 1.9 s; the camera turns by 0.002.
  const Camera camera{.width = 320, .height = 240, .fx = 200, .fy = 200, .cx = 159.5, .cy = 119.5};
  const test::TexturedPlane wall{SE3(SO3(), Eigen::Vector3d(0, 0, 2)),
                                 1e3,
                                 1e3,
                                 {.seed = 4, .wavelength = 0.3, .octaves = 3, .contrast = 45}};
  const SE3 T_1_2(SO3::exp({0, 0.002, 0}), Eigen::Vector3d(0, 0, 0.1));
  test::write_picture(dir / "far.png", test::render(camera, {}, {wall}).grey);
  test::write_picture(dir / "near.png", test::render(camera, T_1_2, {wall}).grey);
  dir.write("K.txt", "200 200 159.5 119.5 320 240\n");
  const std::string command = "image flow far.png near.png --flow-cues --calib K.txt ";
  for (const char* method : {"interpolation", "lucas-kanade", "horn-schunck", "dis"}) {
    const CommandResult result =
        run(command + "--json --dt 0.1 --gyro 0 0.02 0 --rotation-sigma 1e-4 --method " + method);
    ASSERT_EQ(result.code, 0) << result.err;
    const auto cues = nlohmann::json::parse(result.out)["cues"];
    EXPECT_NEAR(cues["time_to_contact"]["time"].get<double>(), 1.9, 0.05 * 1.9) << method;
    // From thousands of pixels the time is known to a few percent, and not exactly.
    const double deviation = std::sqrt(cues["time_to_contact"]["variance"].get<double>());
    EXPECT_LT(deviation, 0.05 * 1.9) << method;
    EXPECT_GT(deviation, 1e-5 * 1.9) << method;
    // Twice what a point at the axis grows by in the image.
    EXPECT_NEAR(cues["affine"]["divergence"].get<double>(), 2 * 0.1 / 1.9, 0.006) << method;
    EXPECT_NEAR(cues["ventral"]["speed_over_distance"][2].get<double>(), 0.5, 0.025) << method;
    EXPECT_NEAR(cues["ventral"]["speed_over_distance"][0].get<double>(), 0, 0.02) << method;
    EXPECT_NEAR(cues["balance"]["balance"].get<double>(), 0, 0.05) << method;
  }
  const CommandResult lines = run(command + "--rotation 0,0.002,0");
  EXPECT_THAT(lines.out, HasSubstr("time to contact: 19."));  // in images
  EXPECT_THAT(run(command + "--normal 0 0 -1").out, HasSubstr("time to contact: none: "));
  expect_usage_error("image flow far.png near.png --flow-cues", "--calib");
  expect_usage_error(command + "--gyro 0 0 0", "--dt");
  expect_usage_error("image flow a.png b.png --flow-cues --calib K.txt", "a.png");
}

TEST_F(FlowCli, HasNoAnswerOfBlankImages) {
  test::write_picture(dir / "blank.png", cv::Mat(100, 120, CV_8UC1, cv::Scalar(90)));
  expect_failure("image flow blank.png blank.png --method lucas-kanade", 1, "no displacement");
}

TEST_F(FlowCli, RefusesWhatIsNoPicture) {
  test::write_picture(dir / "line.png", cv::Mat(1, 400, CV_8UC1, cv::Scalar(90)));
  expect_usage_error("image flow line.png line.png", "line.png: image is 400x1");
}

}  // namespace flow_cli_test
}  // namespace placegraph
