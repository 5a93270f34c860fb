// `placegraph synth sequence`.
#include "tests/support/cli_test.h"

namespace placegraph {
namespace synth_cli_test {

namespace fs = std::filesystem;
using test::read_file;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class SynthCli : public test::CliTest {
 protected:
  void expect_error(const std::string& arguments, const std::string& message) {
    expect_usage_error("synth sequence " + arguments, message);
    EXPECT_FALSE(fs::exists(dir / "out")) << arguments;
  }
};

TEST_F(SynthCli, HelpBeginsWithAnExample) {
  const auto result = run("synth sequence --help");
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out, StartsWith("Example: placegraph synth sequence town-loop --out"));
}

TEST_F(SynthCli, WritesBothCamerasOutdoorsAndDepthIndoors) {
  const std::string small = " --frames 2 --size 96x48 --threads 1";
  ASSERT_EQ(run("synth sequence town-loop --out town" + small).code, 0);
  EXPECT_TRUE(fs::exists(dir / "town/image_0/000001.png"));
  EXPECT_TRUE(fs::exists(dir / "town/image_1/000001.png"));
  EXPECT_FALSE(fs::exists(dir / "town/depth_0"));
  ASSERT_EQ(run("synth sequence corridor-loop --out hall" + small).code, 0);
  EXPECT_FALSE(fs::exists(dir / "hall/image_1"));
  EXPECT_TRUE(fs::exists(dir / "hall/depth_0/000001.png"));
  EXPECT_TRUE(fs::exists(dir / "hall/floorplan.json"));
}

TEST_F(SynthCli, OneAndTwoThreadsWriteTheSameBytes) {
  const std::string what =
      "synth sequence town-loop --frames 3 --size 96x48 --depth --labels --flow";
  ASSERT_EQ(run(what + " --threads 1 --out one").code, 0);
  ASSERT_EQ(run(what + " --threads 2 --out two").code, 0);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(dir / "one")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const std::string name = fs::relative(entry.path(), dir / "one").string();
    EXPECT_EQ(read_file(entry.path().string()), read_file(dir / ("two/" + name))) << name;
  }
  // Flow has one less; calib, depth calib, times, poses, planes, scene.ply, CLASSES.txt, ...
  EXPECT_EQ(files, 5 * 3 + 2 + 9);
}

TEST_F(SynthCli, TrueSurfacesAreWrittenIndoorsToo) {
  ASSERT_EQ(run("synth sequence corridor-loop --frames 1 --size 64x48 --labels --out walk").code,
            0);
  EXPECT_TRUE(fs::exists(dir / "walk/scene.ply"));
  EXPECT_FALSE(fs::exists(dir / "walk/CLASSES.txt"));
}

TEST_F(SynthCli, DefectsOfASetAreOverriddenOneByOne) {
  const std::string small = " --frames 2 --size 96x48 --threads 1";
  ASSERT_EQ(run("synth sequence turning-walk --out exact" + small).code, 0);
  ASSERT_EQ(
      run("synth sequence turning-walk --depth-lag-s 0 --defects hard-rgbd --out hard" + small)
          .code,
      0);
  const std::string world = read_file(dir / "hard/world.yaml");
  EXPECT_THAT(world, HasSubstr("defects:\n  calibration_error: 0.005\n  shutter_s: 0.015\n"));
  EXPECT_THAT(world, Not(HasSubstr("depth_lag_s")));
  EXPECT_THAT(read_file(dir / "exact/world.yaml"), Not(HasSubstr("defects")));
  EXPECT_NE(read_file(dir / "hard/calib.txt"), read_file(dir / "exact/calib.txt"));
  EXPECT_NE(read_file(dir / "hard/calib_depth.txt"), read_file(dir / "exact/calib_depth.txt"));
  EXPECT_EQ(read_file(dir / "hard/poses.txt"), read_file(dir / "exact/poses.txt"));
  EXPECT_EQ(read_file(dir / "hard/times.txt"), read_file(dir / "exact/times.txt"));
}

TEST_F(SynthCli, BadArgumentsGiveOneLineAndExitCode2) {
  test::write_file(dir / "broken.txt", "1 0 0 0 0 1 0 0 0 0 1\n");
  expect_error("town-loop", "--out");
  expect_error("atlantis --out out", "neither a pose file nor one of town-loop");
  expect_error("missing.txt --out out", "missing.txt");
  expect_error("broken.txt --out out", "broken.txt");
  expect_error("town-loop --out out --frames -3", "frames");
  expect_error("town-loop --out out --difficulty easy", "'easy' is none of clean, standard, hard");
  expect_error("town-loop --out out --size 96", "1241x376");
  expect_error("town-loop --out out --size 0x0", "1241x376");
  expect_error("town-loop --out out --threads -1", "--threads");
  expect_error("town-loop --out out --defects soft", "'soft' is none of none, hard-drive");
  expect_error("town-loop --out out --depth-holes 2", "--depth-holes");
  expect_error("town-loop --out out --time-jitter-s nan", "--time-jitter-s: is not a number");
  expect_error("warehouse --out out --undulation-m 0.02", "undulation_m: only for `town-loop`");
}

TEST_F(SynthCli, DoesNotWriteIntoAFolderThatHoldsSomething) {
  fs::create_directory(dir / "full");
  test::write_file(dir / "full/notes.txt", "mine");
  const std::string command = "synth sequence town-loop --frames 1 --size 96x48 --out full";
  EXPECT_EQ(run(command).code, 2);
  EXPECT_FALSE(fs::exists(dir / "full/image_0"));
  EXPECT_EQ(run(command + " --force").code, 0);
  EXPECT_TRUE(fs::exists(dir / "full/image_0/000000.png"));
  EXPECT_EQ(read_file(dir / "full/notes.txt"), "mine");
}

}  // namespace synth_cli_test
}  // namespace placegraph
