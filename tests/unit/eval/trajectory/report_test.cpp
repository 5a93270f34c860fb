#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/eval/plots/evaluation_plot.h>
#include <placegraph/eval/plots/plot.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/eval/trajectory/report.h>
#include <placegraph/graph/image/png_codec.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace report_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

EvaluationResult judged(const std::string& name, bool too_short = false) {
  Random random(3);
  const Trajectory truth = test::winding_drive(60);
  Trajectory estimate = test::drifting(truth, 0.02, 0.002, random);
  estimate.poses[30].T_world_body.reset();
  EvaluationOptions options;
  options.segments.lengths_m = {too_short ? 1000.0 : 20.0};
  return evaluate(truth, estimate, options, name);
}

TEST(Report, JsonHasTheKeysScriptsRelyOn) {
  const EvaluationResult r = judged("a \"quoted\" name");
  const auto json = nlohmann::json::parse(to_json(r));
  EXPECT_EQ(json["name"], "a \"quoted\" name");
  EXPECT_EQ(json["align"], "se3");
  EXPECT_EQ(json["scale"], 1.0);
  EXPECT_EQ(json["frames"], 60);
  EXPECT_EQ(json["posed"], 59);
  EXPECT_EQ(json["lost_frames"], nlohmann::json({30}));
  EXPECT_EQ(json["ate_rmse_m"], r.ape.error_m.rmse);
  EXPECT_EQ(json["ate_percent_of_path"], 100 * r.ape.error_m.rmse / r.posed_path_m);
  EXPECT_EQ(json["t_rel_percent"], r.segments.t_rel_percent);
  EXPECT_EQ(json["r_rel_deg_per_100m"], r.segments.r_rel_deg_per_100m);
  EXPECT_EQ(json["rpe_trans_m"], r.rpe.translation_m.rmse);
  EXPECT_EQ(json["rpe_rot_deg"], r.rpe.rotation_deg.rmse);
  EXPECT_EQ(json["rpe_rot_median_deg"], r.rpe.rotation_deg.median);
  EXPECT_EQ(json["rpe_heading_deg"], r.rpe.heading_deg.rmse);
  EXPECT_EQ(json["errors"]["rpe_inclination_deg"]["max"], r.rpe.inclination_deg.max);
  EXPECT_EQ(json["per_length"].size(), 1u);
}

TEST(Report, JsonHasNullWhereTheDataAllowNoFigure) {
  const auto json = nlohmann::json::parse(to_json(judged("short", true)));
  EXPECT_TRUE(json["t_rel_percent"].is_null());
  EXPECT_TRUE(json["r_rel_deg_per_100m"].is_null());
  EXPECT_TRUE(json["ate_rmse_m"].is_number());
  EXPECT_THAT(json["warnings"].at(0).get<std::string>(), HasSubstr("too short"));
}

TEST(Report, JsonOfSeveralStatesTheAveraging) {
  const auto json = nlohmann::json::parse(to_json({judged("a"), judged("b")}, true));
  EXPECT_EQ(json["results"].size(), 2u);
  EXPECT_EQ(json["average"]["sequences"], 2);
  EXPECT_THAT(json["average"]["averaging"].get<std::string>(), HasSubstr("mean over sequences"));
  EXPECT_FALSE(nlohmann::json::parse(to_json({judged("a")}, false)).contains("average"));
}

TEST(Report, CsvHasOneNumberALineWithItsUnitAndEverySegmentTwice) {
  const EvaluationResult r = judged("a,b");
  const std::string csv = to_csv({r});
  EXPECT_THAT(csv, StartsWith("name,record,key,value,unit,first_frame,last_frame,length_m,"
                              "speed_m_per_s,protocol\n\"a,b\",metric,ate_rmse_m,"));
  const auto lines = static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n'));
  EXPECT_EQ(lines, 1 + metrics(r).size() + 11 * error_rows(r).size() +
                       2 * r.segments.segments.size());
  EXPECT_THAT(csv, HasSubstr(",errors,rotation_deg_p95,"));
  EXPECT_THAT(csv, HasSubstr(",segment,t_rel_percent,"));
}

TEST(Report, LatexEscapesNamesAndMarksMissingFigures) {
  const std::string latex = to_latex({judged("my_run 5%", true)});
  EXPECT_THAT(latex, HasSubstr("my\\_run 5\\% & 59/60"));
  EXPECT_THAT(latex, HasSubstr(" & -- & -- & "));
  EXPECT_THAT(latex, HasSubstr("align se3"));
}

TEST(Report, TextStatesAlignmentLengthsAndStep) {
  const std::string text = to_text(judged("run"));
  EXPECT_THAT(text, HasSubstr("59 of 60 frames"));
  EXPECT_THAT(text, HasSubstr("align se3"));
  EXPECT_THAT(text, HasSubstr("lengths 20 m, step 10"));
  EXPECT_THAT(text, HasSubstr("speed [m/s]"));
  EXPECT_THAT(to_table({judged("a"), judged("b")}, true), HasSubstr("mean over sequences"));
}

TEST(Plot, ChoosesTheTwoAxesOfGreatestExtent) {
  using Points = std::vector<std::optional<Eigen::Vector3d>>;
  const Points drive = {Eigen::Vector3d(0, 0, 0), std::nullopt, Eigen::Vector3d(50, 2, 100)};
  const Points flight = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(5, 9, 1)};
  const Points climb = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 9, 8)};
  EXPECT_EQ(top_view_axes(drive), std::make_pair(0, 2));
  EXPECT_EQ(top_view_axes(flight), std::make_pair(0, 1));
  EXPECT_EQ(top_view_axes(climb), std::make_pair(1, 2));
  const Points straight = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.5, 1, 60)};
  EXPECT_EQ(top_view_axes(straight), std::make_pair(0, 2));
}

TEST(Plot, SvgNamesAxesAndCurvesAndBreaksTheLineAtLostFrames) {
  const std::string svg = to_svg(plot_of({judged("a<b", true), judged("c")}));
  EXPECT_THAT(svg, StartsWith("<svg "));
  EXPECT_THAT(svg, HasSubstr("z [m]"));
  EXPECT_THAT(svg, HasSubstr("ground truth"));
  EXPECT_THAT(svg, HasSubstr("a&lt;b: ATE"));
  EXPECT_THAT(svg, HasSubstr("distance travelled [m]"));
  // A lost frame cuts the estimate in two in every panel; one line more is in the legend.
  const std::size_t panels = figure_of(plot_of({judged("a<b", true), judged("c")})).panels.size();
  const auto strokes_of = [&](const std::string& stroke) {
    std::size_t strokes = 0;
    for (std::size_t at = svg.find(stroke); at != std::string::npos; at = svg.find(stroke, at + 1))
      ++strokes;
    return strokes;
  };
  EXPECT_EQ(strokes_of("stroke=\"#0072b2\""), 2 * panels + 1);
}

TEST(Plot, PngIsAPictureWithColouredLines) {
  const std::string svg = to_svg(plot_of({judged("a"), judged("b")}));
  const cv::Mat picture = decode_png(picture_bytes(svg, "a.png"), DecodedPixels::kEightBits);
  ASSERT_FALSE(picture.empty());
  cv::Mat blue;
  cv::inRange(picture, cv::Scalar(178, 114, 0), cv::Scalar(178, 114, 0), blue);
  EXPECT_GT(cv::countNonZero(blue), 30);
}

TEST(Plot, DrawsACurveAloneWithoutGroundTruthAndALoop) {
  Plot plot;
  plot.curves.push_back({"run", {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 5)}, false});
  plot.links_m.push_back({{0, 0, 0}, {1, 0, 5}});
  const std::string svg = to_svg(plot);
  EXPECT_THAT(svg, HasSubstr("1 loop closure<"));
  EXPECT_EQ(svg.find("distance travelled"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Plot, StaysFiniteWithoutAnyPose) {
  Plot plot;
  plot.curves.push_back({"lost", {std::nullopt, std::nullopt}, false});
  EXPECT_EQ(to_svg(plot).find("nan"), std::string::npos);
  EXPECT_EQ(to_svg(plot).find("inf"), std::string::npos);
}

}  // namespace report_test
}  // namespace placegraph
