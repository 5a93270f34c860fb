#include "apps/eval/eval.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trajectories.h"

namespace placegraph::apps {
namespace eval_test {

using test::message_of;
using testing::HasSubstr;

class EvalCommand : public testing::Test {
 protected:
  /// A drive of 60 frames that stands `off_m` to the side of where it was.
  std::string write_drive(const std::string& name, double off_m = 0) {
    Trajectory drive = test::winding_drive(60, 1, false);
    for (StampedPose& pose : drive.poses) pose.T_world_body->translation().x() += off_m;
    std::filesystem::create_directories(std::filesystem::path(folder / name).parent_path());
    write_trajectory(folder / name, drive, TrajectoryFormat::kKitti);
    return folder / name;
  }
  test::TemporaryFolder folder;
  EvalArguments arguments;
};

TEST_F(EvalCommand, MeasuresHowFarAnEstimateIsOff) {
  arguments.truth = write_drive("truth.txt");
  arguments.estimates = {write_drive("estimate.txt", 0.3)};
  arguments.align = "none";
  const EvalResult result = eval(arguments);
  ASSERT_TRUE(result.single());
  EXPECT_EQ(result.refused(), nullptr);
  EXPECT_NEAR(result.results[0].ape.error_m.rmse, 0.3, 1e-6);
  EXPECT_EQ(result.results[0].posed, 60);
  arguments.align = "se3";
  EXPECT_LT(eval(arguments).results[0].ape.error_m.rmse, 1e-6);
}

TEST_F(EvalCommand, TakesStepsPartsAndSpansFromTheirTexts) {
  arguments.truth = write_drive("truth.txt");
  arguments.estimates = {write_drive("estimate.txt", 0.3)};
  arguments.deltas = {"10f", "5m"};
  arguments.align_frames = ":30";
  arguments.part = "xz";
  const EvaluationResult result = eval(arguments).results[0];
  ASSERT_EQ(result.relative.size(), 2u);
  EXPECT_EQ(result.relative[1].delta, (Delta{5, Delta::Unit::kMetres}));
  EXPECT_EQ(result.alignment.pairs, 30);
  EXPECT_EQ(result.protocol.part, "in the plane xz");
  arguments.align_frames = "30:20";
  EXPECT_THAT(message_of<ArgumentError>([&] { eval(arguments); }), HasSubstr("--align-frames: '30:20' ends"));
  arguments.align_frames = "a:20";
  EXPECT_THAT(message_of<ArgumentError>([&] { eval(arguments); }), HasSubstr("'a' is not a number"));
  arguments.align_frames = "20";
  EXPECT_THAT(message_of<ArgumentError>([&] { eval(arguments); }), HasSubstr("is no span A:B"));
  arguments.align_first = 5;
  EXPECT_THAT(message_of<ArgumentError>([&] { eval(arguments); }), HasSubstr("give one of them"));
  arguments.align_frames.clear();
  EXPECT_EQ(eval(arguments).results[0].alignment.pairs, 5);
  arguments.deltas = {"0s"};
  EXPECT_THAT(message_of<ArgumentError>([&] { eval(arguments); }), HasSubstr("delta '0s'"));
}

TEST_F(EvalCommand, ComparesEstimatesOfDifferentFramesOnCommonOnes) {
  arguments.truth = write_drive("truth.txt");
  Trajectory half = test::winding_drive(60, 1, false);
  for (std::size_t i = 30; i < 60; ++i) half.poses[i].T_world_body.reset();
  write_trajectory(folder / "half.txt", half, TrajectoryFormat::kKitti);
  arguments.estimates = {write_drive("whole.txt", 0.3), folder / "half.txt"};
  const EvalResult result = eval(arguments);
  ASSERT_TRUE(result.common.needed);
  EXPECT_EQ(result.common.results[0].posed, 30);
  EXPECT_THAT(to_text(result), HasSubstr("on the frames that all estimates have"));
  EXPECT_EQ(nlohmann::json::parse(to_json(result))["common"].size(), 2u);
}

TEST_F(EvalCommand, GivesIntervalsOfRepeatedRunsFromFiveOn) {
  arguments.truth = write_drive("truth.txt");
  arguments.align = "none";
  arguments.repeated_runs = true;
  for (int run = 0; run < 5; ++run)
    arguments.estimates.push_back(write_drive("r" + std::to_string(run), 0.3 + 0.01 * run));
  const auto ate = [](const EvalResult& result) { return result.of_runs.at(0).interval; };
  const EvalResult five = eval(arguments);
  ASSERT_TRUE(ate(five).outcome) << ate(five).outcome.reason;
  EXPECT_NEAR(ate(five).estimate, 0.32, 1e-6);
  EXPECT_LT(ate(five).low, 0.32);
  EXPECT_GT(ate(five).high, 0.32);
  EXPECT_THAT(to_text(five), HasSubstr("over the runs"));
  arguments.estimates.pop_back();
  EXPECT_FALSE(ate(eval(arguments)).outcome);
}

TEST_F(EvalCommand, LeavesNoMeanWhereASequenceHasNoEstimate) {
  arguments.truth = folder / "truth";
  arguments.estimates = {folder / "estimates"};
  write_drive("truth/00.txt"), write_drive("truth/01.txt");
  write_drive("estimates/00.txt", 0.1);
  const nlohmann::json json = nlohmann::json::parse(to_json(eval(arguments)));
  EXPECT_EQ(json["average"]["failed"], 1);
  EXPECT_TRUE(json["average"]["ate_rmse_m"].is_null());
  EXPECT_FALSE(json["average"]["of_the_others"]["ate_rmse_m"].is_null());
}

TEST_F(EvalCommand, TakesTheOutputFolderOfARun) {
  arguments.truth = write_drive("truth.txt");
  write_drive("run/trajectory_optimized.kitti", 0.3);
  write_drive("run/trajectory_online.kitti", 0.9);
  arguments.estimates = {folder / "run"};
  arguments.align = "none";
  const EvalResult result = eval(arguments);
  ASSERT_EQ(result.results.size(), 1u);
  EXPECT_EQ(result.results[0].name, "run");
  EXPECT_NEAR(result.results[0].ape.error_m.rmse, 0.3, 1e-6);
}

TEST_F(EvalCommand, PairsTheFilesOfTwoFoldersByName) {
  arguments.truth = folder / "truth";
  arguments.estimates = {folder / "estimates"};
  arguments.align = "none";
  write_drive("truth/00.txt"), write_drive("truth/01.txt"), write_drive("truth/02.txt");
  write_drive("estimates/01.txt", 0.2), write_drive("estimates/00.kitti", 0.1);
  write_drive("estimates/99.txt");
  const EvalResult result = eval(arguments);
  ASSERT_EQ(result.results.size(), 2u);  // nobody has estimated 02
  EXPECT_TRUE(result.folders);
  EXPECT_EQ(result.results[0].name, "00");
  EXPECT_NEAR(result.results[0].ape.error_m.rmse, 0.1, 1e-6);
  EXPECT_EQ(result.results[1].name, "01");
  EXPECT_NEAR(result.results[1].ape.error_m.rmse, 0.2, 1e-6);
  EXPECT_TRUE(nlohmann::json::parse(to_json(result)).contains("average"));
  write_drive("estimates/00.tum");
  EXPECT_THAT(message_of<ArgumentError>([&] { eval(arguments); }),
              HasSubstr("00.txt: both 00.kitti and 00.tum could be its estimate"));
}

TEST_F(EvalCommand, CallsEstimatesByWhatTellsThemApart) {
  arguments.truth = write_drive("truth.txt");
  arguments.estimates = {write_drive("a/poses.txt"), write_drive("b/poses.txt")};
  const EvalResult result = eval(arguments);
  ASSERT_EQ(result.results.size(), 2u);
  EXPECT_EQ(result.results[0].name, "a");
  EXPECT_EQ(result.results[1].name, "b");
  EXPECT_FALSE(result.single());
}

TEST_F(EvalCommand, TakesTheTimesBesideASequence) {
  std::string times;
  for (int i = 0; i < 60; ++i) times += std::to_string(0.1 * i) + "\n";
  folder.write("sequence/times.txt", times);
  write_drive("sequence/poses.txt");
  Trajectory estimate = test::winding_drive(60);
  estimate.poses.erase(estimate.poses.begin(), estimate.poses.begin() + 20);
  write_trajectory(folder / "estimate.tum", estimate, TrajectoryFormat::kTum);
  arguments.truth = folder / "sequence";
  arguments.estimates = {folder / "estimate.tum"};
  arguments.align = "none";
  const EvalResult result = eval(arguments);
  EXPECT_EQ(result.results[0].posed, 40);
  EXPECT_LT(result.results[0].ape.error_m.rmse, 1e-5);
}

TEST_F(EvalCommand, EstimatesAndRemovesOffsetsFirst) {
  // A drive of 200 frames at 10 Hz, seen by a body 0.3 m to the side whose clock is 0.2 s late.
  const Trajectory truth = test::winding_drive(200);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses) {
    pose.stamp_ns += 200'000'000;
    pose.T_world_body = *pose.T_world_body * Eigen::Translation3d(0.3, 0, 0);
  }
  write_trajectory(folder / "truth.tum", truth, TrajectoryFormat::kTum);
  write_trajectory(folder / "estimate.tum", estimate, TrajectoryFormat::kTum);
  arguments.truth = folder / "truth.tum";
  arguments.estimates = {folder / "estimate.tum"};
  const double unmoved_m = eval(arguments).results[0].ape.error_m.rmse;
  arguments.estimated = {"body", "time"};
  const EvaluationResult result = eval(arguments).results[0];
  ASSERT_TRUE(result.offsets && result.offsets->outcome);
  EXPECT_NEAR(result.offsets->time_s, -0.2, 1e-3);
  EXPECT_NEAR(result.offsets->T_estimate_truth.translation().x(), -0.3, 0.01);
  EXPECT_NEAR(result.protocol.offset_s, -0.2, 1e-3);
  EXPECT_LT(result.ape.error_m.rmse, 0.1 * unmoved_m);
  const auto json = nlohmann::json::parse(to_json(eval(arguments)));
  EXPECT_NEAR(json["offsets"]["time_s"], -0.2, 1e-3);
}

TEST_F(EvalCommand, OffsetsThatTheMotionDoesNotShowAreNoAnswer) {
  Trajectory truth = test::winding_drive(200);
  for (std::size_t i = 0; i < truth.size(); ++i)
    truth.poses[i].T_world_body = Eigen::Translation3d(0.5 * static_cast<double>(i), 0, 0) *
                                  Eigen::Isometry3d::Identity();
  write_trajectory(folder / "truth.tum", truth, TrajectoryFormat::kTum);
  arguments.truth = folder / "truth.tum";
  arguments.estimates = {folder / "truth.tum"};
  arguments.estimated = {"time"};
  const EvalResult result = eval(arguments);
  ASSERT_NE(result.refused(), nullptr);
  EXPECT_THAT(result.refused()->outcome.reason, HasSubstr("the time offset is free"));
}

TEST_F(EvalCommand, WritesTheFilesThatAreNamed) {
  arguments.truth = write_drive("truth.txt");
  arguments.estimates = {write_drive("estimate.txt")};
  arguments.csv = folder / "figures.csv";
  arguments.latex = folder / "table.tex";
  arguments.plot = folder / "plot.svg";
  eval(arguments);
  EXPECT_THAT(test::read_file(arguments.csv), HasSubstr("estimate.txt,metric,"));
  EXPECT_THAT(test::read_file(arguments.latex), HasSubstr("\\toprule"));
  EXPECT_THAT(test::read_file(arguments.plot), HasSubstr("<svg"));
}

TEST_F(EvalCommand, WritesSeveralFiguresBesideEachOther) {
  arguments.truth = write_drive("truth.txt");
  arguments.estimates = {write_drive("estimate.txt")};
  arguments.plot = folder / "plot.pdf";
  arguments.plot_kinds = {"xyz"};
  eval(arguments);
  EXPECT_EQ(test::read_file(arguments.plot).substr(0, 4), "%PDF");
  arguments.plot_kinds = {"overview", "rpe"};
  eval(arguments);
  EXPECT_TRUE(std::filesystem::exists(folder / "plot_overview.pdf"));
  EXPECT_TRUE(std::filesystem::exists(folder / "plot_rpe.pdf"));
  EXPECT_THROW(eval(arguments), ArgumentError);  // both exist
  arguments.plot_kinds = {"pie"};
  EXPECT_THROW(eval(arguments), ArgumentError);
  // A figure that cannot be drawn is named; the others are written.
  arguments.plot_kinds = {"box", "lengths"};
  arguments.options.segments.lengths_m = {1e6};
  testing::internal::CaptureStderr();
  eval(arguments);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("plot_lengths.pdf is not drawn"));
  EXPECT_TRUE(std::filesystem::exists(folder / "plot_box.pdf"));
  arguments.plot_kinds = {"lengths"};
  EXPECT_THROW(eval(arguments), ArgumentError);
}

TEST_F(EvalCommand, WritesNothingWhereTheDataAllowNoAnswer) {
  arguments.truth = write_drive("truth.txt");
  Trajectory lost = test::winding_drive(60, 1, false);
  for (StampedPose& pose : lost.poses) pose.T_world_body.reset();
  write_trajectory(folder / "lost.txt", lost, TrajectoryFormat::kKitti);
  arguments.estimates = {folder / "lost.txt"};
  arguments.csv = folder / "figures.csv";
  const EvalResult result = eval(arguments);
  ASSERT_NE(result.refused(), nullptr);
  EXPECT_EQ(result.refused()->name, "lost.txt");
  EXPECT_FALSE(std::filesystem::exists(arguments.csv));
}

TEST_F(EvalCommand, RefusesArgumentsThatMeanNothing) {
  const auto expect_refused = [&](const std::string& message) {
    EXPECT_THAT(message_of<ArgumentError>([&] { eval(arguments); }), HasSubstr(message));
  };
  expect_refused("EST: no estimate is given");
  arguments.truth = write_drive("truth.txt");
  arguments.estimates = {write_drive("estimate.txt")};
  const EvalArguments asked = arguments;
  arguments.align = "best";
  expect_refused("--align: 'best' is none of none, origin, se3, sim3, scale");
  arguments = asked;
  arguments.associate = "name";
  expect_refused("--associate: 'name' is none of auto, index, time");
  arguments = asked;
  arguments.times = {"a", "b", "c"};
  expect_refused("--times: one file for all, or two");
  arguments = asked;
  arguments.estimates = {folder.path()};
  expect_refused(folder.path() + ": is a folder without trajectory_optimized.kitti");
  arguments = asked;
  arguments.truth = folder.path();
  EXPECT_THAT(message_of<FileError>([&] { eval(arguments); }),
              HasSubstr("no sequence is recognized"));
  arguments = asked;
  arguments.csv = folder.write("mine.csv", "mine");
  expect_refused("mine.csv: exists already; --force overwrites it");
}

}  // namespace eval_test
}  // namespace placegraph::apps
