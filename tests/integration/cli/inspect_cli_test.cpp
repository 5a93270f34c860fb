#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/unit/io/datasets/tiny_images.h"

namespace placegraph {
namespace inspect_cli_test {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kCalibration = "width: 8\nheight: 6\nfx: 10\nfy: 11\ncx: 4\ncy: 3\n";

class Inspect : public test::CliTest {
 protected:
  /// Five images at 10 Hz in s/, the third of them missing, with a calibration.
  void write_sequence(const std::string& calibration = kCalibration) {
    for (int i = 0; i < 4; ++i)
      test::write_image(dir, "s/" + std::to_string(i) + ".png", test::tiny_grey(8, 6, i));
    dir.write("s/calibration.yaml", calibration);
    dir.write("s/times.txt", "0\n0.1\n0.3\n0.4\n");
  }
};

TEST_F(Inspect, SaysWhatAFolderIsTakenForAndWhatRunWouldUse) {
  write_sequence();
  const test::CommandResult result = run("inspect s");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("s, read as images from s"));
  EXPECT_THAT(result.out, HasSubstr("4 in 0.40 s, 10 Hz"));
  EXPECT_THAT(result.out, HasSubstr("1, where about 1 frames are missing; the longest is 0.2 s "
                                    "after frame 1"));
  EXPECT_THAT(result.out, HasSubstr("8 x 6 px, fx 10.00 fy 11.00 cx 4.00 cy 3.00"));
  EXPECT_THAT(result.out, HasSubstr("as mono, cues points,plane; lengths without scale"));
}

TEST_F(Inspect, GivesTheSameAsJson) {
  write_sequence(kCalibration + "camera_height_m: 165\n");
  const test::CommandResult result = run("inspect s --json --read");
  ASSERT_EQ(result.code, 0) << result.err;
  const json found = json::parse(result.out);
  EXPECT_EQ(found["format"], "images");
  EXPECT_EQ(found["frames"], 4);
  EXPECT_EQ(found["unreadable"], 0);
  EXPECT_EQ(found["times"]["gaps"][0]["after_frame"], 1);
  EXPECT_EQ(found["calibration"]["camera_height_m"], 165);
  EXPECT_TRUE(found["ground_truth"].is_null());
  // A height in centimetres is doubted, and so are metres by it.
  EXPECT_FALSE(found["run"]["metric"].get<bool>());
  EXPECT_THAT(found["run"]["metric_by"].get<std::string>(), HasSubstr("165 m"));
  EXPECT_TRUE(std::ranges::any_of(found["notes"],
                                  [](const json& note) { return note["doubts_scale"] == true; }));
}

TEST_F(Inspect, CountsTheFramesThatCannotBeRead) {
  write_sequence();
  dir.write("s/2.png", "no image");
  EXPECT_EQ(run("inspect s").code, 0);
  const test::CommandResult result = run("inspect s --read");
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.out, HasSubstr("3 of 4 frames can be read"));
  EXPECT_THAT(result.err, HasSubstr("2.png"));
  EXPECT_THAT(result.err, HasSubstr("1 of 4 frames cannot be read"));
}

TEST_F(Inspect, NamesFoldersThatAreNoSequence) {
  dir.write("empty/readme.txt", "");
  expect_usage_error("inspect empty", "no sequence is recognized here");
  expect_usage_error("inspect none", "none: no such file or folder");
  test::write_image(dir, "places/images/1.png", test::tiny_grey(8, 6, 1));
  const test::CommandResult result = run("inspect places");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("1 in places/images: "));
  EXPECT_THAT(result.out, HasSubstr("not possible: places: no sequence is recognized"));
  test::write_image(dir, "bare/1.png", test::tiny_grey(8, 6, 1));
  expect_usage_error("run bare --out out", "calibration.yaml is missing");
}

TEST_F(Inspect, RefusesABrokenSequence) {
  write_sequence("width: 8\nheight: 6\nfx: ten\nfy: 11\ncx: 4\ncy: 3\n");
  expect_usage_error("inspect s", "calibration.yaml:3");
}

}  // namespace inspect_cli_test
}  // namespace placegraph
