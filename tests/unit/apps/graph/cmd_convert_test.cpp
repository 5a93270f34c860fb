#include "apps/graph/cmd_convert.h"

#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <CLI/CLI.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace cmd_convert_test {

using test::message_of;
using test::read_file;
using test::TemporaryFolder;
using testing::HasSubstr;

void convert(std::vector<std::string> arguments) {
  CLI::App app("test", "placegraph");
  apps::add_convert_command(app);
  arguments.insert(arguments.begin(), "convert");
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants a vector
  app.parse(arguments);
}

const std::string kKitti = "1 0 0 0 0 1 0 0 0 0 1 0\n0 -1 0 1 1 0 0 2 0 0 1 3\n";

TEST(ConvertCommandLine, GoesRoundThroughAllThreeForms) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.txt", kKitti);
  convert({in, folder / "a.tum", "--times",
           folder.write("t.txt", "1403636579.763555527\n1403636580\n")});
  convert({folder / "a.tum", folder / "b.csv"});
  convert({folder / "b.csv", folder / "c.kitti"});
  convert({folder / "b.csv", folder / "d.tum"});
  EXPECT_EQ(read_file(folder / "a.tum"), read_file(folder / "d.tum"));
  EXPECT_EQ(read_trajectory(folder / "b.csv").poses[0].stamp_ns, 1403636579763555527);
  const Trajectory read = read_trajectory(folder / "c.kitti");
  Eigen::Matrix4d expected;
  expected << 0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1;
  // Twelve digits of the quaternion.
  EXPECT_LT((read.poses[1].T_world_body->matrix() - expected).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(ConvertCommandLine, GoesByContentInAndByNameOrFlagOut) {
  const TemporaryFolder folder;
  const std::string tum = folder.write("misnamed.csv", "1 0 0 0 0 0 0 1\n");
  convert({tum, folder / "out.dat", "--to", "kitti"});
  EXPECT_FALSE(read_trajectory(folder / "out.dat").has_times);
  EXPECT_THAT(message_of<ArgumentError>([&] {
                convert({tum, folder / "other.dat"});
              }),
              HasSubstr("other.dat: the extension is not that of a known form"));
  EXPECT_THAT(message_of<ArgumentError>([&] {
                convert({tum, folder / "out.g2o"});
              }),
              HasSubstr("is a trajectory"));
}

TEST(ConvertCommandLine, NormalizesAGraph) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.g2o",
                                      "# c\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n"
                                      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1.0 0.50 0\n");
  convert({in, folder / "out.g2o"});
  EXPECT_EQ(read_file(folder / "out.g2o"),
            "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0.5 0\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n");
  EXPECT_THAT(message_of<ArgumentError>([&] {
                convert({in, folder / "out.tum"});
              }),
              HasSubstr("is a pose graph"));
}

TEST(ConvertCommandLine, TakesThePosesOfAGraphInTheOrderOfTheirIds) {
  const TemporaryFolder folder;
  const std::string planar =
      folder.write("planar.g2o", "VERTEX_SE2 7 3 4 1.5707963267948966\nVERTEX_SE2 -1 1 2 0\n");
  convert({planar, folder / "planar.kitti"});
  const Trajectory read = read_trajectory(folder / "planar.kitti");
  ASSERT_EQ(read.size(), 2u);
  Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
  expected.col(3).head<2>() << 1, 2;
  EXPECT_EQ(read.poses[0].T_world_body->matrix(), expected);
  expected << 0, -1, 0, 3, 1, 0, 0, 4, 0, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_LT((read.poses[1].T_world_body->matrix() - expected).cwiseAbs().maxCoeff(), 1e-9);
  const std::string spatial = folder.write(
      "spatial.g2o", "VERTEX_SE3:QUAT 1 0 0 5 0 0 0.7071067811865476 0.7071067811865476\n");
  convert({spatial, folder / "spatial.kitti"});
  expected << 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 5, 0, 0, 0, 1;
  EXPECT_LT((read_trajectory(folder / "spatial.kitti").poses[0].T_world_body->matrix() - expected)
                .cwiseAbs()
                .maxCoeff(),
            1e-9);
  const std::string scaled =
      folder.write("scaled.g2o", "VERTEX_SIM3:EXPMAP 0 0 0 0 0 0 0 0.6931471805599453\n");
  convert({scaled, folder / "scaled.kitti"});
  EXPECT_EQ(read_trajectory(folder / "scaled.kitti").poses[0].T_world_body->matrix(),
            Eigen::Matrix4d::Identity());
}

TEST(ConvertCommandLine, LeavesLostFramesOutOnRequest) {
  const TemporaryFolder folder;
  const std::string lost = "nan nan nan nan nan nan nan nan nan nan nan nan\n";
  const std::string first = kKitti.substr(0, kKitti.find('\n') + 1),
                    second = kKitti.substr(first.size());
  const std::string estimate = folder.write("estimate.txt", first + lost + second);
  const std::string truth = folder.write("truth.txt", first + second + second);
  convert({estimate, folder / "kept.kitti"});
  EXPECT_EQ(read_trajectory(folder / "kept.kitti").size(), 3u);
  convert({estimate, folder / "posed.kitti", "--posed-only"});
  convert({truth, folder / "truth.kitti", "--posed-in", estimate});
  for (const char* name : {"posed.kitti", "truth.kitti"}) {
    const Trajectory posed = read_trajectory(folder / name);
    ASSERT_EQ(posed.size(), 2u) << name;
    EXPECT_EQ(posed.posed(), 2u);
    EXPECT_EQ(posed.poses[1].T_world_body->translation().z(), 3);
  }
  EXPECT_THAT(message_of<ArgumentError>([&] {
                convert({folder.write("a.tum", "1 0 0 0 0 0 0 1\n"), folder / "b.tum", "--rigid"});
              }),
              HasSubstr("not a pose graph"));
}

TEST(ConvertCommandLine, NeverOverwritesWithoutForce) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.txt", kKitti);
  const std::string out = folder.write("out.kitti", "precious");
  EXPECT_THAT(message_of<ArgumentError>([&] { convert({in, out}); }), HasSubstr("--force"));
  EXPECT_EQ(read_file(out), "precious");
  convert({in, out, "--force"});
  EXPECT_EQ(read_trajectory(out).size(), 2u);
}

TEST(ConvertCommandLine, AsksForTimesWhereTheFormNeedsThem) {
  const TemporaryFolder folder;
  const std::string in = folder.write("in.txt", kKitti);
  EXPECT_THAT(message_of<ArgumentError>([&] {
                convert({in, folder / "out.tum"});
              }),
              HasSubstr("give them with --times"));
  const std::string tum = folder.write("in.tum", "1 0 0 0 0 0 0 1\n");
  const std::string times = folder.write("t.txt", "0\n");
  EXPECT_THROW(convert({tum, folder / "out.kitti", "--times", times}), ArgumentError);
  EXPECT_THROW(convert({folder / "none", folder / "out.kitti"}), CLI::ParseError);
}

}  // namespace cmd_convert_test
}  // namespace placegraph
