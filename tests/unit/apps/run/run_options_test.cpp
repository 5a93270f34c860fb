#include "apps/run/run_options.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/map/map_database.h>

#include "tests/support/message_of.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace run_options_test {

using test::message_of;
using testing::HasSubstr;

TEST(RunOptionsOfArguments, OverrideTheFileBySettingsAndSettingsByFlags) {
  const test::TemporaryFolder folder;
  RunArguments arguments;
  EXPECT_EQ(run_options(arguments).slam.seed, RunOptions().slam.seed);
  arguments.config = folder.write("my.yaml", "seed: 3\nthreads: 5\nmax_frames: 7\n");
  EXPECT_EQ(run_options(arguments).slam.seed, 3u);
  arguments.settings = {"seed=4", "threads=6"};
  EXPECT_EQ(run_options(arguments).slam.seed, 4u);
  arguments.seed = 5;
  const RunOptions options = run_options(arguments);
  EXPECT_EQ(options.slam.seed, 5u);
  EXPECT_EQ(options.threads, 6);
  EXPECT_EQ(options.max_frames, 7);
}

TEST(RunOptionsOfArguments, StandWhereNothingIsSaidOfThem) {
  RunOptions begun;
  begun.slam.seed = 42;
  begun.slam.loops.enabled = true;
  RunArguments arguments;
  EXPECT_EQ(run_options(arguments, begun).slam.seed, 42u);
  arguments.no_loops = true;
  EXPECT_FALSE(run_options(arguments, begun).slam.loops.enabled);
}

TEST(RunOptionsOfArguments, TakeTheFlagsThatHaveNoOptionOfTheirName) {
  RunArguments arguments;
  arguments.cues = "points";
  arguments.camera_height_m = 1.65;
  arguments.odometry = "wheels.txt";
  arguments.mask = "bonnet.png";
  const RunOptions options = run_options(arguments);
  EXPECT_EQ(options.slam.odometry.cues, "points");
  EXPECT_EQ(options.camera_height_m, 1.65);
  EXPECT_EQ(options.motion.file, "wheels.txt");
  EXPECT_EQ(options.mask, "bonnet.png");
}

TEST(RunOptionsOfArguments, KnowWhatIsMappedOfTheScene) {
  RunArguments arguments;
  arguments.scene = "geometry,semantics";
  RunOptions options = run_options(arguments);
  EXPECT_TRUE(options.scene.geometry && options.scene.semantics);
  arguments.scene = "semantics";
  options = run_options(arguments);
  EXPECT_FALSE(options.scene.geometry);
  EXPECT_TRUE(options.scene.semantics);
  RunOptions begun;
  begun.scene.geometry = begun.scene.semantics = true;
  arguments.scene = "none";
  options = run_options(arguments, begun);
  EXPECT_FALSE(options.scene.geometry || options.scene.semantics);
}

TEST(RunOptionsOfArguments, RefuseValuesThatMeanNothing) {
  const auto message = [](const RunArguments& arguments) {
    return message_of<ArgumentError>([&] { run_options(arguments); });
  };
  RunArguments arguments;
  arguments.scene = "none,geometry";
  EXPECT_THAT(message(arguments), HasSubstr("--scene: 'none' is none of geometry, semantics"));
  arguments = {};
  arguments.camera_height_m = 0;
  EXPECT_THAT(message(arguments), HasSubstr("--camera-height: must be positive"));
  arguments = {};
  arguments.seed = -1;
  EXPECT_THAT(message(arguments), HasSubstr("--seed: must not be negative"));
  arguments = {};
  arguments.settings = {"no.such.option=1"};
  EXPECT_THAT(message(arguments), HasSubstr("no.such.option"));
}

TEST(PrepareRun, RefusesAFolderThatIsInUse) {
  const test::TemporaryFolder folder;
  folder.write("out/mine.txt", "mine");
  RunArguments arguments;
  EXPECT_THAT(message_of<ArgumentError>([&] { prepare_run(arguments); }),
              HasSubstr("SEQUENCE and --out are needed, or --resume"));
  arguments.sequence = "somewhere";
  arguments.out = folder / "out";
  EXPECT_THAT(message_of<ArgumentError>([&] { prepare_run(arguments); }),
              HasSubstr("out: is not empty; --force writes into it"));
  arguments.force = true;
  EXPECT_NO_THROW(prepare_run(arguments));
}

TEST(PrepareRun, SaysThatNothingWasSavedToGoOnWith) {
  const test::TemporaryFolder folder;
  RunArguments arguments;
  arguments.resume = folder.path();
  EXPECT_THAT(message_of([&] { prepare_run(arguments); }),
              HasSubstr("map.db: is not there: nothing was saved"));
  arguments.out = folder / "elsewhere";
  EXPECT_THAT(message_of<ArgumentError>([&] { prepare_run(arguments); }),
              HasSubstr("--out: a resumed run writes into its own folder"));
}

TEST(RunOptionsOfASavedMap, OfVersion010AreRead) {
  const test::TemporaryFolder folder;
  for (const std::string name : {"rgbd", "stereo", "mono"}) {
    const std::string packed =
        test::source_dir() + "/tests/integration/cli/made_by_0.1.0/" + name + ".db.gz";
    const std::string path = folder / (name + ".db");
    ASSERT_EQ(std::system(("gzip -dc '" + packed + "' > '" + path + "'").c_str()), 0);
    RunOptions options;
    std::vector<std::string> notes;
    read_options_text(path, read_map_origin(path).options, options,
                      [&](LogLevel, const std::string& note) { notes.push_back(note); });
    EXPECT_EQ(options.slam.odometry.lines.similar_observations, 17) << name;
    EXPECT_FALSE(notes.empty()) << name;
    EXPECT_EQ(options.slam.max_lost_frames, 12) << name;
  }
}

}  // namespace run_options_test
}  // namespace placegraph::apps
