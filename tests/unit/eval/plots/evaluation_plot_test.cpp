#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/plots/distribution_plot.h>
#include <placegraph/eval/plots/evaluation_plot.h>
#include <placegraph/eval/plots/plot.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>

#include <cmath>
#include <cstdio>

#include "../drawing/svg_check.h"

namespace placegraph {
namespace evaluation_plot_test {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A drive of so many frames from an origin, a turn per 100 of them; the estimate drifts.
Trajectory drive(int frames, const Eigen::Vector3d& origin, double drift_m, bool timed = true) {
  Trajectory trajectory;
  trajectory.has_times = timed;
  for (int i = 0; i < frames; ++i) {
    const double angle = 2 * M_PI * i / 100;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
    T.translation() = origin + Eigen::Vector3d(40 * std::sin(angle) + drift_m * i / 100, 0.01 * i,
                                               40 - 40 * std::cos(angle));
    trajectory.poses.push_back({timed ? i * 100'000'000LL : i, T});
  }
  return trajectory;
}

EvaluationResult evaluated(const std::string& name, double drift_m, int frames = 120,
                           const Eigen::Vector3d& origin = Eigen::Vector3d::Zero(),
                           bool timed = true) {
  EvaluationOptions options;
  options.segments.lengths_m = {50, 100};
  const Trajectory truth = drive(frames, origin, 0, timed);
  return evaluate(truth, drive(frames, origin, drift_m, timed), options, name);
}

std::vector<std::string> texts(const std::vector<EvaluationResult>& results, EvaluationPlot kind,
                               EvaluatedTruth truth = EvaluatedTruth::kShared) {
  const std::string svg = to_svg(figure_of(results, truth, kind));
  test::expect_good_svg(svg);
  return test::texts_of(svg);
}

TEST(EvaluationPlots, AllNameTheAlignmentAndKeepTheirTextsInside) {
  const std::vector<EvaluationResult> results = {evaluated("ours.txt", 1), evaluated("b<&>", 3)};
  for (std::size_t kind = 0; kind < evaluation_plot_names().size(); ++kind) {
    SCOPED_TRACE(evaluation_plot_names()[kind]);
    EXPECT_THAT(texts(results, static_cast<EvaluationPlot>(kind)),
                Contains("aligned by rotation and translation (se3)"));
  }
}

TEST(EvaluationPlots, TheOverviewHasViewsErrorsAndNamesWithoutEndings) {
  const auto found =
      texts({evaluated("ours.txt", 1), evaluated("theirs.tum", 3)}, EvaluationPlot::kOverview);
  for (const char* text : {"from above", "position error over the distance",
                           "position error over time", "distance travelled [m]", "time [s]",
                           "x [m]", "z [m]", "start", "ground truth", "2 estimates"})
    EXPECT_THAT(found, Contains(text));
  EXPECT_THAT(found, Contains("from the side"));
  EXPECT_THAT(found, Contains(StartsWith("y [m], stretched ")));
  EXPECT_THAT(found, Contains(StartsWith("ours: ATE ")));
  EXPECT_THAT(found, Contains(StartsWith("theirs: ATE ")));
}

TEST(EvaluationPlots, ASingleEstimateIsColouredByItsError) {
  const Plot one = plot_of({evaluated("a", 1)});
  ASSERT_EQ(one.curves.size(), 2u);
  EXPECT_EQ(one.curves[1].error_m.size(), one.curves[1].positions_m.size());
  EXPECT_TRUE(figure_of(one).panels[0].scale);
  const Plot two = plot_of({evaluated("a", 1), evaluated("b", 1)});
  EXPECT_TRUE(two.curves[1].error_m.empty());
  EXPECT_FALSE(figure_of(two).panels[0].scale);
}

TEST(EvaluationPlots, SequencesHaveAPanelEachWithTheirOwnTruth) {
  std::vector<EvaluationResult> results;
  for (const char* name : {"00", "05", "06", "07", "08"}) results.push_back(evaluated(name, 2));
  const Figure figure = figure_of(results, EvaluatedTruth::kOwn, EvaluationPlot::kOverview);
  EXPECT_EQ(figure.panels.size(), 5u);
  for (const FigurePanel& panel : figure.panels) EXPECT_THAT(panel.heading, HasSubstr(": ATE "));
  const auto found = texts(results, EvaluationPlot::kOverview, EvaluatedTruth::kOwn);
  EXPECT_THAT(found, Contains("5 sequences"));
  EXPECT_EQ(std::ranges::count(found, "ground truth"), 1);
  for (const EvaluationPlot kind : {EvaluationPlot::kXyz, EvaluationPlot::kRpy})
    EXPECT_THROW((void)figure_of(results, EvaluatedTruth::kOwn, kind), ArgumentError);
  EXPECT_THAT(texts(results, EvaluationPlot::kBox, EvaluatedTruth::kOwn), Contains("07"));
}

TEST(EvaluationPlots, TimeIsInFramesIfThereAreNoTimes) {
  const std::vector<EvaluationResult> results = {evaluated("a", 1, 120, {0, 0, 0}, false)};
  EXPECT_THAT(texts(results, EvaluationPlot::kXyz), Contains("frame"));
  EXPECT_THAT(texts(results, EvaluationPlot::kOverview), Not(Contains("time [s]")));
}

TEST(EvaluationPlots, AnglesOfAnEstimateStayBesideTheTrueOnes) {
  const Figure figure =
      figure_of({evaluated("a", 1, 320)}, EvaluatedTruth::kShared, EvaluationPlot::kRpy);
  ASSERT_EQ(figure.panels.size(), 3u);
  for (const FigurePanel& panel : figure.panels) {
    const auto& truth = std::get<FigureLine>(panel.shapes[0]).points;
    const auto& estimate = std::get<FigureLine>(panel.shapes[1]).points;
    ASSERT_EQ(truth.size(), estimate.size());
    for (std::size_t i = 0; i < truth.size(); ++i)
      EXPECT_LT(std::abs((*truth[i])[1] - (*estimate[i])[1]), 180.1);
  }
}

TEST(EvaluationPlots, TakeHardData) {
  // Coordinates of a map projection; two frames; a perfect estimate.
  texts({evaluated("utm", 1, 120, {412345, 5412345, 310})}, EvaluationPlot::kOverview);
  texts({evaluated("short", 0.1, 3)}, EvaluationPlot::kOverview);
  const auto found = texts({evaluated("perfect", 0)}, EvaluationPlot::kOverview);
  for (const std::string& text : found) EXPECT_THAT(text, Not(HasSubstr("e-")));
  std::vector<EvaluationResult> many;
  for (int i = 0; i < 20; ++i)
    many.push_back(evaluated("a_long_name_of_an_estimate_in_a_study_" + std::to_string(i), i));
  for (const EvaluationPlot kind : {EvaluationPlot::kOverview, EvaluationPlot::kViolin})
    EXPECT_THAT(texts(many, kind), Contains(HasSubstr("study_19")));
  EXPECT_THROW((void)figure_of({}, EvaluatedTruth::kShared, EvaluationPlot::kBox), ArgumentError);
}

TEST(EvaluationPlots, LengthsNeedASegment) {
  EXPECT_THROW(
      (void)figure_of({evaluated("a", 1, 5)}, EvaluatedTruth::kShared, EvaluationPlot::kLengths),
      ArgumentError);
}

TEST(Distributions, HaveQuartilesAndWhiskersOfTukey) {
  Figure figure;
  draw_boxes({{"a", {1, 2, 3, 4, 5, 6, 7, 8, 9, 100}}}, "error [m]", figure);
  std::vector<double> ends;  // of horizontal lines: whiskers and the sides of the box
  for (const FigureShape& shape : figure.panels.at(0).shapes)
    if (const auto* line = std::get_if<FigureLine>(&shape))
      for (const auto& p : line->points) ends.push_back((*p)[0]);
  EXPECT_EQ(*std::ranges::min_element(ends), 1);
  EXPECT_EQ(*std::ranges::max_element(ends), 9);  // 100 is no part of a whisker
  EXPECT_THAT(ends, Contains(3.25));
  EXPECT_THAT(ends, Contains(7.75));
  EXPECT_THAT(ends, Contains(5.5));
  EXPECT_GT(figure.panels[0].x.range.max, 100);
  EXPECT_THROW(draw_boxes({{"a", {}}}, "error [m]", figure), ArgumentError);
}

TEST(Distributions, AViolinIsWidestWhereMostValuesAre) {
  Figure figure;
  std::vector<double> values(200, 2.0);
  for (int i = 0; i < 50; ++i) values.push_back(0.1 * i);
  draw_violins({{"a", values}, {"one", {3}}}, "error [m]", figure);
  const auto& ring = std::get<FigureArea>(figure.panels.at(0).shapes.at(0)).rings.at(0);
  const auto widest = std::ranges::min_element(ring, {}, [](const auto& p) { return p[1]; });
  EXPECT_NEAR((*widest)[0], 2, 0.2);
  test::expect_good_svg(to_svg(figure));
}

/// A drive in the plane of x and y, which a map of the ground shows.
EvaluationResult level_result() {
  Trajectory truth = drive(120, Eigen::Vector3d::Zero(), 0);
  for (StampedPose& pose : truth.poses) {
    const Eigen::Vector3d p = pose.T_world_body->translation();
    pose.T_world_body->translation() = Eigen::Vector3d(p[0], p[2], p[1]);
  }
  return evaluate(truth, truth, {}, "ours");
}

GroundPicture ground() {
  GroundPicture picture;
  picture.name = "map.yaml";
  picture.source = "data:image/png;base64,AAAA";
  picture.columns = 4;
  picture.rows = 2;
  picture.corner_m = {-50, 100};
  picture.right_m = {30, 0};
  picture.down_m = {0, -60};
  return picture;
}

TEST(EvaluationPlots, AMapLiesUnderTheViewFromAbove) {
  const EvaluationResult result = level_result();
  const Figure figure = figure_of({result}, EvaluatedTruth::kShared, EvaluationPlot::kOverview,
                                  ground()),
               without = figure_of({result}, EvaluatedTruth::kShared, EvaluationPlot::kOverview);
  ASSERT_TRUE(std::holds_alternative<FigurePicture>(figure.panels[0].shapes.front()));
  EXPECT_THAT(figure.notes, Contains("map below: map.yaml"));
  // What the panel shows stays; the picture stands where its corners are.
  EXPECT_EQ(figure.panels[0].x.range.min, without.panels[0].x.range.min);
  for (std::size_t i = 1; i < figure.panels.size(); ++i)
    for (const FigureShape& shape : figure.panels[i].shapes)
      EXPECT_FALSE(std::holds_alternative<FigurePicture>(shape));
  const std::string svg = to_svg(figure);
  test::expect_good_svg(svg);
  const std::size_t at = svg.find("<image ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_LT(at, svg.find("<polyline", svg.find("<g clip-path")));
  const std::string matrix = test::attribute(svg.substr(at, svg.find('>', at) - at), "transform");
  double a = 0, b = 0, c = 0, d = 0, e = 0, f = 0;
  ASSERT_EQ(std::sscanf(matrix.c_str(), "matrix(%lf %lf %lf %lf %lf %lf)", &a, &b, &c, &d, &e, &f),
            6);
  const FigurePanel& panel = figure.panels[0];
  const double px_per_m = panel.size[0] / panel.x.range.size();
  EXPECT_NEAR(a, 30 * px_per_m, 1e-4);
  EXPECT_NEAR(d, 60 * px_per_m, 1e-4);  // y of the picture points down
  EXPECT_NEAR(b, 0, 1e-9);
  EXPECT_NEAR(e, panel.corner[0] + (-50 - panel.x.range.min) * px_per_m, 1e-2);
}

TEST(EvaluationPlots, AMapOfOtherAxesOrElsewhereIsRefused) {
  const auto message = [](const EvaluationResult& result, const GroundPicture& picture,
                          EvaluationPlot kind = EvaluationPlot::kOverview) {
    try {
      (void)figure_of({result}, EvaluatedTruth::kShared, kind, picture);
    } catch (const ArgumentError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(evaluated("ours", 1), ground()),
              HasSubstr("is a map of x and y, and the view from above shows x and z"));
  GroundPicture far = ground();
  far.corner_m = {5000, 100};
  EXPECT_THAT(message(level_result(), far), HasSubstr("the drive lies elsewhere"));
  EXPECT_THAT(message(level_result(), ground(), EvaluationPlot::kBox),
              HasSubstr("under the overview of one sequence"));
}

}  // namespace evaluation_plot_test
}  // namespace placegraph
