#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/datasets/distinct_paths.h>

#include <filesystem>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace distinct_paths_test {

namespace fs = std::filesystem;

/// A file or a folder, written in one of many ways: with dots, through links of either kind.
std::string other_spelling(Random& random, const test::TemporaryFolder& dir,
                           const std::string& name) {
  switch (random.index(5)) {
    case 0:
      return dir / name;
    case 1:
      return dir / ("./" + name);
    case 2:
      return dir / ("deep/../" + name);
    case 3:
      return dir / ("around/" + name);  // a link to the folder itself
    default:
      return dir / ("link_" + name);
  }
}

bool refused(const std::vector<NamedPath>& outputs, const std::vector<NamedPath>& inputs) {
  try {
    require_distinct_paths(outputs, inputs);
    return false;
  } catch (const ArgumentError&) {
    return true;
  }
}

// Outputs and inputs by random names: two are refused exactly if they are one file.
TEST(DistinctPaths, AreTheSameHoweverTheyAreWritten) {
  const test::TemporaryFolder dir;
  fs::create_directory(dir / "deep");
  fs::create_directory_symlink(dir.path(), dir / "around");
  const std::vector<std::string> names = {"there", "hard", "absent", "deep"};
  dir.write("there", "");
  dir.write("hard", "");
  fs::create_symlink("there", dir / "link_there");
  fs::create_hard_link(dir / "hard", dir / "link_hard");
  fs::create_symlink("absent", dir / "link_absent");  // leads nowhere yet
  fs::create_directory_symlink("deep", dir / "link_deep");
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::string one = names[static_cast<std::size_t>(random.index(4))],
                      other = names[static_cast<std::size_t>(random.index(4))];
    const NamedPath a{"--one", other_spelling(random, dir, one)},
        b{"--other", other_spelling(random, dir, other)};
    SCOPED_TRACE(a.path + " and " + b.path);
    EXPECT_EQ(refused({a, b}, {}), one == other);
    EXPECT_EQ(refused({a}, {b}), one == other && other != "absent");
    EXPECT_FALSE(refused({a}, {}));
    EXPECT_FALSE(refused({}, {a, b}));  // the same file may be read twice
    const bool folder = one == "deep";
    const NamedPath below{"--below", a.path + "/below.txt"};
    EXPECT_TRUE(!folder || (refused({a, below}, {}) && refused({below, a}, {})));
    EXPECT_FALSE(folder && refused({below}, {a}));  // beside what is read of a folder
  }
}

TEST(DistinctPaths, TheMapOfAFolderIsAnInputAndSoIsTheFolderOfAFile) {
  const test::TemporaryFolder dir;
  const std::string map = dir.write("run/map.db", ""), image = dir.write("images/a.png", "");
  const auto message = [](const std::string& output, const std::string& input) {
    return test::message_of<ArgumentError>([&] {
      require_distinct_paths({{"--out", output}}, {{"MAP", input}});
    });
  };
  EXPECT_EQ(message(map, dir / "run"), "--out: " + map + " is an input, that of MAP");
  EXPECT_EQ(message(dir / "images", image),
            "--out: " + (dir / "images") + " is the folder of an input, that of MAP");
  EXPECT_NO_THROW(require_distinct_paths({{"--out", dir / "run/e.png"}}, {{"MAP", dir / "run"}}));
  EXPECT_NO_THROW(require_distinct_paths({{"--csv", "/dev/null"}, {"--plot", "/dev/null"}}, {}));
}

// What a recording or a run consists of is not overwritten, whatever the layout and the depth.
TEST(DistinctPaths, LeaveRecordingsAndTheFilesOfARunThatIsReadAsTheyAre) {
  struct Case {
    std::vector<std::string> files;  // of the recording
    std::string file, folder;        // one of its files, one of its folders
  };
  const Case cases[] = {
      {{"calib.txt", "poses.txt", "image_0/000000.png"}, "poses.txt", "image_0"},
      {{"rgb.txt", "groundtruth.txt", "rgb/1.5.png"}, "groundtruth.txt", "rgb"},
      {{"mav0/cam0/data.csv", "mav0/cam0/data/17.png"}, "mav0/cam0/data/17.png", "mav0/cam0/data"},
      {{"image_00/data/0.png", "image_00/timestamps.txt"}, "image_00/timestamps.txt", "image_00"},
      {{"frame-000000.color.png", "seq/0.png"}, "frame-000000.color.png", "seq"},
      {{"calibration.yaml", "images/0.jpg"}, "calibration.yaml", "images"}};
  for (const Case& each : cases) {
    SCOPED_TRACE(each.file);
    const test::TemporaryFolder dir;
    for (const std::string& file : each.files) dir.write("w/" + file, "");
    const std::vector<NamedPath> input{{"SEQUENCE", dir / "w"}};
    for (const auto& inputs : {input, std::vector<NamedPath>()}) {
      EXPECT_TRUE(refused({{"--out", dir / ("w/" + each.file)}}, inputs));
      EXPECT_TRUE(refused({{"--out", dir / ("w/" + each.folder)}}, inputs));
      EXPECT_FALSE(refused({{"--out", dir / "w/new.csv"}}, inputs));
      dir.write("w/labels.txt", "");
      dir.write("w/plot.png", "");
      EXPECT_FALSE(refused({{"--out", dir / "w/labels.txt"}}, inputs));  // of an earlier command
      EXPECT_FALSE(refused({{"--out", dir / "w/plot.png"}}, inputs));
      EXPECT_FALSE(refused({{"--out", dir / "w/new"}}, inputs));
    }
    // The results of a run may lie in its recording, and are written again.
    dir.write("w/run/result.json", "{}");
    dir.write("w/run/errors.csv", "");
    dir.write("w/run/trajectory_optimized.tum", "");
    EXPECT_FALSE(refused({{"--out", dir / "w/run"}}, input));
    EXPECT_FALSE(refused({{"--out", dir / "w/run/errors.csv"}}, input));
    const std::vector<NamedPath> estimate{{"ESTIMATE", dir / "w/run"}};
    EXPECT_FALSE(refused({{"--out", dir / "w/run/errors.csv"}}, estimate));
    EXPECT_TRUE(refused({{"--out", dir / "w/run/trajectory_optimized.tum"}}, estimate));
    EXPECT_TRUE(refused({{"--out", dir / "w/run/result.json"}}, estimate));
    EXPECT_FALSE(refused({{"--out", dir / "w/run/loops.csv"}}, estimate));  // is not there
    EXPECT_TRUE(refused({{"--out", dir / "w/run/map.db-wal"}}, estimate));
    EXPECT_FALSE(refused({{"--out", dir / "w/run/trajectory_optimized.tum"}}, input));
    EXPECT_FALSE(refused({{"--out", dir / "w"}}, {}));  // a recording as a whole is written again
  }
}

}  // namespace distinct_paths_test
}  // namespace placegraph
