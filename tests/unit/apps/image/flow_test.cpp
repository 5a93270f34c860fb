#include "apps/image/flow.h"

#include <placegraph/io/measurements/flow_file.h>

#include <cmath>
#include <filesystem>

#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/scenes/texture.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph::apps {
namespace flow_test {

using test::message_of;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class FlowCommand : public testing::Test {
 protected:
  /// Two pictures of which the second is the first moved by (2, -1) px.
  void write_shifted() {
    const test::Texture texture{.seed = 2, .wavelength = 24, .octaves = 3, .contrast = 45};
    arguments.from = test::write_image(folder, "a.png", test::texture_image(120, 100, texture));
    arguments.to =
        test::write_image(folder, "b.png", test::texture_image(120, 100, texture, -2, 1));
  }
  /// A camera that comes 0.1 m nearer to a wall at 2 m within 0.1 s, and turns by 0.02 rad.
  void write_approach() {
    const Camera camera{
        .width = 320, .height = 240, .fx = 200, .fy = 200, .cx = 159.5, .cy = 119.5};
    const test::TexturedPlane wall{SE3(SO3(), Eigen::Vector3d(0, 0, 2)),
                                   1e3,
                                   1e3,
                                   {.seed = 4, .wavelength = 0.3, .octaves = 3, .contrast = 45}};
    const SE3 T_1_2(SO3::exp({0, 0.02, 0}), Eigen::Vector3d(0, 0, 0.1));
    arguments.from = test::write_image(folder, "a.png", test::render(camera, {}, {wall}).grey);
    arguments.to = test::write_image(folder, "b.png", test::render(camera, T_1_2, {wall}).grey);
    arguments.calib = folder.write("K.txt", "200 200 159.5 119.5 320 240\n");
    arguments.cues = true;
  }
  test::TemporaryFolder folder;
  FlowArguments arguments;
};

TEST_F(FlowCommand, FindsTheShiftOfAPictureAndComparesItWithTheTruth) {
  write_shifted();
  Image truth(100, 120, CV_32FC2, cv::Scalar(2, -1));
  truth.rowRange(0, 50) = cv::Scalar(NAN, NAN);  // half of it is not known
  write_flow(folder / "truth.flo", truth);
  arguments.truth = folder / "truth.flo";
  arguments.out = folder / "f.flo";
  const FlowResult result = flow(arguments);
  ASSERT_TRUE(result.error);
  EXPECT_LT(result.error->median_px, 0.1);
  EXPECT_LE(result.error->pixels, 120 * 50);
  EXPECT_GT(result.error->pixels, 110 * 45);  // but for what leaves the picture
  const Image found = read_flow(arguments.out);
  EXPECT_NEAR(found.at<cv::Vec2f>(50, 60)[0], 2, 0.1);
  EXPECT_NEAR(found.at<cv::Vec2f>(50, 60)[1], -1, 0.1);
  std::int64_t known = 0;
  for (int v = 0; v < found.rows; ++v)
    for (int u = 0; u < found.cols; ++u) known += std::isfinite(found.at<cv::Vec2f>(v, u)[0]);
  EXPECT_EQ(result.known, known);
  EXPECT_LT(result.known, 120 * 100);  // what leaves the picture is not known
  EXPECT_TRUE(result.cues.is_null());
}

TEST_F(FlowCommand, ComputesTheTimeToContactWithoutTheRotation) {
  write_approach();
  arguments.dt_s = 0.1;
  arguments.gyro = {0, 0.2, 0};
  const FlowResult result = flow(arguments);
  EXPECT_FALSE(result.no_result);
  // 1.9 m are left at 1 m/s; the flow is known to some per cent.
  EXPECT_NEAR(result.cues["time_to_contact"]["time"].get<double>(), 1.9, 0.1);
  const auto& speed = result.cues["ventral"]["speed_over_distance"];
  EXPECT_NEAR(speed[2].get<double>(), 0.5, 0.025);
  EXPECT_NEAR(speed[0].get<double>(), 0, 0.03);
  // The same in images, the turn as a rotation vector.
  arguments.dt_s = 0;
  arguments.gyro.clear();
  arguments.rotation = {0, 0.02, 0};
  EXPECT_NEAR(flow(arguments).cues["time_to_contact"]["time"].get<double>(), 19, 1);
}

TEST_F(FlowCommand, CountsAnUnknownRotationAsMotionToTheSide) {
  write_approach();
  arguments.dt_s = 0.1;
  // 0.02 rad in 0.1 s.
  EXPECT_NEAR(std::abs(flow(arguments).cues["ventral"]["speed_over_distance"][0].get<double>()),
              0.2, 0.05);
}

TEST_F(FlowCommand, SaysWhereTheFlowTellsNoCue) {
  write_approach();
  arguments.cell_px = 512;  // one vector
  const FlowResult result = flow(arguments);
  EXPECT_GT(result.known, 0);
  EXPECT_EQ(result.no_result, "--flow-cues: no cue could be estimated from the flow");
}

TEST_F(FlowCommand, HasNoAnswerOfBlankImagesAndWritesNothing) {
  const Image blank(100, 120, CV_8UC1, cv::Scalar(90));
  arguments.from = arguments.to = test::write_image(folder, "blank.png", blank);
  arguments.method = "lucas-kanade";
  arguments.out = folder / "f.flo";
  EXPECT_EQ(message_of<NoResult>([&] { flow(arguments); }), "no displacement was found");
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(FlowCommand, NamesWhatItCannotUse) {
  write_shifted();
  const std::string good = arguments.to;
  arguments.to = test::write_image(folder, "small.png", test::tiny_grey(60, 50, 1));
  EXPECT_THAT(message_of([&] { flow(arguments); }), StartsWith(arguments.to + ": "));
  arguments.to = folder.write("broken.png", "no picture");
  EXPECT_THAT(message_of([&] { flow(arguments); }), StartsWith(arguments.to + ": "));
  arguments.to = good;
  arguments.method = "guess";
  EXPECT_THROW(flow(arguments), std::exception);
  arguments.method = "dis";
  arguments.cues = true;
  EXPECT_EQ(message_of<ArgumentError>([&] { flow(arguments); }),
            "--flow-cues: need the camera, --calib");
  arguments.calib = folder.write("K.txt", "100 100 60 50 120 100\n");
  arguments.normal = {0, 1};
  EXPECT_EQ(message_of<ArgumentError>([&] { flow(arguments); }),
            "--normal: three numbers are needed");
}

TEST(FlowText, SaysTheErrorOnlyWhereTheTruthIsKnown) {
  FlowResult result;
  result.method = "dis";
  result.known = 120;
  result.cpu_ms = 12.4;
  EXPECT_EQ(to_text(result), "dis: 120 displacements in 12 ms\n");
  EXPECT_EQ(to_json(result),
            "{\n  \"method\": \"dis\",\n  \"known\": 120,\n  \"cpu_ms\": 12.4\n}\n");
  result.error = FlowError{.pixels = 100,
                           .compared = 80,
                           .coverage = 0.8,
                           .mean_px = 0.5,
                           .median_px = 0.25,
                           .share_beyond_3px = 0.125};
  EXPECT_THAT(to_text(result),
              EndsWith("; end-point error 0.500 px (median 0.250), 12.5 % beyond 3 px, 80.0 % of "
                       "the truth covered\n"));
  EXPECT_EQ(nlohmann::json::parse(to_json(result))["truth_pixels"], 100);
}

}  // namespace flow_test
}  // namespace placegraph::apps
