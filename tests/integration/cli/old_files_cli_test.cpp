// Files and spellings of version 0.1.0: maps, YAML keys, commands, flags.
#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/paths.h"

namespace placegraph {
namespace old_files_cli_test {

using test::CommandResult;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class OldFiles : public test::CliTest {
 protected:
  /// Path of a file of version 0.1.0, quoted for the shell.
  static std::string of_0_1_0(const std::string& name) {
    return "'" + test::source_dir() + "/tests/integration/cli/made_by_0.1.0/" + name + "'";
  }
  /// Unpacks a map of version 0.1.0 as DIR/NAME/map.db.
  void unpack(const std::string& name) {
    std::filesystem::create_directory(dir / name);
    const std::string command =
        "gzip -dc " + of_0_1_0(name + ".db.gz") + " > '" + (dir / (name + "/map.db")) + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
};

TEST_F(OldFiles, MapsOpen) {
  for (const std::string name : {"rgbd", "stereo", "mono"}) {
    SCOPED_TRACE(name);
    unpack(name);
    const CommandResult info = run("map info " + name + " --json");
    ASSERT_EQ(info.code, 0) << info.err;
    const auto json = nlohmann::json::parse(info.out);
    EXPECT_EQ(json["sensor"], name);
    EXPECT_GE(json["keyframes"].get<int>(), 2);
    EXPECT_EQ(run("map validate " + name).code, 0);
    EXPECT_EQ(run("map explain " + name + " 5").code, 0);
    EXPECT_EQ(run("map export " + name + " --tum " + name + ".tum").code, 0);
  }
}

TEST_F(OldFiles, AllKeysOfOptionsAreUnderstood) {
  const CommandResult defaults = run("config --all");
  const CommandResult read = run("config --all --config " + of_0_1_0("run_all.yaml"));
  ASSERT_EQ(read.code, 0) << read.err;
  EXPECT_EQ(read.out, defaults.out);
  EXPECT_THAT(read.err, HasSubstr("'odometry.surfaces' is an old spelling of 'odometry.direct'"));

  const CommandResult flight =
      run("config --all --of flight --config " + of_0_1_0("flight_all.yaml"));
  ASSERT_EQ(flight.code, 0) << flight.err;
  EXPECT_EQ(flight.out, run("config --all --of flight").out);
}

TEST_F(OldFiles, OldKeysSetTheOptionsOfTheNewOnes) {
  const CommandResult read = run("config --all --list --config " + of_0_1_0("old_keys.yaml"));
  ASSERT_EQ(read.code, 0) << read.err;
  for (const char* line :
       {"scene.indoor.min_rotation_deg +7 ", "scene.urban.labelling.step_px +5 ",
        "odometry.pure_rotation.min_inlier_share +0.8 ", "odometry.lines.similar_observations +17 ",
        "odometry.lines.initialization.min_lines +13 ", "odometry.manhattan.frames.max_count +3 ",
        "odometry.direct.max_planes +4 "})
    EXPECT_THAT(read.out, ::testing::ContainsRegex(line));
  EXPECT_THAT(read.err, HasSubstr("old_keys.yaml:4: 'scene.indoor.min_turn_deg' is an old spelling "
                                  "of 'scene.indoor.min_rotation_deg'\n"));
  EXPECT_EQ(std::count(read.err.begin(), read.err.end(), '\n'), 8) << read.err;
  const CommandResult set = run("config --list --all --set odometry.surfaces.max_planes=4");
  EXPECT_EQ(set.code, 0) << set.err;
  EXPECT_THAT(set.out, ::testing::ContainsRegex("odometry.direct.max_planes +4 "));
  EXPECT_EQ(set.err,
            "--set 'odometry.surfaces.max_planes' is an old spelling of "
            "'odometry.direct.max_planes'\n");
}

TEST_F(OldFiles, OldCommandsWorkAndNameTheNewOnes) {
  const std::pair<const char*, const char*> spellings[] = {{"hover", "flight run"},
                                                           {"eval-edges", "eval edges"},
                                                           {"lines detect", "image lines"},
                                                           {"map semantic", "map street"},
                                                           {"synth-graph", "synth graph"},
                                                           {"scene label", "image labels"},
                                                           {"vocabulary train", "train vocabulary"},
                                                           {"track-plane", "track plane"}};
  for (const auto& [old, present] : spellings) {
    SCOPED_TRACE(old);
    const CommandResult help = run(std::string(old) + " --help");
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.out, StartsWith("Example: placegraph " + std::string(present)));
    EXPECT_EQ(help.err, "'" + std::string(old) + "' is an old spelling of '" + present + "'\n");
  }
  ASSERT_EQ(run("synth-graph manhattan-walk --poses 30 -o walk.g2o").code, 0);
  const CommandResult optimized = run("optimize walk.g2o -o o.g2o --start file --quiet");
  EXPECT_EQ(optimized.code, 0);
  EXPECT_THAT(optimized.err, StartsWith("'--start' is an old spelling of '--initialization'\n"));
}

TEST_F(OldFiles, ShortFormsStayWithoutANote) {
  for (const char* command : {"loops", "match", "optimize", "planes", "vanishing"}) {
    const CommandResult help = run(std::string(command) + " --help");
    EXPECT_EQ(help.code, 0) << command;
    EXPECT_THAT(help.err, IsEmpty()) << command;
  }
  EXPECT_THAT(run("eval a b").err, HasSubstr("(see placegraph eval trajectory --help)"));
}

}  // namespace old_files_cli_test
}  // namespace placegraph
