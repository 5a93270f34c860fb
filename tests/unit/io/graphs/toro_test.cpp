#include <numbers>

#include <placegraph/io/graphs/euler_angles.h>
#include <placegraph/io/graphs/toro.h>

#include "tests/support/edge_of.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace toro_test {

using test::edge_of;
using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

TEST(EulerAngles, RotationAboutTheFixedAxesXThenYThenZ) {
  const double right_angle = std::numbers::pi / 2;
  // Roll takes y to z, then pitch z to x, then yaw x to y.
  const SO3 R = rotation_of_euler_angles(right_angle, right_angle, right_angle);
  EXPECT_LT((R * Eigen::Vector3d(0, 1, 0) - Eigen::Vector3d(0, 1, 0)).norm(), 1e-15);
  EXPECT_LT((R * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0, 0, -1)).norm(), 1e-15);
  EXPECT_LT((R * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-15);
  // Near zero they are the rotation vector.
  EXPECT_LT(
      (rotation_of_euler_angles(1e-6, -2e-6, 3e-6).log() - Eigen::Vector3d(1, -2, 3) * 1e-6).norm(),
      1e-11);
}

TEST(Toro, ReadsAPlanarGraphWithItsOwnOrderOfTheInformation) {
  const TemporaryFolder folder;
  const PoseGraph graph = read_toro(folder.write("a.graph",
                                                 "EDGE2 5 7 1 2 1.5 40 1 30 20 2 3\n"
                                                 "VERTEX2 5 0 0 0\n"
                                                 "VERTEX2 7 1 2 1.5707963267948966\n"));
  ASSERT_EQ(graph.nodes.size(), 2u);
  const Eigen::Vector2d p_world =
      std::get<SE2>(graph.nodes[1].T_world_node) * Eigen::Vector2d(1, 0);
  EXPECT_LT((p_world - Eigen::Vector2d(1, 3)).norm(), 1e-15);
  EXPECT_EQ(edge_of(graph, 0).source, ConstraintSource::kLoop);
  EXPECT_DOUBLE_EQ(std::get<SE2>(edge_of(graph, 0).T_from_to).rotation().angle(), 1.5);
  Eigen::Matrix3d information;  // ff fs ss rr fr sr
  information << 40, 1, 2, 1, 30, 3, 2, 3, 20;
  EXPECT_EQ(Eigen::Matrix3d(edge_of(graph, 0).information), information);
}

TEST(Toro, ReadsASpatialGraph) {
  const TemporaryFolder folder;
  const PoseGraph graph = read_toro(folder.write("a.graph",
                                                 "VERTEX3 0 0 0 0 0 0 0\n"
                                                 "VERTEX3 1 1 2 3 0 0 1.5707963267948966\n"
                                                 "EDGE3 0 1 1 2 3 .1 .2 .3 "
                                                 "1 0 0 0 0 .5 2 0 0 0 0 3 0 0 0 4 0 0 5 0 6\n"));
  EXPECT_EQ(graph.kind(), PoseKind::kSE3);
  const Eigen::Vector3d p_world =
      std::get<SE3>(graph.nodes[1].T_world_node) * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((p_world - Eigen::Vector3d(1, 3, 3)).norm(), 1e-15);
  const SE3 T_from_to = std::get<SE3>(edge_of(graph, 0).T_from_to);
  EXPECT_LT((T_from_to.rotation().inverse() * rotation_of_euler_angles(.1, .2, .3)).log().norm(),
            1e-15);
  Matrix6d information = Eigen::DiagonalMatrix<double, 6>(1, 2, 3, 4, 5, 6);
  information(0, 5) = information(5, 0) = 0.5;  // between x and yaw
  EXPECT_EQ(Matrix6d(edge_of(graph, 0).information), information);
  EXPECT_EQ(edge_of(graph, 0).source, ConstraintSource::kOdometry);
}

class ToroRefuses : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(ToroRefuses, AndSaysWhereAndWhy) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("a.graph", std::string("VERTEX2 0 0 0 0\nVERTEX2 1 1 0 0\n") + GetParam().first);
  EXPECT_THAT(message_of([&] { read_toro(path); }), HasSubstr(GetParam().second));
}

INSTANTIATE_TEST_SUITE_P(
    Faults, ToroRefuses,
    testing::Values(
        std::pair{"VERTEX2 2 0 0", "a.graph:3: VERTEX2: expected 4 numbers, found 3"},
        std::pair{"EDGE2 0 1 1 0 0 1 0 1 1 0", "a.graph:3: EDGE2: expected 11 numbers, found 10"},
        std::pair{"EDGE2 0 1 1 0 0 1 0 1 1 0 x", "a.graph:3: information: 'x' is not a number"},
        std::pair{"EDGE2 0 1 1 0 0 1 9 1 1 0 0", "a.graph:3: the information is indefinite"},
        std::pair{"EDGE2 0 1 1 0 0 0 0 0 0 0 0", "a.graph:3: the information is all zero"},
        std::pair{"EDGE2 0 4 1 0 0 1 0 1 1 0 0", "a.graph:3: there is no vertex 4"},
        std::pair{"VERTEX3 2 0 0 0 0 0 0", "a.graph:3: SE2 and SE3 are mixed"},
        std::pair{"VERTEX3 2 0 0 0 0 0", "a.graph:3: VERTEX3: expected 7 numbers, found 6"},
        std::pair{"EDGE3 0 1 0 0 0 0 0 0 1", "a.graph:3: EDGE3: expected 29 numbers, found 9"},
        std::pair{"EQUIV 0 1", "a.graph:3: 'EQUIV': unknown tag"}));

}  // namespace toro_test
}  // namespace placegraph
