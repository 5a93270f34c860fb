#include "apps/flight/fly.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/writers/flight_writer.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace fly_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

/// A rendered flight of a second, made once: 21 images.
class FlightCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    SyntheticOptions options;
    options.world = "flight";
    options.duration_s = 1;
    options.seed = 6;
    write_flight(SyntheticWorld(options), *made / "flight", {});
  }
  static void TearDownTestSuite() { delete made; }
  FlightCommand() {
    arguments.flight = *made / "flight";
    arguments.out = folder / "out";
  }
  static test::TemporaryFolder* made;
  test::TemporaryFolder folder;
  FlightArguments arguments;
};
test::TemporaryFolder* FlightCommand::made = nullptr;

TEST_F(FlightCommand, KnowsWhereItIsToCentimetresAndWritesIt) {
  const FlightResult result = fly(arguments);
  EXPECT_FALSE(result.no_result);
  EXPECT_EQ(result.summary["frames"], 21);
  EXPECT_EQ(result.summary["answered"], 21);
  EXPECT_LT(result.summary["error"]["position_rmse_m"].get<double>(), 0.03);
  EXPECT_FALSE(result.summary.contains("smoother"));
  EXPECT_EQ(json::parse(test::read_file(folder / "out/result.json")), result.summary);
  EXPECT_EQ(read_trajectory(folder / "out/trajectory.tum").posed(), 21u);
  EXPECT_TRUE(fs::exists(folder / "out/states.csv"));
  EXPECT_TRUE(fs::exists(folder / "out/frames.csv"));
  EXPECT_FALSE(fs::exists(folder / "out/smoothed.csv"));
}

TEST_F(FlightCommand, SmoothsIfAskedAndIsAsSureThen) {
  arguments.smooth = true;
  const json summary = fly(arguments).summary;
  EXPECT_TRUE(fs::exists(folder / "out/smoothed.csv"));
  EXPECT_LT(summary["smoother"]["position_rmse_m"].get<double>(), 0.03);
  arguments.smooth = false;
  arguments.force = true;
  fly(arguments);
  EXPECT_FALSE(fs::exists(folder / "out/smoothed.csv"));  // of the run before
}

TEST_F(FlightCommand, HasNoAnswerWithoutMarkersToBeginWith) {
  arguments.no_markers = true;
  const FlightResult result = fly(arguments);
  ASSERT_TRUE(result.no_result);
  EXPECT_THAT(*result.no_result, HasSubstr("flight: no image has a state ("));
  EXPECT_EQ(result.summary["answered"], 0);
  EXPECT_THAT(message_of([&] { read_trajectory(folder / "out/trajectory.tum"); }),
              HasSubstr("holds no poses"));
}

TEST_F(FlightCommand, NamesWhatIsMissingAndMakesNoFolder) {
  arguments.markers = folder / "none.yaml";
  EXPECT_THAT(message_of([&] { fly(arguments); }), HasSubstr("none.yaml"));
  arguments.markers.clear();
  arguments.settings = {"filter.no=1"};
  EXPECT_THAT(message_of<ArgumentError>([&] { fly(arguments); }), HasSubstr("filter.no"));
  EXPECT_FALSE(fs::exists(arguments.out));
  folder.write("out/mine.txt", "mine");
  EXPECT_THAT(message_of<ArgumentError>([&] { fly(arguments); }),
              HasSubstr("out: is not empty; --force writes into it"));
}

TEST(FlightText, SaysHowWellItIsKnown) {
  FlightResult result;
  result.out = "out";
  result.summary = {{"sequence", "flight"},
                    {"frames", 80},
                    {"answered", 78},
                    {"frames_with_flow", 70},
                    {"frames_with_markers", 60},
                    {"reading_ms_per_frame", 1.25},
                    {"cpu_ms_per_frame", 10.5},
                    {"stages", {{{"name", "flow"}, {"calls", 79}, {"cpu_s", 0.4}}}}};
  const std::string first = "flight: 78 of 80 frames with a state, 70 with flow, 60 with markers\n";
  const std::string last = "11.75 ms CPU a frame (1.25 of them reading), results in out\n";
  EXPECT_EQ(to_text(result), first + last);
  result.summary["error"] = {{"position_rmse_m", 0.0123},
                             {"velocity_rmse_mps", 0.02},
                             {"attitude_rmse_deg", 0.3},
                             {"path_length_m", 4.56}};
  EXPECT_EQ(to_text(result), first +
                                 "position RMSE 0.0123 m, velocity 0.0200 m/s, attitude 0.300 deg "
                                 "over 4.6 m\n" +
                                 last);
  EXPECT_EQ(stages_text(result),
            "stage                calls  CPU ms/frame\n"
            "flow                    79         5.000\n");
  EXPECT_EQ(json::parse(to_json(result)), result.summary);
}

}  // namespace fly_test
}  // namespace placegraph::apps
