#include <placegraph/pipeline/report/graph_page.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/tables/column.h>
#include "tests/support/report_page.h"

namespace placegraph::report {
namespace graph_page_test {

using nlohmann::json;

TEST(GraphPage, HasPosesConstraintsAndTheirChi2) {
  GraphPage page;
  page.name = "square.g2o";
  for (int i = 0; i < 3; ++i)
    page.before.nodes.push_back({NodeId(10 * i), SE3(SO3(), {1.0 * i, 2, 3})});
  for (const auto& [from, to] : {std::pair{0, 10}, {10, 20}, {20, 0}}) {
    RelativePoseConstraint edge;
    edge.from = NodeId(from);
    edge.to = NodeId(to);
    edge.T_from_to = SE3();
    edge.information = Information::Identity(6, 6);
    edge.source = to == 0 ? ConstraintSource::kLoop : ConstraintSource::kOdometry;
    page.before.constraints.push_back(edge);
  }
  page.after = page.before;
  page.after.nodes[2].T_world_node = SE3(SO3(), {9, 8, 7});
  page.chi2 = {1, 2, 300};
  page.rejected = {2};
  page.figures = {{"chi2", 3.5}};
  const test::TemporaryFolder folder;
  write_graph_page(folder / "page.html", page, "placegraph 1.2.3");
  const json report = test::report_in(folder / "page.html");
  EXPECT_EQ(report["title"], "square.g2o");
  const json& graph = report["graphs"][0];
  EXPECT_EQ(graph["before"], column(std::vector<float>{0, 2, 3, 1, 2, 3, 2, 2, 3}, 3));
  EXPECT_EQ(graph["after"], column(std::vector<float>{0, 2, 3, 1, 2, 3, 9, 8, 7}, 3));
  EXPECT_EQ(graph["edges"], column(std::vector<std::int32_t>{0, 1, 1, 2, 2, 0}, 2));
  EXPECT_EQ(graph["edge_kind"], text_column({"odometry", "odometry", "rejected"}));
  EXPECT_EQ(graph["chi2"], column(std::vector<float>{1, 2, 300}));
  EXPECT_EQ(graph["weight"], column(std::vector<float>{1, 1, 0}));
  EXPECT_EQ(graph["figures"][0]["value"], 3.5);
}

}  // namespace graph_page_test
}  // namespace placegraph::report
