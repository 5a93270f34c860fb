#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/map/map_file.h>

#include <placegraph/pipeline/results/run_map.h>
#include "apps/support/output.h"
#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace map_file_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A map of a few landmarks in the folder of a run.
class MapFile : public ::testing::Test {
 protected:
  MapFile() {
    Random random(2);
    stored = test::random_map(random, 3);
    stored.map.landmarks.clear();
    dir.write("run/notes.txt", "");
  }
  std::string written() const {
    write_map(dir / "run/map.db", stored);
    return dir / "run/map.db";
  }
  test::TemporaryFolder dir;
  StoredMap stored;
};

TEST_F(MapFile, IsMapDbOfAFolderOrTheFileItself) {
  EXPECT_EQ(map_path_of(dir / "run"), dir / "run/map.db");
  EXPECT_EQ(map_path_of(dir / "run/other.db"), dir / "run/other.db");
  const std::string path = written();
  EXPECT_EQ(read_stored_map(dir / "run").map.keyframes.size(), stored.map.keyframes.size());
  EXPECT_EQ(read_stored_map(path).origin.sequence, stored.origin.sequence);
}

TEST_F(MapFile, AnInterruptedRunIsToldOnce) {
  std::vector<std::string> warnings;
  const LogSink log = [&](LogLevel level, const std::string& message) {
    EXPECT_EQ(level, LogLevel::kWarning);
    warnings.push_back(message);
  };
  stored.finished = true;
  (void)read_stored_map(written(), log);
  EXPECT_THAT(warnings, IsEmpty());
  stored.finished = false;
  (void)read_stored_map(written(), log);
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("map.db: "), HasSubstr("--resume"))));
}

TEST_F(MapFile, HasTheOptionsOfItsRun) {
  MapOrigin origin;
  EXPECT_EQ(options_of_run("a.db", origin).slam.places.merge, RunOptions().slam.places.merge);
  origin.options = "places:\n  merge: false\n";
  EXPECT_FALSE(options_of_run("a.db", origin).slam.places.merge);
  origin.options = "places:\n  merge: false\n  no_such_key: 1\n";
  EXPECT_THAT(test::message_of([&] { (void)options_of_run("a.db", origin); }),
              AllOf(HasSubstr("a.db:3: "), HasSubstr("no_such_key")));
}

TEST_F(MapFile, ImagesAreLocalizedByViewsAndTheFeaturesOfTheRun) {
  MapOrigin origin;
  EXPECT_THAT(test::message_of<NoResult>([&] { (void)localizer_options_of("a.db", origin); }),
              HasSubstr("a.db: holds no views"));
  origin.view_options = "{}";
  const LocalizerOptions standard = localizer_options_of("a.db", origin);
  origin.options = "loops:\n  database:\n    first_training: 77\n";
  const LocalizerOptions of_run = localizer_options_of("a.db", origin);
  EXPECT_EQ(of_run.loops.database.first_training, 77);
  EXPECT_EQ(standard.loops.database.first_training,
            LocalizerOptions().loops.database.first_training);
}

TEST_F(MapFile, ItsPlacesHaveTheFramesOfTheirAnchors) {
  const RunMap map = read_run_map(written());
  EXPECT_EQ(map.metric, stored.map.metric);
  EXPECT_STREQ(map.unit(), "m");
  EXPECT_EQ(map.frame_of_keyframe.size(), stored.map.keyframes.size());
  ASSERT_EQ(map.graph.places.size(), 3U);
  for (const Place& place : map.graph.places)
    EXPECT_EQ(map.anchor_frame(place), stored.map.find_keyframe(place.anchor_keyframe)->frame);
  Place stranger;
  stranger.id = PlaceId(9), stranger.anchor_keyframe = KeyframeId(999);
  EXPECT_THAT(test::message_of([&] { (void)map.anchor_frame(stranger); }),
              HasSubstr("map.db: place 9 has no frame of its anchor"));
}

TEST_F(MapFile, WithoutACameraItHasNoPlacesWithPoses) {
  stored.origin.calibration.reset();
  const std::string path = written();
  EXPECT_THAT(test::message_of<ArgumentError>([&] { (void)read_run_map(path); }),
              HasSubstr("map.db: is a map of images without a camera"));
}

}  // namespace map_file_test
}  // namespace placegraph::apps
