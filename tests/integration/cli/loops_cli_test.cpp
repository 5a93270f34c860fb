#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"

namespace placegraph {
namespace loops_cli_test {

using test::write_file;

class Loops : public test::CliTest {
 protected:
  void SetUp() override {
    write_file(dir / "gt.txt", "10 0 5 1 2\n11 0 5 3\n12 0 5 -\n");
    write_file(dir / "ours.txt", "10 2 0.9\n11 4 0.8\n12 5 0.1\n");
    write_file(dir / "theirs.txt", "10 2 0.9 accepted\n11 3 0.8 accepted\n");
  }
};

TEST_F(Loops, RefusesBrokenInputWithItsLine) {
  write_file(dir / "ours.txt", "10 2 0.9\n11 4\n");
  expect_usage_error("loops --predictions ours.txt --truth gt.txt", "ours.txt:2: 2 columns");
  write_file(dir / "gt.txt", "10 0 5 1\n11 0 5 9\n");
  expect_usage_error("loops --predictions theirs.txt --truth gt.txt", "gt.txt:2: match 9");
  expect_usage_error("loops --predictions theirs.txt", "one of --truth and --true-poses is needed");
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
