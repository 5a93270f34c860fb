// `placegraph run --elements`, kinds of environments and masks.
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace elements_cli_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::CommandResult;

/// A rendered walk, made once for all tests.
class ElementsCli : public test::CliTest {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    const CommandResult result = test::run_placegraph(
        "synth sequence corridor-loop --frames 40 --size 320x240 --difficulty standard --mono "
        "--out walk",
        made->path());
    ASSERT_EQ(result.code, 0) << result.err;
  }
  static void TearDownTestSuite() { delete made; }
  static std::string walk() { return *made / "walk"; }
  static inline test::TemporaryFolder* made = nullptr;
};

TEST_F(ElementsCli, ContextTellsTheKindOfEverySurroundingsAndLabelsPlaces) {
  const CommandResult result = run("run " + walk() +
                                   " --sensor rgbd --elements motion,context,semantics --out out "
                                   "--json");
  ASSERT_EQ(result.code, 0) << result.err;
  const json summary = json::parse(result.out);
  EXPECT_EQ(summary["posed"], 40);
  EXPECT_EQ(summary["loops_checked"], 0);
  const json& kinds = summary["environments"];
  EXPECT_GE(kinds["corridor"].get<int>(), 1);
  EXPECT_EQ(kinds["street"], 0);
  int all = 0;
  for (const auto& [kind, count] : kinds.items()) all += count.get<int>();
  EXPECT_EQ(all, summary["places"]);
  EXPECT_NE(test::read_file(dir / "out/places.json").find("environment:corridor"),
            std::string::npos);
  const std::string csv = test::read_file(dir / "out/environment.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + summary["keyframes"].get<int>());
  EXPECT_EQ(csv.rfind("frame,sky_above", 0), 0u);
}

TEST_F(ElementsCli, WithoutContextAndSemanticsNothingIsLabelled) {
  const CommandResult result =
      run("run " + walk() + " --sensor rgbd --elements motion,spatial --out out --json");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_FALSE(json::parse(result.out).contains("environments"));
  EXPECT_FALSE(fs::exists(dir / "out/environment.csv"));
}

TEST_F(ElementsCli, RefusesWrongListsInOneLineAndLeavesNothing) {
  const std::string command = "run " + walk() + " --out out --elements ";
  expect_usage_error(command + "motion,colour", "'colour' is none of");
  expect_usage_error(command + "spatial,geometry", "motion is needed");
  expect_usage_error(command + "motion,motion", "twice");
  EXPECT_FALSE(fs::exists(dir / "out"));
}

}  // namespace elements_cli_test
}  // namespace placegraph
