#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/results/component_files.h>
#include <placegraph/pipeline/results/run_results.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/scenes/posed_map.h"
#include "tests/support/scenes/scene.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace component_files_test {

/// Five frames of component 0 and three of component 1, a metre apart.
Map two_components() {
  std::vector<SE3> poses;
  for (int i = 0; i < 8; ++i) poses.push_back(test::pose({0, 0, 0}, {1.0 * i, 0, 0}));
  Map map = test::posed_map(poses);
  for (int i = 0; i < 8; ++i) {
    const auto at = static_cast<std::size_t>(i);
    map.place_graph.places[at].component = i < 5 ? 0 : 1;
    map.frames.push_back({FrameId(10 + i), 1'000'000'000LL * i, KeyframeId(i), SE3(), 40});
    if (i > 0 && i != 5)
      map.place_graph.constraints.push_back({.from = NodeId(i - 1),
                                             .to = NodeId(i),
                                             .T_from_to = test::pose({0, 0, 0}, {1, 0, 0}),
                                             .information = Matrix6d::Identity(),
                                             .kernel = {}});
  }
  return map;
}

TEST(ComponentFiles, AreWrittenForAllButTheMainOne) {
  const test::TemporaryFolder folder;
  const std::string earlier = folder / "trajectory_optimized.component7.tum";
  write_trajectory(earlier, two_components().trajectory_optimized(0), TrajectoryFormat::kTum);
  write_other_components(folder.path(), two_components());
  EXPECT_FALSE(std::filesystem::exists(earlier));
  EXPECT_FALSE(std::filesystem::exists(folder / "trajectory_optimized.component0.tum"));
  EXPECT_TRUE(std::filesystem::exists(folder / "trajectory_optimized.component1.kitti"));
  const Trajectory other = read_trajectory(folder / "trajectory_optimized.component1.tum");
  ASSERT_EQ(other.posed(), 3u);
  EXPECT_EQ(other.poses.back().stamp_ns, 7'000'000'000LL);
}

TEST(ComponentFiles, AreDescribed) {
  const nlohmann::json described = describe_components(two_components());
  ASSERT_EQ(described.size(), 2u);
  EXPECT_EQ(described[0]["trajectory"], "trajectory_optimized.tum");
  EXPECT_EQ(described[0]["main"], true);
  EXPECT_EQ(described[1]["trajectory"], "trajectory_optimized.component1.tum");
  EXPECT_EQ(described[1]["posed"], 3);
  EXPECT_EQ(described[1]["first_frame"], 15);
  EXPECT_EQ(described[1]["last_frame"], 17);
}

}  // namespace component_files_test
}  // namespace placegraph
