#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/graphs/euler_angles.h>
#include <placegraph/io/graphs/pose_graph_file.h>

#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace pose_graph_file_test {

using test::TemporaryFolder;

const std::string kSeeds[] = {
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 2 0.5\nFIX 0\nEDGE_SE2 0 1 1 2 0.5 4 2 0 10 0 25\n",
    "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 7 1 2 3 0 0 0.6 0.8\n"
    "EDGE_SE3:QUAT 0 7 1 2 3 0 0 0.6 0.8 1 0 0 0 0 .5 2 0 0 0 0 3 0 0 0 4 0 0 5 0 6\n",
    "VERTEX_SIM3:EXPMAP 0 0 0 0 0 0 0 0\nVERTEX_SIM3:EXPMAP 1 0 0 1 1 2 3 .1 1 1 0 0\n"
    "EDGE_SIM3:EXPMAP 0 1 0 0 1 1 2 3 .1 1 0 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n",
    "VERTEX2 0 0 0 0\nVERTEX2 1 1 2 0.5\nEDGE2 0 1 1 2 0.5 4 2 10 25 0 0\n",
    "VERTEX3 0 0 0 0 0 0 0\nVERTEX3 1 1 2 3 .1 .2 .3\n"
    "EDGE3 0 1 1 2 3 .1 .2 .3 1 0 0 0 0 .5 2 0 0 0 0 3 0 0 0 4 0 0 5 0 6\n",
    "ODOMETRY 0 1 1 2 0.5 2 1 0 3 0 5\nODOMETRY 1 2 1 2 0.5 2 1 0 3 0 5\n"
    "EDGE2 2 0 1 1 1 1 0 0 1 0 1\n"};

const std::string kScraps[] = {"nan",  "-inf", "1e999", "-1", "0",   "9223372036854775807",
                               "\n",   " ",    "\t",    "#",  "FIX", "-9223372036854775808",
                               "1e308"};

/// One to four bytes or scraps changed, doubled, cut out or cut off.
std::string mutated(std::string text, Random& random) {
  for (int i = 1 + random.index(4); i > 0 && !text.empty(); --i) {
    const auto at = static_cast<std::size_t>(random.index(static_cast<int>(text.size())));
    const auto length = static_cast<std::size_t>(random.index(12));
    switch (random.index(5)) {
      case 0:
        text[at] = static_cast<char>(random.index(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at / 2, length));
        break;
      case 3:
        text.insert(at, " " + kScraps[random.index(static_cast<int>(std::size(kScraps)))] + " ");
        break;
      default:
        if (random.index(8) == 0) text.resize(at);
    }
  }
  return text;
}

TEST(PoseGraphFile, IsReadIntoASoundGraphOrRefusedHoweverItIsBroken) {
  const TemporaryFolder folder;
  Random random(11);
  int read = 0, refused = 0;
  for (int trial = 0; trial < 1200; ++trial) {
    const std::string text =
        mutated(kSeeds[static_cast<std::size_t>(trial) % std::size(kSeeds)], random);
    SCOPED_TRACE(text);
    const std::string path = folder.write("graph", text);
    try {
      const PoseGraph graph = read_pose_graph(path, {.connected = trial % 2 == 0});
      graph.check();
      EXPECT_FALSE(graph.nodes.empty());
      ++read;
    } catch (const FileError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      ++refused;
    }
  }
  // Both happen often, else the mutations prove nothing.
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 400);
}

TEST(PoseGraphFile, GivesTheSameGraphInEveryFormFromKnownPoses) {
  Random random(12);
  for (int trial = 0; trial < 20; ++trial) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    const double roll = random.uniform(-3, 3), pitch = random.uniform(-1.5, 1.5),
                 yaw = random.uniform(-3, 3);
    const Eigen::Quaterniond q = rotation_of_euler_angles(roll, pitch, yaw).quaternion();
    Matrix6d root = Matrix6d::Zero();
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j) root(i, j) = random.normal();
    const Matrix6d omega = root.transpose() * root;
    std::string root_text, omega_text;
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j) {
        root_text += fmt::format(" {:.17g}", root(i, j));
        omega_text += fmt::format(" {:.17g}", omega(i, j));
      }
    const std::string euler =
        fmt::format(" {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", x, y, z, roll, pitch, yaw);
    const std::string quaternion =
        fmt::format(" {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", x, y, z, q.x(),
                    q.y(), q.z(), q.w());
    const std::string texts[] = {
        "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1" + quaternion + "\nEDGE_SE3:QUAT 0 1" +
            quaternion + omega_text,
        "VERTEX3 0 0 0 0 0 0 0\nVERTEX3 1" + euler + "\nEDGE3 0 1" + euler + omega_text,
        "EDGE3 0 1" + euler + root_text};
    const TemporaryFolder folder;
    for (const std::string& text : texts) {
      const PoseGraph graph = read_pose_graph(folder.write("graph", text));
      ASSERT_EQ(graph.nodes.size(), 2u);
      const SE3 expected(SO3(q), Eigen::Vector3d(x, y, z));
      const auto& edge = std::get<RelativePoseConstraint>(graph.constraints.at(0));
      for (const Pose& pose : {graph.nodes[1].T_world_node, edge.T_from_to})
        EXPECT_LT((std::get<SE3>(pose).inverse() * expected).log().norm(), 1e-13);
      EXPECT_LT((Matrix6d(edge.information) - omega).cwiseAbs().maxCoeff(), 1e-13 * omega.norm());
    }
  }
}

}  // namespace pose_graph_file_test
}  // namespace placegraph
