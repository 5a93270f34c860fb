#include <placegraph/io/trajectories/trajectory_file.h>

#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace kitti_cli_test {

using testing::HasSubstr;

class KittiCli : public test::CliTest {
 protected:
  void SetUp() override {
    for (const std::string name : {"truth/03.txt", "mine/03.txt"}) {
      std::filesystem::create_directories(std::filesystem::path(dir / name).parent_path());
      write_trajectory(dir / name, test::winding_drive(130, 1, false), TrajectoryFormat::kKitti);
    }
  }
};

TEST_F(KittiCli, JudgesAFolder) {
  const test::CommandResult result = run("eval kitti truth mine --out judged");
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("mine: 1 file; fit to be submitted"));
  EXPECT_TRUE(std::filesystem::exists(dir / "judged/plot_error/avg_tl.png"));
  const test::CommandResult json = run("eval kitti truth mine --json");
  EXPECT_EQ(nlohmann::json::parse(json.out).at("systems").at(0).at("segments"), 3);
}

TEST_F(KittiCli, ASubmissionWithFaultsIsPrintedAndEndsWithTwo) {
  const std::string lines = test::read_file(dir / "mine/03.txt");
  dir.write("mine/03.txt", "0.5 " + lines);
  const test::CommandResult result = run("eval kitti truth mine --out judged");
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.out, HasSubstr("mine/03.txt:1: 13 numbers, not 12"));
  EXPECT_THAT(result.err, HasSubstr("mine: is not fit to be submitted: mine/03.txt:1: 13 numbers"));
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
  EXPECT_FALSE(std::filesystem::exists(dir / "judged"));
  EXPECT_EQ(run("eval kitti truth mine --json").code, 2);
}

TEST_F(KittiCli, RefusesWhatItCannotJudge) {
  expect_usage_error("eval kitti truth mine --sequences 04", "no true poses of the sequence '04'");
  expect_usage_error("eval kitti truth mine --plot-format gif", "gif");
  dir.write("empty/readme", "");
  expect_usage_error("eval kitti truth empty", "empty: holds no poses of a sequence");
}

}  // namespace kitti_cli_test
}  // namespace placegraph
