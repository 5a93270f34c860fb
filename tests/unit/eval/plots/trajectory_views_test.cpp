#include <gtest/gtest.h>
#include <placegraph/eval/drawing/plot_style.h>
#include <placegraph/eval/plots/trajectory_views.h>

#include <array>
#include <cmath>

#include "tests/support/seed.h"

namespace placegraph {
namespace trajectory_views_test {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A curve that fills a box of these sides, lost now and then.
PlotCurve curve_in(const Vector3d& sides, Random& random, bool reference) {
  PlotCurve curve{"a curve", {}, reference};
  for (int i = 0; i < 60; ++i) {
    const Vector3d p(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                     random.uniform(-0.5, 0.5));
    curve.positions_m.emplace_back(p.cwiseProduct(sides));
    if (i % 7 == 3) curve.positions_m.back().reset();
  }
  return curve;
}

/// Whether all points of the lines and dots of a panel lie in its ranges.
void expect_all_shown(const FigurePanel& panel) {
  const auto shown = [&](const Vector2d& p) {
    return p[0] >= panel.x.range.min && p[0] <= panel.x.range.max && p[1] >= panel.y.range.min &&
           p[1] <= panel.y.range.max;
  };
  for (const FigureShape& shape : panel.shapes) {
    if (const auto* line = std::get_if<FigureLine>(&shape)) {
      for (const auto& p : line->points) EXPECT_TRUE(!p || shown(*p));
    } else if (const auto* dots = std::get_if<FigureDots>(&shape)) {
      for (const Vector2d& p : dots->points) EXPECT_TRUE(shown(p));
    }
  }
}

TEST(TrajectoryViews, ShowAllThatIsDrawnAndTheViewFromAboveInEqualScale) {
  Random random = test::seeded_random(14);
  for (int trial = 0; trial < 60; ++trial) {
    Vector3d sides;
    for (double& side : sides) side = std::pow(10, random.uniform(-1, 3));
    Plot plot;
    plot.curves = {curve_in(sides, random, true), curve_in(1.5 * sides, random, false)};
    const Vector2d most(900, 640);
    const TrajectoryViews views = trajectory_views(plot, most);
    const FigurePanel& above = views.above;
    EXPECT_NEAR(above.x.range.size() / above.size[0], above.y.range.size() / above.size[1], 1e-9);
    EXPECT_TRUE((above.size.array() <= most.array() + 1e-9).all());
    expect_all_shown(above);
    ASSERT_TRUE(views.side);
    expect_all_shown(*views.side);
    for (const FigurePanel* panel : {&above, &*views.side}) {
      EXPECT_LE(panel->corner[0] + panel->size[0] + kRightMargin, views.width_px + 1e-9);
      EXPECT_LE(panel->corner[1] + panel->size[1] + kBottomMargin, views.height_px + 1e-9);
    }
    const bool below = views.side->corner[0] == above.corner[0];
    const Interval &shared = below ? views.side->x.range : views.side->y.range,
                   &own = below ? above.x.range : above.y.range;
    EXPECT_EQ(shared.min, own.min);
    EXPECT_EQ(shared.max, own.max);
  }
}

TEST(TrajectoryViews, TheAxesAreThoseOfTheLargestExtent) {
  Random random = test::seeded_random(15);
  const std::array<std::pair<int, int>, 3> without = {{{1, 2}, {0, 2}, {0, 1}}};
  for (int least = 0; least < 3; ++least) {
    Vector3d sides(20, 20, 20);
    sides[least] = 1;
    EXPECT_EQ(top_view_axes(curve_in(sides, random, true).positions_m),
              without[static_cast<std::size_t>(least)]);
  }
  // Straight ahead and uphill: the narrow x is shown nevertheless.
  EXPECT_EQ(top_view_axes(curve_in({0.5, 3, 50}, random, true).positions_m), std::pair(0, 2));
}

TEST(TrajectoryViews, TheReferenceChoosesTheAxesWhereverItStands) {
  Random random = test::seeded_random(16);
  Plot plot;
  plot.curves = {curve_in({9, 9, 1}, random, false), curve_in({9, 1, 9}, random, true)};
  EXPECT_EQ(view_from_above(plot, {300, 300}).y.label, "z [m]");
  plot.curves[1].reference = false;
  EXPECT_EQ(view_from_above(plot, {300, 300}).y.label, "y [m]");
}

TEST(TrajectoryViews, ColoursCountTheEstimatesAlone) {
  Plot plot;
  for (const bool reference : {false, true, false, false})
    plot.curves.push_back({"", {}, reference});
  const std::vector<Stroke> strokes = curve_strokes(plot);
  ASSERT_EQ(strokes.size(), 4u);
  EXPECT_EQ(strokes[0].colour, curve_stroke(0).colour);
  EXPECT_EQ(strokes[1].colour, kReference);
  EXPECT_EQ(strokes[2].colour, curve_stroke(1).colour);
  EXPECT_EQ(strokes[3].colour, curve_stroke(2).colour);
}

TEST(TrajectoryViews, AnErrorIsColouredByItsShareOfTheLargest) {
  Plot plot;
  plot.curves = {{"a", {Vector3d(0, 0, 0), Vector3d(1, 0, 1), Vector3d(2, 0, 3)}}};
  plot.curves[0].error_m = {0.1, 0, 0.4};
  const FigurePanel panel = view_from_above(plot, {300, 300});
  ASSERT_TRUE(panel.scale);
  EXPECT_EQ(panel.scale->range.max, 0.4);
  for (const FigureShape& shape : panel.shapes)
    if (const auto* line = std::get_if<FigureLine>(&shape); line && !line->shares.empty()) {
      EXPECT_EQ(line->shares, (std::vector<double>{0.25, 0, 1}));
    }
}

}  // namespace trajectory_views_test
}  // namespace placegraph
