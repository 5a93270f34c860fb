#include "apps/track/lines_track.h"

#include <placegraph/io/synthetic/writers/sequence_writer.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "apps/support/output.h"
#include "tests/support/clean_world.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace lines_track_test {

using test::message_of;
using testing::HasSubstr;

/// A few frames of the corridor, small, with depth and true poses.
class LinesTrackCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new test::TemporaryFolder;
    const SyntheticOptions options = test::clean_world("corridor-loop", 8, 320, 240);
    SequenceWriterOptions writer;
    writer.contents.depth = true;
    write_sequence(SyntheticWorld(options), *folder / "hall", writer);
  }
  static void TearDownTestSuite() { delete folder; }
  LinesTrackCommand() {
    arguments.sequence = *folder / "hall";
    arguments.sensor = "rgbd";
    arguments.out = *folder / "tracks.txt";
    arguments.force = true;
  }
  static test::TemporaryFolder* folder;
  LinesTrackArguments arguments;
};
test::TemporaryFolder* LinesTrackCommand::folder = nullptr;

TEST_F(LinesTrackCommand, CountsWhatItWritesAndJudgesItByTheTruePoses) {
  const LinesTrackResult result = lines_track(arguments);
  std::map<int, std::set<int>> frames_of;
  std::istringstream in(test::read_file(arguments.out));
  std::size_t lines = 0, of_use = 0;
  for (std::string line; std::getline(in, line); ++lines) {
    std::istringstream fields(line);
    int id = 0, frame = 0;
    double px[4];
    ASSERT_TRUE(fields >> id >> frame >> px[0] >> px[1] >> px[2] >> px[3]) << line;
    EXPECT_TRUE(frames_of[id].insert(frame).second) << line;
    EXPECT_LT(frame, 8);
  }
  for (const auto& [id, frames] : frames_of) of_use += frames.size() >= 3;
  EXPECT_EQ(result.sequence, "hall");
  EXPECT_EQ(result.tracks, frames_of.size());
  EXPECT_EQ(result.tracks_of_use, of_use);
  EXPECT_GT(result.tracks_of_use, 5u);
  EXPECT_GE(result.median_length_of_use, 3);
  EXPECT_GE(result.median_length_of_use, result.median_length_frames);
  ASSERT_TRUE(result.judgement);
  EXPECT_EQ(result.judgement->judged + result.judgement->undecided, lines);
  EXPECT_GT(result.judgement->judged, 20u);
  EXPECT_LT(result.judgement->wrong_percent(), 10);
}

TEST_F(LinesTrackCommand, JudgesNothingWithoutTruePoses) {
  std::filesystem::copy(arguments.sequence, *folder / "bare",
                        std::filesystem::copy_options::recursive);
  std::filesystem::remove(*folder / "bare/poses.txt");
  arguments.sequence = *folder / "bare";
  arguments.out.clear();
  EXPECT_FALSE(lines_track(arguments).judgement);
}

TEST_F(LinesTrackCommand, SaysWhatItCannotUse) {
  arguments.settings = {"slam.no_such_option=1"};
  EXPECT_THAT(message_of<Error>([&] { lines_track(arguments); }), HasSubstr("no_such_option"));
  arguments.settings.clear();
  arguments.sequence = *folder / "none";
  EXPECT_THAT(message_of([&] { lines_track(arguments); }), HasSubstr("none"));
}

TEST(LinesTrackText, SaysWhatTheTruthSays) {
  LinesTrackResult result;
  result.sequence = "hall";
  result.tracks = 12, result.median_length_frames = 4;
  result.tracks_of_use = 9, result.median_length_of_use = 5;
  const std::string line = "hall: 12 lines followed, median over 4 frames";
  EXPECT_EQ(to_text(result), line + "\n");
  EXPECT_FALSE(nlohmann::json::parse(to_json(result)).contains("wrong"));
  result.judgement = LineTracksJudgement{.judged = 40, .wrong = 1, .undecided = 3};
  EXPECT_EQ(to_text(result),
            line + "; by the true poses 1 of 40 observations wrong (2.50 %), 3 undecided\n");
  const auto json = nlohmann::json::parse(to_json(result));
  EXPECT_EQ(json["sightings"], 40);
  EXPECT_EQ(json["wrong_percent"], 2.5);
  EXPECT_EQ(json["median_length_of_use_frames"], 5);
  EXPECT_EQ(LineTracksJudgement{}.wrong_percent(), 0);
}

}  // namespace lines_track_test
}  // namespace placegraph::apps
