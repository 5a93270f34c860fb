// `placegraph run --config street_map`, `map semantic`.
#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace street_map_cli_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::CommandResult;
using test::read_file;

/// A few metres of a rendered town and the run over them, made once for all tests.
class StreetMapCli : public test::CliTest {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    CommandResult result = test::run_placegraph(
        "synth sequence town-loop --frames 30 --size 620x188 --difficulty clean --labels --stereo "
        "--out "
        "town",
        made->path());
    ASSERT_EQ(result.code, 0) << result.err;
    result = test::run_placegraph(
        "run town --sensor stereo --config street_map --set scene.urban.min_step_m=0.5 "
        "--set scene.urban.sight.step_px=3 --out out --json",
        made->path());
    ASSERT_EQ(result.code, 0) << result.err;
    summary = json::parse(result.out);
  }
  static void TearDownTestSuite() { delete made; }
  static std::string at(const std::string& name) { return *made / name; }
  static inline test::TemporaryFolder* made = nullptr;
  static inline json summary;
  /// As the run was told: there are few keyframes, and they are small.
  static inline const std::string kDense = " --set min_step_m=0.5 --set sight.step_px=3";
};

TEST_F(StreetMapCli, TellsWhatTrulyStandsThere) {
  const json& semantic = summary["semantic_map"];
  EXPECT_EQ(semantic["outcome"], "ok");
  EXPECT_GT(semantic["cells"].get<int>(), 1000);
  // At half the size and a tenth of the path of what docs/results/urban_map.md has.
  for (const char* poses : {"online", "optimized"}) {
    EXPECT_GT(semantic["check"][poses]["all"]["right_share"].get<double>(), 0.75) << poses;
    EXPECT_LT(semantic["check"][poses]["all"]["nothing_share"].get<double>(), 0.05) << poses;
  }
  const json document = json::parse(read_file(at("out/semantic_map.json")));
  EXPECT_FALSE(document["places"].empty());
  EXPECT_TRUE(fs::exists(at("out/semantic_map.png")));
  EXPECT_EQ(read_file(at("out/semantic_map.ply")).substr(0, 4), "ply\n");
}

TEST_F(StreetMapCli, MakesTheSameMapFromTheSavedOne) {
  ASSERT_EQ(run("map street " + at("out") + " --out map" + kDense).code, 0);
  EXPECT_EQ(read_file(dir / "map/semantic_map.ply"), read_file(at("out/semantic_map.ply")));
  EXPECT_FALSE(fs::exists(dir / "map/semantic_map.geojson"));
}

TEST_F(StreetMapCli, LaysTheMapOutOnTheEarth) {
  dir.write("earth/georeference.json",
            R"({"origin": {"latitude_deg": 49, "longitude_deg": 8.4, "height_m": 115}})");
  dir.write("earth/trajectory_enu.tum", read_file(at("out/trajectory_optimized.tum")));
  const CommandResult result =
      run("map street " + at("out") + " --georeference earth --out map" + kDense);
  ASSERT_EQ(result.code, 0) << result.err;
  const json document = json::parse(read_file(dir / "map/semantic_map.geojson"));
  EXPECT_EQ(document["type"], "FeatureCollection");
  ASSERT_FALSE(document["features"].empty());
  const json& corner = document["features"][0]["geometry"]["coordinates"][0][0][0];
  EXPECT_NEAR(corner[0].get<double>(), 8.4, 0.01);
  EXPECT_NEAR(corner[1].get<double>(), 49, 0.01);
  dir.write("earth/georeference.json", "{}");
  expect_usage_error("map street " + at("out") + " --georeference earth --out other",
                     "georeference.json");
}

TEST_F(StreetMapCli, SaysWhatIsMissing) {
  expect_usage_error(
      "run " + at("town") + " --config street_map --set scene.urban_model=none.pgscene --out other",
      "none.pgscene: no such model; `placegraph train urban DATA");
  expect_usage_error("map street " + at("out") + " --model none.pgscene --out other",
                     "placegraph train urban");
  expect_usage_error("run " + at("town") +
                         " --config street_map --set scene.urban.labelling.moving=Tram --out other",
                     "Tram");
}

TEST_F(StreetMapCli, NeedsStereo) {
  const CommandResult result =
      run("run " + at("town") +
          " --sensor mono --camera-height 1.65 --set max_frames=6 --config street_map --out other "
          "--json");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, testing::HasSubstr("no street map: a stereo camera is required"));
  EXPECT_EQ(json::parse(result.out)["semantic_map"]["outcome"], "too few data");
}

}  // namespace street_map_cli_test
}  // namespace placegraph
