// `placegraph map georeference`.
#include <placegraph/graph/core/angle.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace georeference_cli_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::CommandResult;
using test::read_file;
using test::write_file;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int kNodes = 100;
constexpr double kRadius_m = 20, kAngle = 0.05;  ///< between neighbours [rad]
/// Radii of WGS84 at latitude 49 deg, height 115 m: of curvature along the meridian, and of the
/// circle of latitude.
constexpr double kMeridian_m = 6371963.6, kParallel_m = 4192510.4;

/// A drive around a circle, one pose a tenth of a second, in the plane.
std::string circle_graph() {
  std::ostringstream out;
  out.precision(12);
  const double chord = 2 * kRadius_m * std::sin(kAngle / 2);
  for (int i = 0; i < kNodes; ++i)
    out << "VERTEX_SE2 " << i << ' ' << kRadius_m * std::sin(i * kAngle) << ' '
        << kRadius_m * (1 - std::cos(i * kAngle)) << ' ' << i * kAngle << '\n';
  for (int i = 1; i < kNodes; ++i)
    out << "EDGE_SE2 " << i - 1 << ' ' << i << ' ' << chord * std::cos(kAngle / 2) << ' '
        << chord * std::sin(kAngle / 2) << ' ' << kAngle << " 1e4 0 0 1e4 0 1e6\n";
  return out.str();
}

/// The same circle on the earth, its first pose 100 m east of 49 N 8.4 E and heading north.
std::string circle_oxts(int count = kNodes, double straight_m = 0) {
  std::ostringstream out;
  out.precision(15);
  for (int i = 0; i < count; ++i) {
    const double a = i * kAngle;
    const double east = straight_m > 0 ? 0 : 100 - kRadius_m * (1 - std::cos(a));
    const double north = straight_m > 0 ? straight_m * i : kRadius_m * std::sin(a);
    out << 49 + rad_to_deg(north / kMeridian_m) << ' ' << 8.4 + rad_to_deg(east / kParallel_m)
        << " 115 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0.1 0 4 8 -1 -1 -1\n";
  }
  return out.str();
}

std::string times(int count = kNodes, double start_s = 0) {
  std::ostringstream out;
  for (int i = 0; i < count; ++i) out << start_s + 0.1 * i << '\n';
  return out.str();
}

class GeoreferenceCli : public test::CliTest {
 protected:
  void SetUp() override {
    write_file(dir / "graph.g2o", circle_graph());
    write_file(dir / "times.txt", times());
    write_file(dir / "oxts.txt", circle_oxts());
    write_file(dir / "times_oxts.txt", times());
  }
  CommandResult run(const std::string& arguments) {
    return CliTest::run("map georeference " + arguments);
  }
  /// One line on stderr, nothing on stdout, no folder made.
  void expect_failure(const std::string& arguments, int code, const std::string& message) {
    CliTest::expect_failure("map georeference " + arguments, code, message);
    EXPECT_FALSE(fs::exists(dir / "out")) << arguments;
  }
};

const std::string kGood = "graph.g2o --times times.txt --gps oxts.txt --out out ";

TEST_F(GeoreferenceCli, WritesTheMapForEveryProgramThatShowsMaps) {
  const CommandResult result = run(kGood + "--origin 49,8.4,115 --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json summary = json::parse(result.out);
  EXPECT_EQ(summary, json::parse(read_file(dir / "out/georeference.json")));
  EXPECT_EQ(summary.at("fixes_used"), kNodes);
  EXPECT_EQ(summary.at("origin").at("height_m"), 115.0);
  EXPECT_LT(summary.at("residual_rms_m").get<double>(), 0.01);
  const json geojson = json::parse(read_file(dir / "out/map.geojson"));
  const json& last = geojson.at("features").back();  // the last node
  EXPECT_EQ(last.at("properties").at("id"), kNodes - 1);
  EXPECT_EQ(last.at("properties").at("stamp_ns"), 9900000000);
  EXPECT_NEAR(last.at("geometry").at("coordinates")[1].get<double>(),
              49 + rad_to_deg(kRadius_m * std::sin(99 * kAngle) / kMeridian_m), 1e-7);
  EXPECT_THAT(read_file(dir / "out/map.kml"), HasSubstr("latitude 49.000000000 deg"));
  EXPECT_THAT(read_file(dir / "out/graph_enu.g2o"), StartsWith("VERTEX_SE2 0 "));
  // "0 x y z qx qy qz qw": heading north.
  std::istringstream trajectory(read_file(dir / "out/trajectory_enu.tum"));
  std::string line;
  while (std::getline(trajectory, line) && line[0] == '#') {
  }
  std::istringstream first(line);
  double t = 0, x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 0;
  first >> t >> x >> y >> z >> qx >> qy >> qz >> qw;
  EXPECT_NEAR(x, 100, 0.02);
  EXPECT_NEAR(y, 0, 0.02);
  EXPECT_NEAR(2 * std::atan2(qz, qw), std::numbers::pi / 2, 1e-3);
  const std::string csv = read_file(dir / "out/fixes.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), kNodes + 1);
}

TEST_F(GeoreferenceCli, TakesTheFolderOfARun) {
  // Places at every tenth frame, the frames between them in the trajectory only.
  fs::create_directory(dir / "run");
  std::ostringstream graph, trajectory;
  graph.precision(12);
  trajectory.precision(12);
  json places = json::array();
  const auto pose = [](int i) {
    std::ostringstream out;
    out.precision(12);
    out << kRadius_m * std::sin(i * kAngle) << ' ' << kRadius_m * (1 - std::cos(i * kAngle))
        << " 0 0 0 " << std::sin(i * kAngle / 2) << ' ' << std::cos(i * kAngle / 2);
    return out.str();
  };
  std::ostringstream edges;
  edges.precision(12);
  const double arc = 10 * kAngle;
  for (int i = 0; i < kNodes; ++i) trajectory << 0.1 * i << ' ' << pose(i) << '\n';
  for (int p = 0; p < 10; ++p) {
    graph << "VERTEX_SE3:QUAT " << p << ' ' << pose(10 * p) << '\n';
    if (p > 0)
      edges << "EDGE_SE3:QUAT " << p - 1 << ' ' << p << ' ' << kRadius_m * std::sin(arc) << ' '
            << kRadius_m * (1 - std::cos(arc)) << " 0 0 0 " << std::sin(arc / 2) << ' '
            << std::cos(arc / 2) << " 1e4 0 0 0 0 0 1e4 0 0 0 0 1e4 0 0 0 1e6 0 0 1e6 0 1e6\n";
    json members = json::array();
    for (int k = 0; k < 10; k += 5)
      members.push_back({{"keyframe", 2 * p + k / 5},
                         {"frame", 10 * p + k},
                         {"stamp_ns", 100000000LL * (10 * p + k)}});
    places.push_back({{"id", p}, {"members", members}});
  }
  write_file(dir / "run/graph.g2o", graph.str() + edges.str());
  write_file(dir / "run/trajectory_optimized.tum", trajectory.str());
  write_file(dir / "run/places.json", json{{"places", places}}.dump());
  write_file(dir / "run/result.json", R"({"metric": true})");
  const CommandResult result = run("run --gps . --out out --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json summary = json::parse(result.out);
  EXPECT_EQ(summary.at("nodes"), 10);
  EXPECT_EQ(summary.at("fixes_used"), kNodes);
  EXPECT_LT(summary.at("residual_rms_m").get<double>(), 0.02);

  // The same map at half its size, as from one eye: the fixes give it its scale.
  write_file(dir / "run/result.json", R"({"metric": false})");
  const CommandResult mono = run("run --gps . --out out2 --json");
  ASSERT_EQ(mono.code, 0) << mono.err;
  EXPECT_NEAR(json::parse(mono.out).at("T_enu_map").at("scale").get<double>(), 1, 1e-3);
  EXPECT_THAT(read_file(dir / "out2/graph_enu.g2o"), StartsWith("VERTEX_SE3:QUAT 0 "));

  write_file(dir / "run/places.json", R"({"places": [{"id": 0, "members": [{"keyframe": 0}]}]})");
  EXPECT_THAT(run("run --gps . --out out3").err, HasSubstr("places.json: was not written by"));
}

TEST_F(GeoreferenceCli, EstimatesLeverArmAndClockWhenAsked) {
  const CommandResult result =
      run(kGood + "--lever-arm estimate --clock-offset estimate --set lever_arm_sigma_m=1");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("lever arm x"));
  EXPECT_THAT(result.out, HasSubstr("clock offset "));
}

TEST_F(GeoreferenceCli, NeverOverwritesUnasked) {
  ASSERT_EQ(run(kGood).code, 0);
  const std::string before = read_file(dir / "out/map.kml");
  const CommandResult again = run(kGood + "--origin 50,8,0");
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("not empty"));
  EXPECT_EQ(read_file(dir / "out/map.kml"), before);
  EXPECT_EQ(run(kGood + "--force").code, 0);
}

TEST_F(GeoreferenceCli, TakesBadFilesAndUsageAsExitCodeTwo) {
  expect_failure("absent.g2o --times times.txt --gps oxts.txt --out out", 2, "absent.g2o");
  expect_failure("graph.g2o --gps oxts.txt --out out", 2, "--times: needed");
  expect_failure("graph.g2o --times times.txt --gps absent.txt --out out", 2, "absent.txt");
  expect_failure(kGood + "--lever-arm 1,2", 2, "--lever-arm: '1,2' is not three numbers");
  expect_failure(kGood + "--lever-arm 1,2,x", 2, "--lever-arm: 'x' is not a number");
  expect_failure(kGood + "--origin 95,8,0", 2, "--origin: latitude");
  expect_failure(kGood + "--clock-offset soon", 2, "--clock-offset: 'soon'");
  expect_failure(kGood + "--origin 49,8,1e308", 2, "--origin: height: 1e+308 outside");
  expect_failure("graph.g2o --times times.txt --gps oxts.txt --out /proc/none/out", 2,
                 "/proc/none");
  expect_failure("graph.g2o --times times.txt --gps oxts.txt --out ''", 2, "folder is empty");
  fs::create_directory(dir / "nothing");
  expect_failure("nothing --gps oxts.txt --out out", 2, "nothing/graph.g2o: cannot be opened");
  expect_failure("graph.g2o --times . --gps oxts.txt --out out", 2, ".: is a folder");
  expect_failure(kGood + "--set max_gap=1", 2, "max_gap");
  expect_failure(kGood + "--set max_gap_s=-1", 2, "max_gap_s");
  write_file(dir / "times.txt", times(50));
  expect_failure(kGood, 2, "times.txt: holds 50 times, none for node 50");
  write_file(dir / "times.txt", times());
  write_file(dir / "times_oxts.txt", times(50));
  expect_failure(kGood, 2, "oxts.txt: holds 100 readings, but times_oxts.txt holds 50 times");
  write_file(dir / "oxts.txt", circle_oxts(50) + "49 8\n");
  expect_failure(kGood, 2, "oxts.txt:51: expected the 30 numbers");
  const std::string rest = " 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0.1 0 4 8 -1 -1 -1\n";
  for (const auto& [position, message] : {std::pair{"nan 8 100", "number 1: 'nan' is not finite"},
                                          std::pair{"49 1e308 100", "longitude: 1e+308 outside"},
                                          std::pair{"49 8 1e308", "height: 1e+308 outside"}}) {
    write_file(dir / "oxts.txt", circle_oxts(50) + position + rest);
    expect_failure(kGood, 2, std::string("oxts.txt:51: ") + message);
  }
  write_file(dir / "oxts.txt", circle_oxts());
  for (const auto& [last, message] : {std::pair{"9.8", "time '9.8' does not increase"},
                                      std::pair{"nan", "time: 'nan' is not a time"},
                                      std::pair{"1e308", "time: '1e308' is not a time"}}) {
    write_file(dir / "times_oxts.txt", times(kNodes - 1) + last + "\n");
    expect_failure(kGood, 2, std::string("times_oxts.txt:100: ") + message);
  }
}

TEST_F(GeoreferenceCli, TakesDataThatAllowNoAnswerAsExitCodeOne) {
  write_file(dir / "times_oxts.txt", times(kNodes, 1000));
  expect_failure(kGood, 1, "no time in common");
  write_file(dir / "times_oxts.txt", times());
  write_file(dir / "oxts.txt", circle_oxts(kNodes, 50));  // a straight drive of 5 km
  expect_failure(kGood, 1, "fixes agree");
}

}  // namespace georeference_cli_test
}  // namespace placegraph
