#include <placegraph/io/graphs/g2o.h>

#include "tests/support/data.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace g2o_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

const std::string kPlanar =
    "# two poses\n"
    "VERTEX_SE2 5 0 0 0\n"
    "VERTEX_SE2 6 1 2 1.5707963267948966\n"
    "PARAMS_SE2OFFSET 0 0 0 0\n"
    "EDGE_SE2 5 6 1 2 1.5 4 1 0.5 3 0.25 2\n"
    "FIX 5\n";
const std::string kSpatial =
    "EDGE_SE3:QUAT 0 7 1 2 3 0 0 0.70710678118654757 0.70710678118654757 "
    "1 0 0 0 0 .5 2 0 0 0 0 3 0 0 0 4 0 0 5 0 6\n"
    "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n"
    "VERTEX_SE3:QUAT 7 1 2 3 0 0 0.70710678118654757 0.70710678118654757\n";

TEST(G2o, ReadsAPlanarGraph) {
  const TemporaryFolder folder;
  const PoseGraph graph = read_g2o(folder.write("a.g2o", kPlanar));
  ASSERT_EQ(graph.nodes.size(), 2u);
  EXPECT_EQ(graph.kind(), PoseKind::kSE2);
  EXPECT_EQ(graph.nodes[0].id, NodeId(5));
  EXPECT_TRUE(graph.nodes[0].fixed);
  EXPECT_FALSE(graph.nodes[1].fixed);
  // T_world_node: a point one metre ahead of node 6, which looks along world y.
  const Eigen::Vector2d p_world =
      std::get<SE2>(graph.nodes[1].T_world_node) * Eigen::Vector2d(1, 0);
  EXPECT_LT((p_world - Eigen::Vector2d(1, 3)).norm(), 1e-15);
  const auto& edge = std::get<RelativePoseConstraint>(graph.constraints.at(0));
  EXPECT_EQ(edge.from, NodeId(5));
  EXPECT_EQ(edge.to, NodeId(6));
  EXPECT_EQ(edge.source, ConstraintSource::kOdometry);
  EXPECT_DOUBLE_EQ(std::get<SE2>(edge.T_from_to).rotation().angle(), 1.5);
  Eigen::Matrix3d information;
  information << 4, 1, 0.5, 1, 3, 0.25, 0.5, 0.25, 2;
  EXPECT_EQ(Eigen::Matrix3d(edge.information), information);
}

TEST(G2o, ReadsASpatialGraphWhoseEdgesComeFirst) {
  const TemporaryFolder folder;
  const PoseGraph graph = read_g2o(folder.write("a.g2o", kSpatial));
  EXPECT_EQ(graph.kind(), PoseKind::kSE3);
  const Eigen::Vector3d p_world =
      std::get<SE3>(graph.nodes[1].T_world_node) * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((p_world - Eigen::Vector3d(1, 3, 3)).norm(), 1e-15);  // turned by 90 degrees about z
  const auto& edge = std::get<RelativePoseConstraint>(graph.constraints.at(0));
  EXPECT_EQ(edge.source, ConstraintSource::kLoop);
  Matrix6d information = Eigen::DiagonalMatrix<double, 6>(1, 2, 3, 4, 5, 6);
  information(0, 5) = information(5, 0) = 0.5;  // between translation x and rotation z
  EXPECT_EQ(Matrix6d(edge.information), information);
}

TEST(G2o, TakesTheNextLargerIdForTheNextWhereHardlyAnEdgeJoinsConsecutiveOnes) {
  const TemporaryFolder folder;
  const auto sources = [&](int gap, int nodes) {
    std::string text;
    for (int i = nodes - 1; i >= 0; --i)  // ids need not ascend
      text += "VERTEX_SE2 " + std::to_string(gap * i) + " 0 0 0\n";
    const auto edge = [&](int from, int to) {
      text += "EDGE_SE2 " + std::to_string(gap * from) + " " + std::to_string(gap * to) +
              " 1 0 0 1 0 0 1 0 1\n";
    };
    for (int i = 0; i + 1 < nodes; ++i) edge(i + i % 2, i + 1 - i % 2);  // forth and back in turn
    edge(0, 2);
    std::vector<ConstraintSource> result;
    for (const Constraint& constraint : read_g2o(folder.write("a.g2o", text)).constraints)
      result.push_back(std::get<RelativePoseConstraint>(constraint).source);
    return result;
  };
  std::vector<ConstraintSource> expected(19, ConstraintSource::kOdometry);
  expected.push_back(ConstraintSource::kLoop);
  EXPECT_EQ(sources(1, 20), expected);
  EXPECT_EQ(sources(7, 20), expected);
  // Too few to tell.
  EXPECT_EQ(sources(7, 3), std::vector<ConstraintSource>(3, ConstraintSource::kLoop));
}

TEST(G2o, KeepsInformationThatFixesLessThanAllDirections) {
  const TemporaryFolder folder;
  std::string text = kPlanar;
  text.replace(text.find("4 1 0.5 3 0.25 2"), 16, "0 0 0 0 0 2");
  EXPECT_EQ(std::get<RelativePoseConstraint>(read_g2o(folder.write("a", text)).constraints[0])
                .information(2, 2),
            2);
}

TEST(G2o, ReadsSimilaritiesAsLogarithmsWithTheRotationFirst) {
  const TemporaryFolder folder;
  std::string edge = "EDGE_SIM3:EXPMAP 0 1 0 0 0.1 1 2 3 0.2";
  for (int row = 0; row < 7; ++row)  // 1 .. 7, and 0.5 between w_x and t_x, w_x and the scale
    for (int column = row; column < 7; ++column)
      edge += row == column                              ? " " + std::to_string(row + 1)
              : row == 0 && (column == 3 || column == 6) ? " 0.5"
                                                         : " 0";
  const PoseGraph graph = read_g2o(
      folder.write("a.g2o",
                   "VERTEX_SIM3:EXPMAP 0 0 0 0 0 0 0 0 500 500 320 240\n"
                   "VERTEX_SIM3:EXPMAP 1 0 0 1.5707963267948966 0 0 0 0.69314718055994529\n" +
                       edge));
  EXPECT_EQ(graph.kind(), PoseKind::kSim3);
  // A turn by 90 degrees about z that doubles lengths.
  const Eigen::Vector3d p_world =
      std::get<Sim3>(graph.nodes[1].T_world_node) * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((p_world - Eigen::Vector3d(0, 2, 0)).norm(), 1e-15);
  const auto& read = std::get<RelativePoseConstraint>(graph.constraints.at(0));
  Vector7d xi;
  xi << 1, 2, 3, 0, 0, 0.1, 0.2;
  EXPECT_LT((std::get<Sim3>(read.T_from_to).log() - xi).norm(), 1e-14);
  Vector7d diagonal;
  diagonal << 4, 5, 6, 1, 2, 3, 7;
  Matrix7d information = diagonal.asDiagonal();
  information(3, 0) = information(0, 3) = information(3, 6) = information(6, 3) = 0.5;
  EXPECT_EQ(Matrix7d(read.information), information);
}

class G2oRefuses : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(G2oRefuses, AndSaysWhereAndWhy) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.g2o", kPlanar + GetParam().first);
  EXPECT_THAT(message_of([&] { read_g2o(path); }), HasSubstr(GetParam().second));
}

INSTANTIATE_TEST_SUITE_P(
    Faults, G2oRefuses,
    testing::Values(
        std::pair{"EDGE_SE2 5 6 1 2", "a.g2o:7: EDGE_SE2: expected 11 numbers, found 4"},
        std::pair{"VERTEX_SE2 7 0 0", "a.g2o:7: VERTEX_SE2: expected 4 numbers, found 3"},
        std::pair{"VERTEX_SE2 7 0 0 0 0", "a.g2o:7: VERTEX_SE2: expected 4 numbers, found 5"},
        std::pair{"VERTEX_SE2 7 0 nan 0", "a.g2o:7: y: 'nan' is not finite"},
        std::pair{"VERTEX_SE2 7 0 0 ten", "a.g2o:7: theta: 'ten' is not a number"},
        std::pair{"VERTEX_SE2 7.5 0 0 0", "a.g2o:7: id: '7.5' is not an integer"},
        std::pair{"VERTEX_SE2 99999999999999999999 0 0 0", "a.g2o:7: id: "},
        std::pair{"VERTEX_SE2 6 0 0 0", "a.g2o:7: vertex 6 is there twice"},
        std::pair{"VERTEX_SE3:QUAT 7 0 0 0 0 0 0 1", "a.g2o:7: SE2 and SE3 are mixed"},
        std::pair{"VERTEX_SE3:QUAT 7 0 0 0 0 0 0 0", "a.g2o:7: the quaternion has length 0"},
        std::pair{"VERTEX_SIM3:EXPMAP 7 0 0 0 0 0 0 0", "a.g2o:7: SE2 and Sim3 are mixed"},
        std::pair{"VERTEX_SIM3:EXPMAP 7 0 0 0 0 0 0", "a.g2o:7: VERTEX_SIM3:EXPMAP: expected 8"},
        std::pair{"VERTEX_SIM3:EXPMAP 7 0 0 0 0 0 0 999", "a.g2o:7: the logarithm of the scale"},
        std::pair{"EDGE_SE2 5 6 1 2 1 1e300 2e300 0 1e300 0 1", "the information is indefinite"},
        std::pair{"VERTEX_XY 7 0 0", "a.g2o:7: the graph has priors or point landmarks"},
        std::pair{"EDGE_SE2 5 5 1 2 1 1 0 0 1 0 1", "a.g2o:7: an edge from 5 to itself"},
        std::pair{"\nEDGE_SE2 5 9 1 2 1 1 0 0 1 0 1", "a.g2o:8: there is no vertex 9"},
        std::pair{"EDGE_SE2 5 6 1 2 1 1 2 0 1 0 1", "a.g2o:7: the information is indefinite"},
        std::pair{"EDGE_SE2 5 6 1 2 1 -1 0 0 -1 0 -1", "a.g2o:7: the information is indefinite"},
        std::pair{"EDGE_SE2 5 6 1 2 1 0 0 0 0 0 0", "a.g2o:7: the information is all zero"},
        std::pair{"EDGE_SE2 5 6 1 2 1 inf 0 0 1 0 1", "a.g2o:7: information: 'inf' is not finite"},
        std::pair{"FIX 12", "a.g2o:7: there is no vertex 12"},
        std::pair{"FIX", "a.g2o:7: FIX: expected an id"}));

TEST(G2o, RefusesWhatIsMissingOrHasNoVertices) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of([&] { read_g2o(folder / "none.g2o"); }), HasSubstr("none.g2o: "));
  const std::string empty = folder.write("empty.g2o", "# nothing\n");
  EXPECT_THAT(message_of([&] { read_g2o(empty); }), HasSubstr("empty.g2o: holds no vertices"));
}

TEST(G2o, IsNotWrittenForWhatItHasNoFormFor) {
  const TemporaryFolder folder;
  PoseGraph graph;
  graph.nodes = {{NodeId(0), SE3(), false}};
  graph.constraints.emplace_back(PositionConstraint{});
  EXPECT_THROW(write_g2o(folder / "a", graph), ArgumentError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
}

struct RealGraph {
  const char* file;
  PoseKind kind;
  std::size_t nodes, edges;
};

class RealG2o : public testing::TestWithParam<RealGraph> {};

TEST_P(RealG2o, HasTheDocumentedCountsAndIsConnected) {
  PLACEGRAPH_DATA_OR_SKIP(path, std::string("posegraphs/") + GetParam().file);
  const PoseGraph graph = read_g2o(path);
  EXPECT_EQ(graph.kind(), GetParam().kind);
  EXPECT_EQ(graph.nodes.size(), GetParam().nodes);
  EXPECT_EQ(graph.constraints.size(), GetParam().edges);
  graph.check();
  for (const int component : graph.components()) ASSERT_EQ(component, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Data, RealG2o,
    testing::Values(RealGraph{"intel.g2o", PoseKind::kSE2, 1728, 2512},
                    RealGraph{"M3500.g2o", PoseKind::kSE2, 3500, 5453},
                    RealGraph{"kitti_00.g2o", PoseKind::kSE2, 4541, 4677},
                    RealGraph{"kitti_05.g2o", PoseKind::kSE2, 2761, 2826},
                    RealGraph{"city10000.g2o", PoseKind::kSE2, 10000, 20687},
                    RealGraph{"tinyGrid3D.g2o", PoseKind::kSE3, 9, 11},
                    RealGraph{"smallGrid3D.g2o", PoseKind::kSE3, 125, 297},
                    RealGraph{"sphere2500.g2o", PoseKind::kSE3, 2500, 4949},
                    RealGraph{"torus3D.g2o", PoseKind::kSE3, 5000, 9048},
                    RealGraph{"parking-garage.g2o", PoseKind::kSE3, 1661, 6275},
                    RealGraph{"outliers/intel_out10.g2o", PoseKind::kSE2, 1728, 2522},
                    RealGraph{"outliers/intel_out100.g2o", PoseKind::kSE2, 1728, 2612},
                    RealGraph{"outliers/intel_out1000.g2o", PoseKind::kSE2, 1728, 3512},
                    RealGraph{"outliers/kitti_00_out10.g2o", PoseKind::kSE2, 4541, 4687},
                    RealGraph{"outliers/kitti_00_out100.g2o", PoseKind::kSE2, 4541, 4777},
                    RealGraph{"outliers/kitti_00_out1000.g2o", PoseKind::kSE2, 4541, 5677},
                    RealGraph{"outliers/sphere2500_out10.g2o", PoseKind::kSE3, 2500, 4959},
                    RealGraph{"outliers/sphere2500_out100.g2o", PoseKind::kSE3, 2500, 5049},
                    RealGraph{"outliers/sphere2500_out1000.g2o", PoseKind::kSE3, 2500, 5949}),
    [](const auto& test) {
      std::string name = test.param.file;
      for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
      }
      return name;
    });

}  // namespace g2o_test
}  // namespace placegraph
