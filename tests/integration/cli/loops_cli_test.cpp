#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"

namespace placegraph {
namespace loops_cli_test {

using test::write_file;
using ::testing::HasSubstr;

class Loops : public test::CliTest {
 protected:
  void SetUp() override {
    write_file(dir / "gt.txt", "10 0 5 1 2\n11 0 5 3\n12 0 5 -\n");
    write_file(dir / "ours.txt", "10 2 0.9\n11 4 0.8\n12 5 0.1\n");
    write_file(dir / "theirs.txt", "10 2 0.9 accepted\n11 3 0.8 accepted\n");
  }
};

TEST_F(Loops, GivesTheFiguresOfOneSystemAsJson) {
  const auto result = run("loops --predictions ours.txt --format scores --truth gt.txt --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("positives"), 2);
  EXPECT_EQ(json.at("r_at_1"), 0.5);
  EXPECT_EQ(json.at("ap"), 0.5);
  EXPECT_EQ(json.at("recall_at_100p"), 0.5);
  EXPECT_NEAR(json.at("f1_max").get<double>(), 2.0 / 3, 1e-9);
}

TEST_F(Loops, ComparesSystemsInATableALogAndAPlot) {
  const auto result = run(
      "loops --predictions ours.txt theirs.txt --systems ours theirs --truth gt.txt --csv log.csv "
      "--plot "
      "pr.svg");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("theirs"));
  EXPECT_THAT(result.out, HasSubstr("1.0000"));
  const std::string log = test::read_file(dir / "log.csv");
  EXPECT_THAT(log, HasSubstr("ours,11,1,miss,4,0.8,0,\n"));
  EXPECT_THAT(log, HasSubstr("theirs,11,1,hit,3,0.8,1,accepted\n"));
  EXPECT_THAT(log, HasSubstr("theirs,12,0,silent,,,0,\n"));
  EXPECT_THAT(test::read_file(dir / "pr.svg"), HasSubstr("theirs: AP 1.000"));
  expect_usage_error("loops --predictions ours.txt --truth gt.txt --csv log.csv", "log.csv");
}

TEST_F(Loops, TakesTheTruthFromPosesAndSaysHow) {
  std::string poses;
  for (const double x : {0, 10, 20, 1, 11})
    poses += "1 0 0 " + std::to_string(x) + " 0 1 0 0 0 0 1 0\n";
  write_file(dir / "poses.txt", poses);
  write_file(dir / "found.txt", "3 0 2\n4 0 1\n4 3 9\n");
  const auto result =
      run("loops --predictions found.txt --true-poses poses.txt --radius 2 --heading 10 --min-age "
          "2 --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("positives"), 2);
  EXPECT_EQ(json.at("dropped"), 1);
  EXPECT_EQ(json.at("r_at_1"), 0.5);
  EXPECT_EQ(json.at("protocol"),
            "within one drive: poses within 2 m and 10 deg, candidates at least 2 images older");
  write_file(dir / "found.txt", "3 0 2\n5 0 1\n");
  expect_usage_error("loops --predictions found.txt --true-poses poses.txt --heading 180",
                     "found.txt:2: query 5, and there are 5 images of the drive");
}

// Two drives in step: image q of the one shows images q - 1, q and q + 1 of the other.
TEST_F(Loops, ASquareMatrixMayBeOfTwoSets) {
  constexpr int kImages = 20;
  std::string matrix, found;
  for (int q = 0; q < kImages; ++q) {
    for (int m = 0; m < kImages; ++m) matrix += std::abs(q - m) <= 1 ? "1 " : "0 ";
    matrix += "\n";
    found += std::to_string(q) + " " + std::to_string(q) + " 0." + std::to_string(10 + q) + "\n";
  }
  write_file(dir / "matrix.txt", matrix);
  write_file(dir / "found.txt", found);
  const auto result = run("loops --predictions found.txt --truth matrix.txt --min-age 0 --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("comparison"), "queries against a database");
  EXPECT_EQ(json.at("r_at_1"), 1);
  EXPECT_DOUBLE_EQ(json.at("ap").get<double>(), 1);
  expect_usage_error("loops --predictions found.txt --truth matrix.txt", "--min-age 0");
}

TEST_F(Loops, TwoSetsAreGivenByThePositionsOrNamesOfTheirImages) {
  write_file(dir / "database.csv", "image,latitude,longitude\na.jpg,48,11\nb.jpg,48.001,11\n");
  write_file(dir / "queries.csv", "image,latitude,longitude\nq.jpg,48.00101,11\n");
  write_file(dir / "found.csv", "query,match,distance\nq.jpg,b.jpg,0.25\nq.jpg,a.jpg,0.5\n");
  const auto result = run(
      "loops --predictions found.csv --queries queries.csv --database database.csv --radius 25 "
      "--heading 180 --json --curve curve.csv");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("protocol"),
            "queries against a database: positions within 25 m (latitudes and longitudes)");
  EXPECT_EQ(json.at("scores"), "distance");
  EXPECT_EQ(json.at("r_at_1"), 1);
  EXPECT_THAT(test::read_file(dir / "curve.csv"), HasSubstr("found.csv,0.25,1,0,1,1"));
  expect_usage_error("loops --predictions found.csv --queries queries.csv", "both are needed");
  write_file(dir / "queries.csv", "x,y\n0,0\n");
  expect_usage_error(
      "loops --predictions found.csv --queries queries.csv --database database.csv", "queries.csv");
}

TEST_F(Loops, DistancesAreToldAndTaken) {
  std::string found, truth;
  for (int q = 0; q < 20; ++q) {
    for (int k = 0; k < 3; ++k)
      found += std::to_string(q + 30) + " " + std::to_string((q + 7 * k) % 20) + " 0." +
               std::to_string(k + 1) + std::to_string(q) + "\n";
    truth += std::to_string(q + 30) + " " + std::to_string(q) + "\n";
  }
  write_file(dir / "found.txt", found);
  write_file(dir / "gt.txt", truth);
  const auto as_they_are = run("loops --predictions found.txt --truth gt.txt --min-age 0");
  EXPECT_THAT(as_they_are.err, HasSubstr("they seem to be distances"));
  const auto taken =
      run("loops --predictions found.txt --truth gt.txt --min-age 0 --scores distance --json");
  EXPECT_EQ(nlohmann::json::parse(taken.out).at("r_at_1"), 1) << taken.err;
  EXPECT_EQ(taken.err, "");
}

TEST_F(Loops, RefusesBrokenInputWithItsLine) {
  write_file(dir / "ours.txt", "10 2 0.9\n11 4\n");
  expect_usage_error("loops --predictions ours.txt --truth gt.txt", "ours.txt:2: 2 columns");
  write_file(dir / "gt.txt", "10 0 5 1\n11 0 5 9\n");
  expect_usage_error("loops --predictions theirs.txt --truth gt.txt", "gt.txt:2: match 9");
  expect_usage_error("loops --predictions theirs.txt", "one of --truth, --true-poses");
  expect_usage_error("loops --predictions theirs.txt --truth gt.txt --format other", "other");
  expect_usage_error("loops --predictions none.txt --truth gt.txt", "none.txt");
  write_file(dir / "gt.txt", "10 0 5 1\n");
  expect_usage_error("loops --predictions theirs.txt --truth gt.txt --plot pr.gif", "pr.gif");
  expect_usage_error("loops --predictions theirs.txt --truth gt.txt --systems a b", "--systems");
}

TEST_F(Loops, ScoresAPublishedDetectorAsPublished) {
  PLACEGRAPH_DATA_OR_SKIP(folder, "golden/loops");
  const auto result =
      run("loops --predictions " + folder + "/ibow_KITTI06_loops.txt --format ibow --truth " +
          folder + "/KITTI_06_loops_10m.txt --json");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_NEAR(json.at("recall_at_100p").get<double>(), 0.814, 0.002);
  EXPECT_NEAR(json.at("ap").get<double>(), 0.814, 0.002);
}

}  // namespace loops_cli_test
}  // namespace placegraph
