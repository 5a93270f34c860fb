#include <placegraph/io/measurements/marker_layout_file.h>

#include <nlohmann/json.hpp>
#include <numeric>

#include "tests/support/cli_test.h"

namespace placegraph::test {
namespace flight_cli_test {

using nlohmann::json;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// One short flight, rendered once for all tests.
class FlightCli : public CliTest {
 protected:
  static void SetUpTestSuite() {
    rendered() = std::make_unique<TemporaryFolder>();
    const CommandResult result = run_placegraph(
        "synth sequence flight --out flight --duration 4 --seed 6", rendered()->path());
    ASSERT_EQ(result.code, 0) << result.err;
  }
  static void TearDownTestSuite() { rendered().reset(); }
  static std::unique_ptr<TemporaryFolder>& rendered() {
    static std::unique_ptr<TemporaryFolder> folder;
    return folder;
  }
  static std::string flight() { return *rendered() / "flight"; }
  /// A copy to be spoilt.
  std::string copy() {
    fs::copy(flight(), dir / "copy", fs::copy_options::recursive);
    return dir / "copy";
  }
  json result(const std::string& folder) {
    return json::parse(read_file(dir / (folder + "/result.json")));
  }
};

TEST_F(FlightCli, KnowsWhereItIsToCentimetres) {
  const CommandResult ran = run("flight run " + flight() + " --out out --profile");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("81 of 81 frames with a state"));
  EXPECT_THAT(ran.out, HasSubstr("detect markers"));
  const json summary = result("out");
  EXPECT_EQ(summary["lost_frames"].size(), 0U);
  EXPECT_GT(summary["frames_with_flow"].get<int>(), 70);
  EXPECT_GT(summary["frames_with_markers"].get<int>(), 60);
  EXPECT_LT(summary["error"]["position_rmse_m"].get<double>(), 0.02);
  EXPECT_LT(summary["error"]["attitude_rmse_deg"].get<double>(), 0.5);
  EXPECT_EQ(summary["error"]["compared"], 81);
  const std::string tum = read_file(dir / "out/trajectory.tum");
  EXPECT_EQ(std::count(tum.begin(), tum.end(), '\n'), 82);  // and a head
  const std::string states = read_file(dir / "out/states.csv");
  EXPECT_EQ(std::count(states.begin(), states.end(), '\n'), 82);
  EXPECT_TRUE(fs::exists(dir / "out/frames.csv"));
}

TEST_F(FlightCli, RepeatsItselfToTheBit) {
  ASSERT_EQ(run("flight run " + flight() + " --out a").code, 0);
  ASSERT_EQ(run("flight run " + flight() + " --out b").code, 0);
  EXPECT_EQ(read_file(dir / "a/states.csv"), read_file(dir / "b/states.csv"));
}

TEST_F(FlightCli, GoesOnWithoutMarkersFromWhatItKnew) {
  ASSERT_EQ(run("flight run " + flight() + " --out until --markers-until 1").code, 0);
  const json until = result("until");
  EXPECT_LE(until["frames_with_markers"].get<int>(), 20);
  EXPECT_EQ(until["answered"], 81);
  EXPECT_LT(until["error"]["end_error_m"].get<double>(), 0.05);
  ASSERT_EQ(run("flight run " + flight() + " --out blind --blind 1:2 --blind 2.5:3").code, 0);
  EXPECT_EQ(result("blind")["outages_s"].size(), 1U);
  ASSERT_EQ(run("flight run " + flight() + " --out truth --no-markers --start-from-truth").code, 0);
  EXPECT_EQ(result("truth")["frames_with_markers"], 0);
  EXPECT_LT(result("truth")["error"]["end_error_m"].get<double>(), 0.05);
}

TEST_F(FlightCli, SmoothsTheSameMeasurements) {
  ASSERT_EQ(run("flight run " + flight() + " --out smooth --smooth").code, 0);
  const json smoother = result("smooth")["smoother"];
  EXPECT_EQ(smoother["compared"], 81);  // from the first image on
  EXPECT_LT(smoother["position_rmse_m"].get<double>(), 0.02);
  EXPECT_GT(smoother["filter_over_smoother"].get<double>(), 0.5);
  EXPECT_TRUE(fs::exists(dir / "smooth/smoothed.csv"));
  expect_usage_error("flight run " + flight() + " --out x --smooth --predict-ahead-ms 50",
                     "--smooth");
}

TEST_F(FlightCli, TellsWhereItWillBe) {
  ASSERT_EQ(run("flight run " + flight() + " --out ahead --predict-ahead-ms 100").code, 0);
  const json ahead = result("ahead");
  EXPECT_LT(ahead["error"]["position_rmse_m"].get<double>(), 0.03);
  EXPECT_EQ(ahead["error"]["compared"], 79);  // the truth ends before the last two
}

TEST_F(FlightCli, MapsMarkersWhosePlaceIsNotKnown) {
  const MarkerLayout truth = read_marker_layout(flight() + "/markers.yaml");
  MarkerLayout partly = truth;
  partly.beacons_world.clear();
  // The first ones keep their place, every other one loses it.
  partly.markers.clear();
  for (std::size_t i = 0; i < truth.markers.size(); ++i) {
    const PlacedMarker& marker = truth.markers[i];
    if (i % 2 == 0)
      partly.markers.push_back(marker);
    else
      partly.unplaced_sides_m[marker.id] = marker.side_m;
  }
  write_marker_layout(dir / "partly.yaml", partly);
  const std::string command = "flight run " + flight() + " --markers partly.yaml --map-markers ";
  const CommandResult ran =
      run(command + "--out out --truth-markers " + flight() + "/markers.yaml --json");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const json map = result("out")["marker_map"];
  ASSERT_GT(map["compared_markers"].get<int>(), 0);
  EXPECT_LT(map["worst_error_m"].get<double>(), 0.01);
  EXPECT_LT(map["worst_error_deg"].get<double>(), 1);
  // What it wrote is a layout to fly by, and to find markers of single images by.
  const MarkerLayout mapped = read_marker_layout(dir / "out/markers.yaml");
  EXPECT_EQ(mapped.markers.size() + mapped.unplaced_sides_m.size(), truth.markers.size());
  EXPECT_EQ(mapped.markers.size(), partly.markers.size() + map["markers"].size());
  ASSERT_EQ(run("flight run " + flight() + " --out again --markers out/markers.yaml").code, 0);
  EXPECT_LT(result("again")["error"]["position_rmse_m"].get<double>(), 0.02);
  expect_usage_error("flight run " + flight() + " --out x --map-markers",
                     "has the pose of every marker");
  expect_usage_error(command + "--out x --predict-ahead-ms 50", "--map-markers");
}

TEST_F(FlightCli, SaysNothingWithoutAStart) {
  const CommandResult ran = run("flight run " + flight() + " --out out --no-markers");
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("no image has a state"));
  EXPECT_EQ(result("out")["answered"], 0);
}

TEST_F(FlightCli, RefusesBrokenFlightsWithFileAndLine) {
  expect_usage_error("flight run " + dir.path() + " --out out", "EuRoC's layout");
  const std::string at = copy();
  const auto with = [&](const std::string& file, const std::string& text,
                        const std::string& message) {
    const std::string before = read_file(at + "/" + file);
    dir.write("copy/" + file, text);
    expect_usage_error("flight run " + at + " --out out", message);
    dir.write("copy/" + file, before);
  };
  with("mav0/imu0/data.csv", "1,2,3\n", "imu0/data.csv:1: expected");
  with("markers.yaml", "dictionary: x\nmark: 3\n", "markers.yaml:2: 'mark': unknown key");
  with("markers.yaml",
       "dictionary: mine\nmarkers:\n  - {id: 1, side_m: 0.1, position: [0, 0, 0], quaternion: [1, "
       "0, 0, 0]}\n",
       "mine");
  with("mav0/state_groundtruth_estimate0/data.csv", "7,1,2\n", "data.csv:1: has positions alone");
  fs::remove(at + "/mav0/imu0/sensor.yaml");
  expect_usage_error("flight run " + at + " --out out", "imu0/sensor.yaml");
  EXPECT_FALSE(fs::exists(dir / "out"));
}

TEST_F(FlightCli, RefusesOptionsThatMakeNoSense) {
  const std::string command = "flight run " + flight() + " --out out ";
  expect_usage_error(command + "--blind 3", "FROM:TO");
  expect_usage_error(command + "--blind 3:2", "FROM:TO");
  expect_usage_error(command + "--blind 3000:3001", "begins after the flight");
  expect_usage_error(command + "--predict-ahead-ms 900", "filter.max_prediction_s");
  expect_usage_error(command + "--markers-until 0", "--markers-until");
  expect_usage_error(command + "--set filter.gat=1", "unknown key");
  expect_usage_error(command + "--set filter.gate=2", "filter.gate");
  dir.write("out/x", "");
  expect_usage_error(command, "--force");
}

TEST_F(FlightCli, WorldsOfOtherKindsHaveNoFlight) {
  expect_usage_error("synth sequence town-loop --out town --duration 5", "duration_s");
  expect_usage_error("synth sequence flight --out town --stereo", "has one camera");
}

}  // namespace flight_cli_test
}  // namespace placegraph::test
