#include <placegraph/graph/pose_graph/rigid_graph.h>
#include <placegraph/io/graphs/g2o.h>
#include <placegraph/io/graphs/parse_graph.h>
#include <placegraph/io/graphs/pose_graph_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace pose_graph_file_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

PoseGraphFormat format_of(const std::string& text) {
  const TemporaryFolder folder;
  TextFile file(folder.write("graph.txt", text));
  return pose_graph_format(file);
}

TEST(PoseGraphFile, IsRecognizedByItsTags) {
  EXPECT_EQ(format_of("# a comment\n\nVERTEX_SE2 0 0 0 0\n"), PoseGraphFormat::kG2o);
  EXPECT_EQ(format_of("PARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n"), PoseGraphFormat::kG2o);
  EXPECT_EQ(format_of("FIX 0\n"), PoseGraphFormat::kG2o);
  EXPECT_EQ(format_of("EDGE2 0 1 ...\nVERTEX2 0 0 0 0\n"), PoseGraphFormat::kToro);
  EXPECT_EQ(format_of("EDGE3 0 1 ...\n\tVERTEX3\n"), PoseGraphFormat::kToro);
  EXPECT_EQ(format_of("EDGE2 0 1 ...\nODOMETRY 0 1 ...\n"), PoseGraphFormat::kIsam);
  EXPECT_EQ(format_of("EDGE3 0 1 ...\nEDGE3 1 2 ...\n"), PoseGraphFormat::kIsam);
}

TEST(PoseGraphFile, IsRefusedWithoutTags) {
  EXPECT_THAT(message_of([] { format_of("EDGE2 0 1\n<xml>\n"); }),
              HasSubstr("graph.txt:2: '<xml>': not a tag"));
  EXPECT_THAT(message_of([] { format_of(std::string("\0\1\xff 1 2\n", 8)); }),
              HasSubstr("graph.txt:1: '\?\?\?': not a tag"));
  EXPECT_THAT(message_of([] { format_of("# nothing\n\n"); }),
              HasSubstr("graph.txt: holds no vertices"));
}

TEST(PoseGraphFile, GivesTheSameGraphInEveryForm) {
  const TemporaryFolder folder;
  const PoseGraph graphs[] = {
      read_pose_graph(folder.write("a",
                                   "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 2 0.5\n"
                                   "EDGE_SE2 0 1 1 2 0.5 4 2 0 10 0 25\n")),
      read_pose_graph(folder.write("b",
                                   "VERTEX2 0 0 0 0\nVERTEX2 1 1 2 0.5\n"
                                   "EDGE2 0 1 1 2 0.5 4 2 10 25 0 0\n")),
      read_pose_graph(folder.write("c", "ODOMETRY 0 1 1 2 0.5 2 1 0 3 0 5\n"))};
  for (const PoseGraph& graph : graphs) {
    ASSERT_EQ(graph.nodes.size(), 2u);
    ASSERT_EQ(graph.constraints.size(), 1u);
    for (int i = 0; i < 2; ++i) {
      EXPECT_EQ(graph.nodes[i].id, NodeId(i));
      EXPECT_EQ(std::get<SE2>(graph.nodes[i].T_world_node).matrix(),
                std::get<SE2>(graphs[0].nodes[i].T_world_node).matrix());
    }
    const auto& edge = std::get<RelativePoseConstraint>(graph.constraints[0]);
    const auto& first = std::get<RelativePoseConstraint>(graphs[0].constraints[0]);
    EXPECT_EQ(std::get<SE2>(edge.T_from_to).matrix(), std::get<SE2>(first.T_from_to).matrix());
    EXPECT_EQ(Eigen::MatrixXd(edge.information), Eigen::MatrixXd(first.information));
    EXPECT_EQ(edge.source, first.source);
  }
}

TEST(PoseGraphFile, IsRefusedInPartsWhereItHasToBeConnected) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.g2o",
                                        "VERTEX_SE2 4 0 0 0\nVERTEX_SE2 5 1 0 0\n"
                                        "VERTEX_SE2 6 1 0 0\nVERTEX_SE2 7 1 0 0\n"
                                        "EDGE_SE2 4 5 1 0 0 1 0 0 1 0 1\n");
  EXPECT_EQ(read_pose_graph(path).nodes.size(), 4u);
  EXPECT_THAT(
      message_of([&] { read_pose_graph(path, {.connected = true}); }),
      HasSubstr("a.g2o:3: vertex 6 is not connected with vertex 4: the graph falls into 3"));
}

TEST(PoseGraphFile, OfPartsThatEachHaveAFixedVertexHangsTogether) {
  const TemporaryFolder folder;
  const std::string parts =
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_SE2 2 5 0 0\nVERTEX_SE2 3 6 0 0\n"
      "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 2 3 1 0 0 1 0 0 1 0 1\nFIX 0\n";
  const std::string one = folder.write("one.g2o", parts),
                    both = folder.write("both.g2o", parts + "FIX 3\n");
  EXPECT_EQ(read_pose_graph(both, {.connected = true}).nodes.size(), 4u);
  EXPECT_THAT(message_of([&] { read_pose_graph(one, {.connected = true}); }),
              HasSubstr("falls into 2 components; --components optimizes each separately"));
}

TEST(PoseGraphFile, OfEdgesAloneChainsItsVertices) {
  const TemporaryFolder folder;
  const auto end_of = [&](const std::string& text) {
    const PoseGraph graph = read_pose_graph(folder.write("a", text));
    EXPECT_EQ(graph.nodes.size(), 3u);
    return position_of(graph.nodes.back().T_world_node);
  };
  EXPECT_EQ(end_of("EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 2 1 2 0 1 0 0 1 0 1\nFIX 0\n"),
            Eigen::Vector3d(2, 2, 0));
  const std::string upper = " 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n";
  EXPECT_EQ(
      end_of("EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1" + upper + "EDGE_SE3:QUAT 1 2 0 0 4 0 0 0 1" + upper),
      Eigen::Vector3d(1, 0, 4));
  // TORO's information of a diagonal matrix has zeros in iSAM's diagonal.
  const PoseGraph toro = read_pose_graph(
      folder.write("b", "EDGE2 0 1 1 0 0 100 0 100 400 0 0\nEDGE2 1 2 1 0 0 100 0 100 400 0 0\n"));
  const auto& edge = std::get<RelativePoseConstraint>(toro.constraints[0]);
  EXPECT_EQ(Eigen::Vector3d(edge.information.diagonal()), Eigen::Vector3d(100, 100, 400));
  EXPECT_THAT(
      message_of([&] { read_pose_graph(folder.write("c", "ODOMETRY 0 1 1 0 0 1 0 0 0 0 1\n")); }),
      HasSubstr("c:1: the root of the information has a zero on its diagonal"));
}

TEST(PoseGraphFile, MayHaveCommentsBehindItsNumbers) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      read_pose_graph(folder.write("a", "\xEF\xBB\xBFVERTEX_SE2 0 0 0 0 # begin\n")).nodes.size(),
      1u);
}

}  // namespace pose_graph_file_test
}  // namespace placegraph
