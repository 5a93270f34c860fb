#include <placegraph/io/graphs/isam.h>

#include "tests/support/edge_of.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace isam_test {

using test::edge_of;
using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

TEST(Isam, ReadsEdgesAndChainsThePosesAlongOdometry) {
  const TemporaryFolder folder;
  // A walk around a square: ahead by one, then a turn to the left; the loop comes first.
  const PoseGraph graph =
      read_isam(folder.write("a.txt",
                             "EDGE2 3 0 1.5 0 0 1 0 0 1 0 1\n"
                             "ODOMETRY 1 2 1 0 1.5707963267948966 1 0 0 1 0 1\n"
                             "ODOMETRY 0 1 1 0 1.5707963267948966 1 0 0 1 0 1\n"
                             "ODOMETRY 2 3 1 0 1.5707963267948966 1 0 0 1 0 1\n"));
  ASSERT_EQ(graph.nodes.size(), 4u);
  const Eigen::Vector2d corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(graph.nodes[i].id, NodeId(i));
    EXPECT_LT((std::get<SE2>(graph.nodes[i].T_world_node).translation() - corners[i]).norm(),
              1e-15);
  }
  EXPECT_EQ(edge_of(graph, 0).source, ConstraintSource::kLoop);
  EXPECT_EQ(edge_of(graph, 1).source, ConstraintSource::kOdometry);
}

TEST(Isam, ChainsBackwardsAlongAnEdgeToItsFrom) {
  const TemporaryFolder folder;
  const PoseGraph graph = read_isam(folder.write("a.txt",
                                                 "EDGE2 8 3 2 0 0 1 0 0 1 0 1\n"
                                                 "EDGE2 8 20 0 5 0 1 0 0 1 0 1\n"));
  ASSERT_EQ(graph.nodes.size(), 3u);  // 3, 8, 20
  EXPECT_LT(
      (std::get<SE2>(graph.nodes[1].T_world_node).translation() - Eigen::Vector2d(-2, 0)).norm(),
      1e-15);
  EXPECT_LT(
      (std::get<SE2>(graph.nodes[2].T_world_node).translation() - Eigen::Vector2d(-2, 5)).norm(),
      1e-15);
}

TEST(Isam, SquaresTheRootOfTheInformation) {
  const TemporaryFolder folder;
  const PoseGraph planar = read_isam(folder.write("a.txt", "EDGE2 0 1 1 0 0 2 1 3 4 5 6\n"));
  Eigen::Matrix3d R;
  R << 2, 1, 3, 0, 4, 5, 0, 0, 6;
  EXPECT_EQ(Eigen::Matrix3d(edge_of(planar, 0).information), Eigen::Matrix3d(R.transpose() * R));
  const PoseGraph spatial = read_isam(
      folder.write("b.txt", "EDGE3 0 1 1 2 3 0 0 0 1 0 0 0 0 .5 2 0 0 0 0 3 0 0 0 4 0 0 5 0 6\n"));
  Matrix6d root = Eigen::DiagonalMatrix<double, 6>(1, 2, 3, 4, 5, 6);
  root(0, 5) = 0.5;
  EXPECT_EQ(Matrix6d(edge_of(spatial, 0).information), Matrix6d(root.transpose() * root));
  EXPECT_LT((std::get<SE3>(spatial.nodes[1].T_world_node).translation() - Eigen::Vector3d(1, 2, 3))
                .norm(),
            1e-15);
}

class IsamRefuses : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(IsamRefuses, AndSaysWhereAndWhy) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("a.txt", std::string("ODOMETRY 0 1 1 0 0 1 0 0 1 0 1\n") + GetParam().first);
  EXPECT_THAT(message_of([&] { read_isam(path); }), HasSubstr(GetParam().second));
}

INSTANTIATE_TEST_SUITE_P(
    Faults, IsamRefuses,
    testing::Values(
        std::pair{"EDGE2 0 1 1 0 0 1 0 0 1 0", "a.txt:2: EDGE2: expected 11 numbers, found 10"},
        std::pair{"ODOMETRY 1 1 1 0 0 1 0 0 1 0 1", "a.txt:2: an edge from 1 to itself"},
        std::pair{"EDGE2 0 1 1 0 0 0 0 0 0 0 0", "a.txt:2: the root of the information has a zero"},
        std::pair{"EDGE2 0 1 1 0 0 1e200 0 0 1 0 1", "a.txt:2: the information is not finite"},
        std::pair{"EDGE3 0 1 1 0 0 0 0 0", "a.txt:2: EDGE3: expected 29 numbers, found 8"},
        std::pair{"LANDMARK 0 1 1 0 1 0 1", "a.txt:2: LANDMARK: a pose graph has no landmarks"},
        std::pair{"VERTEX2 0 0 0 0", "a.txt:2: 'VERTEX2': unknown tag"}));

TEST(Isam, HasToHaveEdges) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "# nothing\n");
  EXPECT_THAT(message_of([&] { read_isam(path); }), HasSubstr("a.txt: holds no vertices"));
}

}  // namespace isam_test
}  // namespace placegraph
