#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/drawing/label_room.h>
#include <placegraph/eval/plots/growth_plot.h>
#include <placegraph/eval/plots/pose_graph_plot.h>
#include <placegraph/graph/core/error.h>

#include "../drawing/svg_check.h"

namespace placegraph {
namespace graph_plots_test {

using testing::HasSubstr;
using testing::Not;

/// Poses 0 .. 3 along x, odometry but between 1 and 2, loops 0 -> 2 and 0 -> 3.
PoseGraph chain(double step_m) {
  PoseGraph graph;
  for (int i = 0; i < 4; ++i) graph.nodes.push_back({NodeId(i), SE2(step_m * i, 0, 0), false});
  for (const auto& [from, to] : {std::pair{0, 1}, {2, 3}, {0, 2}, {0, 3}}) {
    RelativePoseConstraint edge;
    edge.from = NodeId(from);
    edge.to = NodeId(to);
    edge.T_from_to = SE2();
    edge.information = Eigen::Matrix3d::Identity();
    edge.source = to == from + 1 ? ConstraintSource::kOdometry : ConstraintSource::kLoop;
    graph.constraints.emplace_back(edge);
  }
  return graph;
}

TEST(PoseGraphPlot, HasGapsWhereNoOdometryLeadsAndLinksOfTheOptimizedPoses) {
  const Plot plot = plot_of(chain(1), chain(2), {3});
  ASSERT_EQ(plot.curves.size(), 2u);
  EXPECT_TRUE(plot.curves[0].reference);
  for (const PlotCurve& curve : plot.curves) {
    ASSERT_EQ(curve.positions_m.size(), 5u);
    EXPECT_FALSE(curve.positions_m[2]);
  }
  EXPECT_EQ(*plot.curves[0].positions_m[4], Eigen::Vector3d(3, 0, 0));
  EXPECT_EQ(*plot.curves[1].positions_m[4], Eigen::Vector3d(6, 0, 0));
  ASSERT_EQ(plot.links_m.size(), 1u);
  EXPECT_EQ(plot.links_m[0].second, Eigen::Vector3d(4, 0, 0));
  ASSERT_EQ(plot.rejected_links_m.size(), 1u);
  EXPECT_EQ(plot.rejected_links_m[0].second, Eigen::Vector3d(6, 0, 0));
}

TEST(PoseGraphPlot, NamesLoopsAndRejectedOnesInItsLegend) {
  const std::string some = to_svg(plot_of(chain(1), chain(2), {3}));
  EXPECT_THAT(some, HasSubstr(">1 loop closure<"));
  EXPECT_THAT(some, HasSubstr(">1 rejected<"));
  EXPECT_THAT(to_svg(plot_of(chain(1), chain(2), {})), Not(HasSubstr("rejected")));
}

TEST(PoseGraphPlot, ShowsAGraphInSpaceFromTheSideToo) {
  EXPECT_EQ(figure_of(plot_of(chain(1), chain(2), {})).panels.size(), 1u);
  PoseGraph climbing = chain(1);
  for (PoseNode& node : climbing.nodes) {
    const double x = std::get<SE2>(node.T_world_node).translation().x();
    node.T_world_node = SE3(SO3(), {x, 0.5 * x * x, 0.3 * x});
  }
  const Figure figure = figure_of(plot_of(climbing, climbing, {}));
  ASSERT_EQ(figure.panels.size(), 2u);
  EXPECT_THAT(figure.panels[1].heading, HasSubstr("from the side"));
  test::expect_good_svg(to_svg(figure));
}

TEST(PoseGraphPlot, DrawsLoopsBelowTheEstimate) {
  const Figure figure = figure_of(plot_of(chain(1), chain(2), {}));
  std::vector<Colour> order;
  for (const FigureShape& shape : figure.panels.at(0).shapes)
    if (const auto* line = std::get_if<FigureLine>(&shape); line && !line->points.empty())
      order.push_back(line->stroke.colour);
  ASSERT_EQ(order.size(), 3u);  // before, loops, after
  EXPECT_EQ(order[1], (Colour{0, 158, 115}));
}

TEST(PoseGraphPlot, HasNoMetresIfTheGraphHasScales) {
  EXPECT_THAT(to_svg(plot_of(chain(1), chain(2), {})), HasSubstr(" [m]<"));
  PoseGraph scaled = chain(1);
  for (PoseNode& node : scaled.nodes)
    node.T_world_node = Sim3(SO3(), {std::get<SE2>(node.T_world_node).translation().x(), 0, 0}, 1);
  const std::string svg = to_svg(plot_of(scaled, scaled, {}));
  EXPECT_THAT(svg, HasSubstr(" [units]<"));
  EXPECT_THAT(svg, Not(HasSubstr(" [m]<")));
}

TEST(LabelRoom, PlacesLabelsBesidePointsWithoutOverlap) {
  LabelRoom room({0, 0}, {300, 200});
  const Eigen::Vector2d point(150, 100), size(24, 10);
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < 20; ++i) {
    const auto corner = room.place_beside(point, size);
    if (!corner) break;
    for (const Eigen::Vector2d& other : corners)
      EXPECT_TRUE(((*corner - other).cwiseAbs().array() >= size.array()).any());
    EXPECT_LT((*corner + 0.5 * size - point).norm(), 30);
    corners.push_back(*corner);
  }
  EXPECT_GE(corners.size(), 4u);
  EXPECT_LE(corners.size(), 8u);
}

TEST(LabelRoom, KeepsLabelsOffLinesAndInThePanel) {
  const Eigen::Vector2d size(24, 10);
  LabelRoom room({0, 0}, {300, 200});
  for (double y = 80; y <= 120; y += 3) room.occupy_line({0, y}, {300, y});
  EXPECT_FALSE(room.place_beside({150, 100}, size));
  EXPECT_TRUE(room.place_beside({150, 40}, size));
  const auto corner = room.place_beside({299, 1}, size);  // at the upper right corner
  ASSERT_TRUE(corner);
  EXPECT_LE(corner->x() + size.x(), 300);
  EXPECT_GE(corner->y(), 0);
  room.occupy({0, 150}, {300, 50});
  EXPECT_FALSE(room.place_beside({150, 180}, size));
}

TEST(PlotPlaces, AreNumberedWhereThereIsRoom) {
  Plot plot = plot_of(chain(1), chain(2), {});
  for (int i = 0; i < 40; ++i) {
    plot.places_m.emplace_back(2, 1e-3 * i, 0);  // all at one pixel
    plot.place_names.push_back("place" + std::to_string(i));
  }
  plot.places_m.emplace_back(5, 0, 0);
  plot.place_names.emplace_back("alone");
  const std::string svg = to_svg(plot);
  EXPECT_THAT(svg, HasSubstr(">place0<"));
  EXPECT_THAT(svg, HasSubstr(">alone<"));
  EXPECT_THAT(svg, Not(HasSubstr(">place39<")));
}

GrowthPlot growth() {
  return {"how it grows",
          "poses",
          {{"CPU [s]", {{"grid", {1000, 10000, 100000}, {0.1, 1.2, 15}}}},
           {"memory [MB]", {{"process", {1000, 10000}, {20, 150}}, {"factor", {1000}, {9}}}}}};
}

TEST(GrowthPlot, DrawsEveryPanelAndCurveWithItsName) {
  const std::string svg = to_svg(growth());
  for (const char* text : {"how it grows", ">poses<", "CPU [s]", "memory [MB]", ">grid<",
                           ">process<", ">factor<", ">in proportion<", ">100000<"})
    EXPECT_THAT(svg, HasSubstr(text));
  test::expect_good_svg(svg);
}

TEST(GrowthPlot, RefusesWhatHasNoLogarithm) {
  GrowthPlot plot = growth();
  plot.panels[0].curves[0].values[1] = 0;
  EXPECT_THROW(to_svg(plot), ArgumentError);
  plot = growth();
  plot.panels[0].curves[0].values.pop_back();
  EXPECT_THROW(to_svg(plot), ArgumentError);
  plot.panels.clear();
  EXPECT_THROW(to_svg(plot), ArgumentError);
}

}  // namespace graph_plots_test
}  // namespace placegraph
