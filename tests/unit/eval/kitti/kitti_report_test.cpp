#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/kitti/kitti_plots.h>
#include <placegraph/eval/kitti/kitti_report.h>

#include <nlohmann/json.hpp>

namespace placegraph {
namespace kitti_report_test {

using testing::HasSubstr;
using testing::Not;

KittiFigures figures_with(double t_rel_percent) {
  KittiFigures figures;
  figures.outcome = Outcome::ok();
  figures.segments = 7;
  figures.t_rel_percent = t_rel_percent;
  figures.r_rel_deg_per_100m = 0.25;
  figures.by_length = {{100, 4, t_rel_percent, 0.5}, {200, 3, 2 * t_rel_percent, 0.125}};
  figures.by_speed = {{8, 7, t_rel_percent, 0.25}};
  return figures;
}

/// A system with a sequence that is judged, and one without truth.
KittiSystem system_with(const std::string& name, double t_rel_percent) {
  KittiSystem system;
  system.name = name;
  KittiSequence judged;
  judged.name = "05";
  judged.file = name + "/05.txt";
  judged.has_truth = true;
  judged.frames = 2;
  judged.path_m = 3;
  judged.figures = figures_with(t_rel_percent);
  judged.pairs = {{}, {}};
  for (FramePair& pair : judged.pairs) pair.T_world_estimate = Eigen::Isometry3d::Identity();
  judged.pairs.back().T_world_truth.translation().z() = 3;
  KittiSequence untrue;
  untrue.name = "11";
  untrue.file = name + "/11.txt";
  untrue.frames = 921;
  system.sequences = {judged, untrue};
  system.mean = judged.figures;
  return system;
}

/// The same with a fault in the sequence that has a truth.
KittiSystem faulty_system(const std::string& name) {
  KittiSystem system = system_with(name, 1);
  KittiSequence& sequence = system.sequences.front();
  sequence.faulty = true;
  sequence.figures = {};
  sequence.pairs.clear();
  system.faults = {{sequence.file, 17, "11 numbers, not 12"}};
  system.mean = {};
  system.mean.outcome = Outcome::failure(Outcome::Code::kInconsistent, "faults in 05");
  return system;
}

TEST(KittiReport, ASystemHasItsTablesAndWhatWasChecked) {
  KittiSystem system = system_with("mine", 0.75);
  system.warnings = {{"mine/notes.md", 0, "is not read"}};
  const std::string text = to_text(KittiBenchmark{{system}});
  EXPECT_THAT(text,
              HasSubstr("05             2        3.0         7      0.7500             0.2500"));
  EXPECT_THAT(text, HasSubstr("r_rel 0.002500 deg/m"));
  EXPECT_THAT(text, HasSubstr("200                 3      1.5000             0.1250"));
  EXPECT_THAT(text, HasSubstr("mine: 2 files, 1 without ground truth: checked in form alone; fit "
                              "to be submitted\n  warning: mine/notes.md: is not read\n"));
}

TEST(KittiReport, SeveralSystemsStandBesideEachOther) {
  const std::string text =
      to_text(KittiBenchmark{{system_with("mine", 0.75), faulty_system("theirs")}});
  EXPECT_THAT(text, HasSubstr("05           0.7500     0.2500          -          -\n"));
  EXPECT_THAT(text, HasSubstr("theirs: no mean: faults in 05"));
  EXPECT_THAT(text, HasSubstr("1 fault\n  theirs/05.txt:17: 11 numbers, not 12\n"));
}

TEST(KittiReport, JsonAndCsvHaveNoNumberWhereThereIsNone) {
  const KittiBenchmark benchmark{{system_with("mine", 0.75), faulty_system("theirs")}};
  const auto json = nlohmann::json::parse(to_json(benchmark)).at("systems");
  EXPECT_EQ(json[0].at("t_rel_percent"), 0.75);
  EXPECT_EQ(json[0].at("r_rel_deg_per_m"), 0.0025);
  EXPECT_EQ(json[0].at("sequences")[0].at("per_length")[1].at("length_m"), 200);
  EXPECT_EQ(json[0].at("sequences")[1].at("outcome"), "not judged");
  EXPECT_TRUE(json[1].at("t_rel_percent").is_null());
  EXPECT_EQ(json[1].at("outcome"), "faults in 05");
  EXPECT_EQ(json[1].at("faults")[0].at("line"), 17);
  const std::string csv = to_csv(benchmark);
  EXPECT_THAT(csv, HasSubstr("mine,05,2,3,7,0.75,0.25\nmine,mean,,,7,0.75,0.25\n"));
  EXPECT_THAT(csv, HasSubstr("theirs,05,2,,0,,\ntheirs,mean,,,0,,\n"));
}

TEST(KittiPlots, HaveACurveForEachSystem) {
  const KittiBenchmark benchmark{{system_with("mine", 0.75), system_with("theirs", 0.5)}};
  const auto path = figure_of(benchmark, "05", KittiPlot::kPath);
  ASSERT_TRUE(path);
  ASSERT_EQ(path->legend.size(), 4u);  // truth, two estimates, start
  EXPECT_EQ(path->legend[2].text, "theirs");
  const auto speeds = figure_of(benchmark, "05", KittiPlot::kTranslationOverSpeed);
  ASSERT_TRUE(speeds);
  const auto& line = std::get<FigureLine>(speeds->panels.front().shapes[2]);
  EXPECT_NEAR((*line.points.front())[0], 28.8, 1e-12);  // 8 m/s
  EXPECT_NEAR((*line.points.front())[1], 0.5, 1e-12);
  const auto rotations = figure_of(benchmark, kKittiAverage, KittiPlot::kRotationOverLength);
  ASSERT_TRUE(rotations);
  const auto& turns = std::get<FigureLine>(rotations->panels.front().shapes[0]);
  EXPECT_NEAR((*turns.points.front())[1], 0.005, 1e-12);  // deg/m
}

TEST(KittiPlots, ThereIsNoneOfWhatNoSystemHas) {
  KittiBenchmark benchmark{{system_with("mine", 0.75)}};
  EXPECT_FALSE(figure_of(benchmark, kKittiAverage, KittiPlot::kPath));
  EXPECT_FALSE(figure_of(benchmark, "11", KittiPlot::kPath));
  EXPECT_FALSE(figure_of(benchmark, "42", KittiPlot::kRotationOverSpeed));
  benchmark.systems.front().sequences.front().figures.by_length.clear();
  EXPECT_FALSE(figure_of(benchmark, "05", KittiPlot::kTranslationOverLength));
  EXPECT_EQ(kitti_plot_names().size(), static_cast<std::size_t>(KittiPlot::kRotationOverSpeed) + 1);
}

}  // namespace kitti_report_test
}  // namespace placegraph
