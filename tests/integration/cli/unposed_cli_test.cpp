// Runs that pose no frame say why.
#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph {
namespace {

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

TEST_F(Unposed, OneEyeSaysWhatItLacks) {
  write_blank("");
  expect_reason("0 points to track, ");
  EXPECT_THAT(run("run s --cues lines --out out --force").err, HasSubstr("0 lines to follow, "));
}

TEST_F(Unposed, TwoEyesSayWhatTheyLack) {
  write_blank("baseline_m: 0.1\n", true);
  expect_reason("0 of 0 tracked points found in the right eye's image");
}

TEST_F(Unposed, DepthSaysWhatItLacks) {
  write_blank("depth:\n  unit_m: 0.001\n", false, true);
  expect_reason("0 of 0 tracked points with a measured depth");
}

}  // namespace
}  // namespace placegraph
