#include "apps/synth/synth.h"

#include <placegraph/io/files/image_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace synth_test {

namespace fs = std::filesystem;
using test::message_of;
using testing::HasSubstr;

class SynthCommand : public testing::Test {
 protected:
  SynthCommand() {
    arguments.world.world = "town-loop";
    arguments.world.frames = 2;
    arguments.size = "96x48";
    arguments.threads = 1;
    arguments.out = folder / "out";
  }
  bool wrote(const std::string& name) const { return fs::exists(arguments.out + "/" + name); }
  test::TemporaryFolder folder;
  SynthArguments arguments;
};

TEST_F(SynthCommand, WritesBothCamerasOutdoorsAndSaysHowFarTheCameraCame) {
  arguments.world.frames = 3;
  const SynthResult result = synth(arguments);
  EXPECT_EQ(result.frames, 3u);
  EXPECT_TRUE(result.stereo);
  const Trajectory truth = read_trajectory(arguments.out + "/poses.txt");
  ASSERT_EQ(truth.size(), 3u);
  const auto at = [&](std::size_t i) { return truth.poses[i].T_world_body->translation(); };
  EXPECT_NEAR(result.length_m, (at(1) - at(0)).norm() + (at(2) - at(1)).norm(), 1e-3);
  EXPECT_GT(result.length_m, 0.1);
  EXPECT_TRUE(wrote("image_1/000002.png"));
  EXPECT_FALSE(wrote("depth_0"));
  EXPECT_FALSE(wrote("flow_0"));
  const Image image = read_image(arguments.out + "/image_0/000000.png").grey;
  EXPECT_EQ(image.size(), cv::Size(96, 48));
}

TEST_F(SynthCommand, WritesMonocularAndDepthIndoors) {
  arguments.world.world = "corridor-loop";
  EXPECT_FALSE(synth(arguments).stereo);
  EXPECT_FALSE(wrote("image_1"));
  EXPECT_TRUE(wrote("depth_0/000001.png"));
}

TEST_F(SynthCommand, WritesWhatIsAskedFor) {
  arguments.mono = arguments.depth = arguments.labels = arguments.flow = true;
  EXPECT_FALSE(synth(arguments).stereo);
  EXPECT_FALSE(wrote("image_1"));
  EXPECT_TRUE(wrote("depth_0/000001.png"));
  EXPECT_TRUE(wrote("labels_0/000001.png"));
  EXPECT_TRUE(wrote("planes_0/000001.png"));  // with the labels
  EXPECT_TRUE(wrote("flow_0/000000.png"));
}

TEST_F(SynthCommand, KeepsAFolderThatHoldsSomethingUnlessItIsForced) {
  folder.write("out/notes.txt", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { synth(arguments); }),
              HasSubstr("out: is not empty; --force writes into it"));
  EXPECT_FALSE(wrote("image_0"));
  arguments.force = true;
  synth(arguments);
  EXPECT_TRUE(wrote("image_0/000000.png"));
  EXPECT_EQ(test::read_file(folder / "out/notes.txt"), "mine");
}

TEST_F(SynthCommand, NamesWhatItCannotUseAndWritesNothing) {
  for (const char* size : {"96", "96x", "x48", "0x0", "96x48x2", "wide"}) {
    arguments.size = size;
    EXPECT_EQ(message_of<ArgumentError>([&] { synth(arguments); }),
              "--size: '" + std::string(size) + "' is not of the form 1241x376");
  }
  arguments.size = "96x48";
  arguments.difficulty = "easy";
  EXPECT_THAT(message_of<ArgumentError>([&] { synth(arguments); }),
              HasSubstr("'easy' is none of clean, standard, hard"));
  arguments.difficulty = "clean";
  arguments.world.world = "flight";
  arguments.labels = true;
  EXPECT_EQ(message_of<ArgumentError>([&] { synth(arguments); }),
            "flight: has one camera; --stereo, --depth and --labels are for other worlds");
  arguments.labels = false;
  arguments.world.world = "town-loop";
  arguments.world.defects.depth_holes = 0.1;
  EXPECT_THAT(message_of<ArgumentError>([&] { synth(arguments); }),
              HasSubstr("defects of the depth images: town-loop has none; add --depth"));
  arguments.world.defects = {};
  arguments.world.world = folder.write("broken.txt", "1 0 0 0 0 1 0 0 0 0 1\n");
  EXPECT_THAT(message_of([&] { synth(arguments); }), HasSubstr("broken.txt:1: "));
  EXPECT_FALSE(fs::exists(arguments.out));
}

TEST(SynthText, SaysWhatWasRendered) {
  SynthResult result{.world = "town-loop",
                     .difficulty = "clean",
                     .out = "out/town",
                     .frames = 40,
                     .length_m = 31.6,
                     .stereo = true};
  EXPECT_EQ(to_text(result), "town-loop: 40 frames, 32 m, stereo (clean), written to out/town\n");
  result.stereo = false;
  EXPECT_THAT(to_text(result), HasSubstr("32 m, mono (clean)"));
  result.depth = true;
  EXPECT_THAT(to_text(result), HasSubstr("32 m, rgbd (clean)"));
}

}  // namespace synth_test
}  // namespace placegraph::apps
