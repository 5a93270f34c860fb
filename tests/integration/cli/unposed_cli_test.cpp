// Runs that pose no frame say why.
#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph {
namespace unposed_cli_test {

using nlohmann::json;
using testing::HasSubstr;

class Unposed : public test::CliTest {
 protected:
  /// Six images of one grey level, with what the calibration names beside them.
  void write_blank(const std::string& more, bool right = false, bool depth = false) {
    const Image blank(48, 64, CV_8UC1, cv::Scalar(90));
    for (int i = 0; i < 6; ++i) {
      const std::string name = std::to_string(i) + ".png";
      test::write_image(dir, "s/" + name, blank);
      if (right) test::write_image(dir, "s/right/" + name, blank);
      if (depth) test::write_image(dir, "s/depth/" + name, test::tiny_depth(64, 48, 900));
    }
    dir.write("s/calibration.yaml",
              "width: 64\nheight: 48\nfx: 60\nfy: 60\ncx: 31.5\ncy: 23.5\n" + more);
  }
  void expect_reason(const std::string& reason) {
    const test::CommandResult result = run("run s --out out --force --json");
    EXPECT_EQ(result.code, 1);
    EXPECT_THAT(result.err, HasSubstr("s: no frame could be posed: "));
    EXPECT_THAT(result.err, HasSubstr(reason));
    const json unposed = json::parse(result.out)["unposed"];
    ASSERT_FALSE(unposed.empty());
    EXPECT_EQ(unposed[0]["frames"], 6);
    EXPECT_THAT(unposed[0]["reason"].get<std::string>(), HasSubstr(reason));
  }
};

TEST_F(Unposed, MonocularSaysWhatItLacks) {
  write_blank("");
  expect_reason("0 points to track, ");
  EXPECT_THAT(run("run s --cues lines --out out --force").err, HasSubstr("0 lines to follow, "));
}

TEST_F(Unposed, ViewsWithNothingInCommonAreSaidToBe) {
  dir.write("s/calibration.yaml",
            "width: 160\nheight: 120\nfx: 130\nfy: 130\ncx: 79.5\ncy: 59.5\n");
  constexpr int kFrames = 6;
  for (int i = 0; i < kFrames; ++i) {
    cv::RNG random(static_cast<std::uint64_t>(i) + 1);
    Image noise(120, 160, CV_8UC1);
    random.fill(noise, cv::RNG::UNIFORM, 0, 255);
    test::write_image(dir, "s/" + std::to_string(i) + ".png", noise);
  }
  const test::CommandResult result = run("run s --out out --json");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("no frame could be posed: "));
  EXPECT_THAT(result.err, HasSubstr(" needed to "));
  const json summary = json::parse(result.out);
  int unposed_frames = 0;
  for (const json& frames : summary["unposed"]) unposed_frames += frames["frames"].get<int>();
  EXPECT_EQ(unposed_frames, kFrames);
}

TEST_F(Unposed, OneFrameWaitsForASecond) {
  test::write_image(dir, "s/0.png", test::tiny_grey(320, 240, 1));
  dir.write("s/calibration.yaml",
            "width: 320\nheight: 240\nfx: 260\nfy: 260\ncx: 159.5\ncy: 119.5\n");
  const test::CommandResult result = run("run s --out out");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("no frame could be posed: "));
  EXPECT_THAT(result.err, HasSubstr(" (1 of 1 frame)"));
}

TEST_F(Unposed, StereoSaysWhatItLacks) {
  write_blank("baseline_m: 0.1\n", true);
  expect_reason("0 of 0 tracked points found in the right image");
}

TEST_F(Unposed, DepthSaysWhatItLacks) {
  write_blank("depth:\n  unit_m: 0.001\n", false, true);
  expect_reason("0 of 0 tracked points with a measured depth");
}

}  // namespace unposed_cli_test
}  // namespace placegraph
