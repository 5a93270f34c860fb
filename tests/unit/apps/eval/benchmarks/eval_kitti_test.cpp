#include "apps/eval/benchmarks/eval_kitti.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trajectories.h"

namespace placegraph::apps {
namespace eval_kitti_test {

class EvalKittiCommand : public testing::Test {
 protected:
  void write_drive(const std::string& name, double off_m = 0) {
    Trajectory drive = test::winding_drive(130, 1, false);
    drive.poses.back().T_world_body->translation().x() += off_m;
    std::filesystem::create_directories(std::filesystem::path(folder / name).parent_path());
    write_trajectory(folder / name, drive, TrajectoryFormat::kKitti);
  }
  void SetUp() override {
    write_drive("truth/03.txt");
    write_drive("mine/03.txt");
    arguments = {folder / "truth", {folder / "mine"}, {}, folder / "out", "svg", false};
  }
  test::TemporaryFolder folder;
  EvalKittiArguments arguments;
};

TEST_F(EvalKittiCommand, WritesTablesAndPlotsOfASoundSubmission) {
  const KittiBenchmark benchmark = eval_kitti(arguments);
  EXPECT_EQ(benchmark.faults(), 0u);
  EXPECT_EQ(test::read_file(folder / "out/stats.txt"), "0.000000 0.000000\n");
  EXPECT_TRUE(std::filesystem::exists(folder / "out/plot_path/03.svg"));
  EXPECT_THAT(test::message_of<ArgumentError>([&] { eval_kitti(arguments); }),
              testing::HasSubstr("is not empty"));
  arguments.force = true;
  EXPECT_EQ(eval_kitti(arguments).faults(), 0u);
}

TEST_F(EvalKittiCommand, WritesNothingForOneWithFaults) {
  folder.write("mine/03.txt", "1 2 3\n");
  EXPECT_EQ(eval_kitti(arguments).faults(), 2u);  // the line, and the number of lines
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

}  // namespace eval_kitti_test
}  // namespace placegraph::apps
