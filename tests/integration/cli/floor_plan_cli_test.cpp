// `placegraph image orientation`, `run --config floor_plan`, `map plan`.
#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace floor_plan_cli_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::CommandResult;
using test::read_file;

/// A rendered walk, made once for all tests.
class FloorPlanCli : public test::CliTest {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    const CommandResult result = test::run_placegraph(
        "synth sequence corridor-loop --frames 60 --size 320x240 --difficulty clean --labels "
        "--mono --out "
        "walk",
        made->path());
    ASSERT_EQ(result.code, 0) << result.err;
  }
  static void TearDownTestSuite() { delete made; }
  static std::string walk() { return *made / "walk"; }
  static inline test::TemporaryFolder* made = nullptr;
};

TEST_F(FloorPlanCli, TellsOrientationsOfASequence) {
  const CommandResult result = run("image orientation " + walk() + " --every 20 --out maps --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json summary = json::parse(result.out);
  EXPECT_EQ(summary["images"], 3);
  // At half the size.
  EXPECT_GT(summary["check"]["accuracy"].get<double>(), 0.8);
  EXPECT_TRUE(fs::exists(dir / "maps/000020.png"));
}

TEST_F(FloorPlanCli, TellsTheSurfacesOfAnImage) {
  dir.write("K.txt", "262.5 262.5 159.5 119.5 320 240\n");
  const std::string image = walk() + "/image_0/000000.png";
  const CommandResult result =
      run("image orientation " + image + " --calib K.txt --out map.png --draw drawn.png --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json summary = json::parse(result.out);
  EXPECT_GT(summary["wall"].get<double>(), summary["ceiling"].get<double>());
  EXPECT_TRUE(fs::exists(dir / "map.png"));
  EXPECT_TRUE(fs::exists(dir / "drawn.png"));
  expect_usage_error("image orientation " + image + " --out other.png", "--calib");
  expect_usage_error("image orientation " + image + " --calib K.txt --out map.png", "map.png");
}

TEST_F(FloorPlanCli, DrawsTheFloorPlanOfARun) {
  const CommandResult result =
      run("run " + walk() + " --sensor rgbd --config floor_plan --out out --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json plan = json::parse(result.out)["floor_plan"];
  EXPECT_EQ(plan["outcome"], "ok");
  // A few metres of way: what was seen stands where it should.
  EXPECT_LT(plan["check"]["origin"]["plan_error_median_m"].get<double>(), 0.05);
  for (const char* name : {"floor_plan.json", "floor_plan.svg", "floor_plan.png"})
    EXPECT_TRUE(fs::exists(dir / ("out/" + std::string(name)))) << name;
  const json places = json::parse(read_file(dir / "out/places.json"));
  EXPECT_FALSE(places["places"][0]["labels"].empty());
  ASSERT_EQ(run("map plan out --out plan").code, 0);
  EXPECT_EQ(read_file(dir / "plan/floor_plan.json"), read_file(dir / "out/floor_plan.json"));
}

TEST_F(FloorPlanCli, MonocularHasItsMetreFromTheFloorBetweenWalls) {
  const CommandResult result = run(
      "run " + walk() + " --sensor mono --camera-height 1.4 --config floor_plan --out out --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json summary = json::parse(result.out);
  EXPECT_EQ(summary["floor_plan"]["outcome"], "ok");
  // Of 6 m at a quarter of the pixels.
  EXPECT_LT(summary["evaluation"]["origin"]["ate_rmse_m"].get<double>(), 0.05);
}

}  // namespace floor_plan_cli_test
}  // namespace placegraph
