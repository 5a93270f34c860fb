// `--report` of the commands that evaluate, and `placegraph report`.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/report_page.h"

namespace placegraph {
namespace report_cli_test {

using nlohmann::json;
using test::CommandResult;
using test::write_file;
using ::testing::HasSubstr;
using ::testing::Not;

class ReportCli : public test::CliTest {
 protected:
  void SetUp() override {
    std::string truth, estimate;
    for (int i = 0; i < 30; ++i) {
      const std::string z = std::to_string(i), x = std::to_string(0.01 * i * i);
      truth += "1 0 0 " + x + " 0 1 0 0 0 0 1 " + z + "\n";
      estimate += "1 0 0 " + x + " 0 1 0 0.1 0 0 1 " + z + "\n";
    }
    write_file(dir / "truth.txt", truth);
    write_file(dir / "estimate.txt", estimate);
    write_file(dir / "found.txt", "20 2 0.9\n21 9 0.8\n");
    write_file(dir / "gt.txt", "20 0 9 2\n21 0 9 3\n");
  }
};

TEST_F(ReportCli, EvalWritesAPageBesideItsJson) {
  const CommandResult result =
      run("eval truth.txt estimate.txt --align none --json --report page.html");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NEAR(json::parse(result.out)["ate_rmse_m"].get<double>(), 0.1, 1e-6);
  const json report = test::report_in(dir / "page.html");
  EXPECT_EQ(report["runs"][0]["name"], "estimate.txt");
  EXPECT_EQ(report["runs"][0]["recording"], "truth.txt");
  expect_usage_error("eval truth.txt estimate.txt --report page.html", "page.html");
  EXPECT_EQ(run("eval truth.txt estimate.txt --report page.html --force").code, 0);
}

TEST_F(ReportCli, EvalOfFoldersHasARunForEverySequence) {
  for (const char* folder : {"truth", "estimates"}) std::filesystem::create_directory(dir / folder);
  for (const char* name : {"00.txt", "01.txt"}) {
    std::filesystem::copy(dir / "truth.txt", dir / "truth/" + name);
    std::filesystem::copy(dir / "estimate.txt", dir / "estimates/" + name);
  }
  ASSERT_EQ(run("eval truth estimates --report page.html").code, 0);
  const json report = test::report_in(dir / "page.html");
  ASSERT_EQ(report["runs"].size(), 2u);
  EXPECT_EQ(report["runs"][1]["recording"], "01");
  EXPECT_EQ(report["tables"][0]["title"], "Averages");
}

TEST_F(ReportCli, WritesNoPageOfWhatFails) {
  write_file(dir / "short.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_EQ(run("eval truth.txt short.txt --report page.html").code, 2);
  expect_usage_error("eval truth.txt none.txt --report page.html", "none.txt");
  expect_usage_error("eval truth.txt estimate.txt --report no/page.html", "no");
  expect_usage_error("eval truth.txt estimate.txt --csv page.html --report page.html",
                     "is where another output is to be written");
  write_file(dir / "found.txt", "20 2\n");
  expect_usage_error("loops --predictions found.txt --truth gt.txt --report page.html",
                     "found.txt:1");
  EXPECT_FALSE(std::filesystem::exists(dir / "page.html"));
}

TEST_F(ReportCli, LoopsWritesAPageBesideItsJson) {
  const std::string command = "loops --predictions found.txt --truth gt.txt --json";
  const CommandResult result = run(command + " --report page.html");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["hits"], 1);
  const json run_in_page = test::report_in(dir / "page.html")["runs"][0];
  EXPECT_EQ(run_in_page["loops"]["judged"], true);
  EXPECT_EQ(run_in_page["loops"]["stage"]["table"], (json{"right", "wrong"}));
  expect_usage_error(command + " --report page.html", "page.html");
  expect_usage_error(command + " --csv other.html --report other.html",
                     "is where another output is to be written");
}

TEST_F(ReportCli, LoopsOnTruePosesShowsTheTrajectory) {
  ASSERT_EQ(run("loops --predictions found.txt --true-poses truth.txt --radius 30 --min-age 5 "
                "--report page.html")
                .code,
            0);
  EXPECT_EQ(test::report_in(dir / "page.html")["runs"][0]["summary"]["posed"], 30);
}

TEST_F(ReportCli, NamesOfFilesAreNoTags) {
  const std::string name = "<img src=x onerror=alert(1)>";
  for (const char* file : {"estimate.txt", "found.txt"})
    std::filesystem::copy(dir / file, dir / (name + file));
  ASSERT_EQ(run("eval truth.txt '" + name + "estimate.txt' --report eval.html").code, 0);
  ASSERT_EQ(
      run("loops --predictions '" + name + "found.txt' --truth gt.txt --report loops.html").code,
      0);
  for (const char* page : {"eval.html", "loops.html"}) {
    EXPECT_THAT(test::read_file(dir / page), Not(HasSubstr("<img src=x onerror")));
    EXPECT_THAT(test::report_in(dir / page)["runs"][0]["name"].get<std::string>(), HasSubstr(name));
  }
}

TEST_F(ReportCli, ReportRefusesWhatIsNoRun) {
  expect_usage_error("report nowhere -o page.html", "nowhere");
  EXPECT_FALSE(std::filesystem::exists(dir / "page.html"));
}

}  // namespace report_cli_test
}  // namespace placegraph
