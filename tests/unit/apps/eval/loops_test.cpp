#include "apps/eval/loops.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace loops_test {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

/// Queries 10 and 11 match 1 and 2, query 12 matches 3; the system finds the first right, misses
/// the second and says nothing of the third.
class LoopsCommand : public testing::Test {
 protected:
  LoopsCommand() {
    arguments.truth = folder.write("gt.txt", "10 0 5 1\n11 0 5 2\n12 0 5 3\n");
    arguments.predictions = {folder.write("found.txt", "10 1 0.9\n11 5 0.8\n")};
  }
  void expect_refused(const std::string& message) {
    EXPECT_THAT(message_of<ArgumentError>([&] { loops(arguments); }), HasSubstr(message));
  }
  test::TemporaryFolder folder;
  LoopsArguments arguments;
};

TEST_F(LoopsCommand, CountsHitsAndMisses) {
  const LoopsResult result = loops(arguments);
  ASSERT_EQ(result.systems.size(), 1u);
  const LoopBenchmark& found = result.systems[0].benchmark;
  EXPECT_EQ(found.positives, 3);
  EXPECT_EQ(found.predicted_queries, 2);
  EXPECT_NEAR(found.recall_at[0].value(), 1.0 / 3, 1e-12);
  EXPECT_EQ(result.systems[0].name, "found.txt");
  EXPECT_EQ(result.protocol, "within one drive: matches and candidates listed per query");
  const json report = json::parse(to_json(result));
  EXPECT_EQ(report["hits"], 1);
  EXPECT_EQ(report["misses"], 1);
  EXPECT_EQ(report["protocol"], result.protocol);
  EXPECT_FALSE(report.contains("reliability"));
}

TEST_F(LoopsCommand, ForgivesImagesWithinTheTolerance) {
  arguments.tolerance = 3;
  const LoopsResult result = loops(arguments);
  EXPECT_NEAR(result.systems[0].benchmark.recall_at[0].value(), 2.0 / 3, 1e-12);
  EXPECT_THAT(result.protocol, HasSubstr(", matches good to 3 images"));
}

TEST_F(LoopsCommand, LeavesOutCandidatesThatAreTooYoung) {
  arguments.min_age = 7;  // 11 - 5 is younger
  const LoopsResult result = loops(arguments);
  EXPECT_EQ(result.systems[0].benchmark.predicted_queries, 1);
  EXPECT_EQ(result.systems[0].benchmark.dropped, 1);
  EXPECT_THAT(result.protocol, HasSubstr(", candidates at least 7 images older"));
  EXPECT_THAT(to_text(result), HasSubstr("found.txt: left out: 0 predictions for images"));
}

TEST_F(LoopsCommand, ComparesSystemsByTheirNames) {
  arguments.predictions.push_back(folder.write("other.txt", "12 3 0.5\n"));
  arguments.names = {"one", "two, \"of us\""};
  arguments.csv = folder / "log.csv";
  const LoopsResult result = loops(arguments);
  const json report = json::parse(to_json(result));
  EXPECT_EQ(report["systems"][0]["name"], "one");
  EXPECT_EQ(report["systems"][1]["name"], arguments.names[1]);
  EXPECT_EQ(report["systems"][1]["hits"], 1);
  const std::string log = test::read_file(arguments.csv);
  EXPECT_THAT(log, HasSubstr("one,10,1,hit,1,0.9,"));
  EXPECT_THAT(log, HasSubstr("\"two, \"\"of us\"\"\",12,1,hit,3,0.5,"));
}

TEST_F(LoopsCommand, JudgesByPoses) {
  std::string poses;  // there and back again: image 9 - k stands where image k does
  for (int i = 0; i < 10; ++i)
    poses += "1 0 0 " + std::to_string(20 * (i < 5 ? i : 9 - i)) + " 0 1 0 0 0 0 1 0\n";
  arguments.truth.clear();
  arguments.poses = folder.write("poses.txt", poses);
  arguments.predictions = {folder.write("found.txt", "9 0 0.9\n8 1 0.8\n7 1 0.7\n")};
  arguments.min_age = 2;
  const LoopsResult result = loops(arguments);
  EXPECT_EQ(result.systems[0].benchmark.positives, 4);  // 6 to 9; 5 is one image older than 4
  EXPECT_EQ(json::parse(to_json(result))["hits"], 2);
  folder.write("found.txt", "10 0 0.9\n");
  EXPECT_THAT(message_of([&] { loops(arguments); }),
              HasSubstr("found.txt:1: query 10, and there are 10 images of the drive"));
}

TEST_F(LoopsCommand, TellsWhetherProbabilitiesHold) {
  arguments.formats = {LoopFileFormat::kRun};
  arguments.predictions = {folder.write(
      "loops.csv", "query,match,stage,probability\n10,1,accepted,0.75\n11,5,accepted,0.75\n")};
  const LoopsResult result = loops(arguments);
  ASSERT_TRUE(result.systems[0].reliability);
  EXPECT_NEAR(result.systems[0].reliability->calibration_error, 0.25, 1e-9);  // half were right
  EXPECT_THAT(to_text(result),
              HasSubstr("calibration error of the probabilities of 2 candidates: 0.250"));
}

TEST_F(LoopsCommand, RefusesArgumentsThatMeanNothing) {
  const LoopsArguments asked = arguments;
  arguments.truth.clear();
  expect_refused("one of --truth, --true-poses, and --queries with --database is needed");
  arguments = asked;
  arguments.names = {"one", "two"};
  expect_refused("--systems: one for each of --predictions");
  arguments = asked;
  arguments.formats = {LoopFileFormat::kScores, LoopFileFormat::kRun};
  expect_refused("--format: one for all, or one for each of --predictions");
  arguments = asked;
  arguments.predictions.clear();
  expect_refused("--predictions: none are given");
  arguments = asked;
  arguments.plot = folder / "plot.jpg";
  expect_refused("plot.jpg");
  EXPECT_FALSE(std::filesystem::exists(arguments.plot));
}

}  // namespace loops_test
}  // namespace placegraph::apps
