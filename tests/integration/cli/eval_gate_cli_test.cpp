#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace eval_gate_cli_test {

using test::read_file;
using test::write_file;
using ::testing::HasSubstr;

/// Runs over one drive whose positions are off by noise.
class EvalGate : public test::CliTest {
 protected:
  void SetUp() override { write_run("truth.txt", 0, 0); }

  /// A run with noise of `sigma_m` on each position.
  void write_run(const std::string& name, double sigma_m, std::uint64_t seed) {
    Random random(seed);
    Trajectory drive = test::winding_drive(60, 1, false);
    for (StampedPose& pose : drive.poses)
      pose.T_world_body->translation() +=
          sigma_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    std::filesystem::create_directories(std::filesystem::path(dir / name).parent_path());
    write_trajectory(dir / name, drive, TrajectoryFormat::kKitti);
  }
  /// A record of `runs` runs.
  void record(const std::string& file, double sigma_m, int runs, int seed) {
    std::string names;
    for (int i = 0; i < runs; ++i) {
      const std::string name = file + std::to_string(i) + ".txt";
      write_run(name, sigma_m, static_cast<std::uint64_t>(seed + i));
      names += " " + name;
    }
    const auto result = run("eval record truth.txt" + names + " --name 00 -o " + file);
    ASSERT_EQ(result.code, 0) << result.err;
  }
};

TEST_F(EvalGate, OfOneRunEachGoesByTheTolerance) {
  record("a.json", 0.1, 1, 1);
  record("b.json", 0.1, 1, 1);
  record("c.json", 0.2, 1, 1);
  const auto same = run("eval gate a.json b.json");
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out, ::testing::StartsWith("No regression: "));
  EXPECT_EQ(same.err, "");
  const auto worse = run("eval gate a.json c.json --summary report.md --junit report.xml");
  EXPECT_EQ(worse.code, 1);
  EXPECT_THAT(worse.out, ::testing::StartsWith("Regressed: "));
  EXPECT_THAT(worse.err, ::testing::StartsWith("placegraph: regressed: "));
  EXPECT_THAT(read_file(dir / "report.md"), HasSubstr("| **regressed** | 00 | ate\\_rmse\\_m \\[m]"));
  EXPECT_THAT(read_file(dir / "report.xml"), HasSubstr("<failure type=\"regressed\""));
  expect_usage_error("eval gate a.json c.json --junit report.xml", "report.xml");
  EXPECT_EQ(run("eval gate c.json a.json").code, 0);
}

TEST_F(EvalGate, AsksForRunsAndJudgesThem) {
  write_file(dir / "rules.txt", "* | ate_rmse_m | significant\n* | * | info\n");
  record("a.json", 0.10, 6, 1);
  record("b.json", 0.15, 1, 20);
  const auto few = run("eval gate a.json b.json --rules rules.txt --json");
  EXPECT_EQ(few.code, 2);
  const auto told = nlohmann::json::parse(few.out);
  EXPECT_EQ(told.at("verdict"), "cannot be judged");
  EXPECT_GE(told.at("figures")[0].at("runs_needed"), 5);
  EXPECT_THAT(few.err, HasSubstr("runs of each are needed"));
  record("c.json", 0.15, 6, 20);
  EXPECT_EQ(run("eval gate a.json c.json --rules rules.txt").code, 1);
  EXPECT_EQ(run("eval gate c.json a.json --rules rules.txt").code, 0);
}

TEST_F(EvalGate, SeveralFilesAreRunsOfOneSystemInAnyOrder) {
  record("a.json", 0.10, 6, 1);
  std::string forward, backward;
  for (int i = 0; i < 5; ++i) {
    const std::string name = "run" + std::to_string(i) + ".json";
    record(name, 0.15, 1, 30 + i);
    forward += " " + name;
    backward = " " + name + backward;
  }
  const auto one = run("eval gate a.json" + forward + " --json");
  const auto other = run("eval gate a.json" + backward + " --json");
  EXPECT_EQ(one.code, 1);
  EXPECT_EQ(nlohmann::json::parse(one.out).at("figures"),
            nlohmann::json::parse(other.out).at("figures"));
}

TEST_F(EvalGate, AnotherTruthOrAlignmentCannotBeJudged) {
  record("a.json", 0.1, 1, 1);
  ASSERT_EQ(run("eval record truth.txt a.json0.txt --name 00 --align sim3 -o b.json").code, 0);
  const auto options = run("eval gate a.json b.json");
  EXPECT_EQ(options.code, 2);
  EXPECT_THAT(options.out, HasSubstr("the options differ: align is se3, and sim3"));
  const std::string again = "eval record truth.txt a.json0.txt --name 00 --force -o b.json ";
  for (const char* changed :
       {"--apply 'scale 2'", "--apply 'crop :40f' --apply-truth 'crop :40f'", "--estimate body"}) {
    const auto recorded = run(again + changed);
    ASSERT_EQ(recorded.code, 0) << changed << ": " << recorded.err;
    EXPECT_EQ(run("eval gate a.json b.json").code, 2) << changed;
  }
  write_run("other.txt", 0.001, 7);
  ASSERT_EQ(run("eval record other.txt a.json0.txt --name 00 -o c.json").code, 0);
  EXPECT_THAT(run("eval gate a.json c.json").err, HasSubstr("the truth is another one"));
}

TEST_F(EvalGate, FoldersAreSequencesAndALackingFileIsAFailedRun) {
  for (const char* sequence : {"00", "05"}) {
    write_run(std::string("truths/") + sequence + ".txt", 0, 0);
    for (const char* system : {"one/", "two/"})
      write_run(std::string(system) + sequence + ".txt", 0.1, 3);
  }
  ASSERT_EQ(run("eval record truths one two -o a.json").code, 0);
  std::filesystem::remove(dir / "two/05.txt");
  const auto lacking = run("eval record truths one two -o b.json");
  ASSERT_EQ(lacking.code, 0) << lacking.err;
  EXPECT_THAT(lacking.out, HasSubstr("failed: two: no file of 05"));
  EXPECT_EQ(run("eval gate a.json a.json").code, 0);
  const auto worse = run("eval gate a.json b.json");
  EXPECT_EQ(worse.code, 1);
  EXPECT_THAT(worse.out, HasSubstr("1 of 2 runs have no figure: two: no file of 05"));
}

TEST_F(EvalGate, AppendsRunsAndSequences) {
  record("a.json", 0.1, 2, 1);
  const std::string run_of = "eval record truth.txt a.json0.txt -o a.json --name ";
  expect_usage_error(run_of + "00", "a.json");
  ASSERT_EQ(run(run_of + "00 --append --system 1.2").code, 0);
  ASSERT_EQ(run(run_of + "05 --append").code, 0);
  const auto json = nlohmann::json::parse(read_file(dir / "a.json"));
  ASSERT_EQ(json.at("sequences").size(), 2u);
  EXPECT_EQ(json.at("sequences")[0].at("figures")[0].at("values").size(), 3u);
  EXPECT_EQ(json.at("sequences")[1].at("figures")[0].at("values").size(), 1u);
  EXPECT_THAT(json.at("programs"), ::testing::Contains("1.2"));
}

TEST_F(EvalGate, RefusesBrokenFilesInOneLine) {
  record("a.json", 0.1, 1, 1);
  write_file(dir / "old.json", R"({"format": "placegraph record", "version": 0})");
  expect_usage_error("eval gate a.json old.json", "old.json: version: 0 of the format of records");
  write_file(dir / "other.json", "{}");
  expect_usage_error("eval gate other.json a.json", "other.json: is no record");
  write_file(dir / "rules.txt", "\n* | * | better\n");
  expect_usage_error("eval gate a.json a.json --rules rules.txt", "rules.txt:2: 'better' is no rule");
  expect_usage_error("eval gate a.json none.json", "none.json");
  expect_usage_error("eval gate a.json a.json --level 2", "level");
  expect_usage_error("eval gate a.json a.json --summary a.json --force", "a.json");
}

}  // namespace eval_gate_cli_test
}  // namespace placegraph
