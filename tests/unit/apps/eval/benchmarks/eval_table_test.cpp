#include "apps/eval/benchmarks/eval_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/tables/table_writers.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/evo/evo_result.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trajectories.h"

namespace placegraph::apps {
namespace eval_table_test {

using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

std::string whole_text(const std::string& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class EvalTable : public testing::Test {
 protected:
  /// A drive that stands `off_m` to the side of where it was.
  std::string write_drive(const std::string& name, double off_m, int frames = 60,
                          bool timed = false) {
    Trajectory drive = test::winding_drive(frames, 1, timed);
    for (StampedPose& pose : drive.poses) pose.T_world_body->translation().x() += off_m;
    std::filesystem::create_directories(std::filesystem::path(folder / name).parent_path());
    write_trajectory(folder / name, drive,
                     timed ? TrajectoryFormat::kTum : TrajectoryFormat::kKitti);
    return folder / name;
  }
  /// Two sequences; the second system is further off on the first, and has no second.
  void write_two_systems() {
    for (const char* name : {"gt/00.txt", "gt/01.txt"}) write_drive(name, 0);
    write_drive("ours/00.txt", 0.2);
    write_drive("ours/01.txt", 0.4);
    write_drive("theirs/00.txt", 0.3);
    arguments.judging.truth = folder / "gt";
    arguments.judging.align = "none";
    arguments.figures = {"ate_rmse_m"};
    arguments.systems = {folder / "ours", "other=" + (folder / "theirs")};
  }
  test::TemporaryFolder folder;
  EvalTableArguments arguments;
};

TEST_F(EvalTable, SequencesAndSystemsWithWhatIsMissing) {
  write_two_systems();
  const FigureTable table = eval_table(arguments);
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.columns[0].name, "ours");
  EXPECT_EQ(table.columns[1].name, "other");
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_NEAR(*table.rows[0].cells[0].value, 0.2, 1e-6);
  EXPECT_NEAR(*table.rows[0].cells[1].value, 0.3, 1e-6);
  EXPECT_EQ(table.rows[1].cells[1].note, "no estimate");
  EXPECT_EQ(table.rows[2].name, "mean of all 2");
  EXPECT_NEAR(*table.rows[2].cells[0].value, 0.3, 1e-6);
  EXPECT_FALSE(table.rows[2].cells[1].value);
  EXPECT_EQ(table.rows[3].name, "mean of the 1 that all have");
  EXPECT_NEAR(*table.rows[3].cells[1].value, 0.3, 1e-6);
}

TEST_F(EvalTable, ASequenceThatNobodyEstimatedKeepsItsRow) {
  write_two_systems();
  write_drive("gt/02.txt", 0);
  const FigureTable table = eval_table(arguments);
  EXPECT_EQ(table.rows[2].name, "02");
  EXPECT_EQ(table.rows[2].cells[0].note, "no estimate");
}

TEST_F(EvalTable, ARefusedEstimateIsAFailureWithItsReason) {
  write_two_systems();
  write_drive("theirs/01.txt", 0.1, 50);  // another number of frames
  const FigureTable table = eval_table(arguments);
  EXPECT_FALSE(table.rows[1].cells[1].value);
  EXPECT_THAT(table.rows[1].cells[1].note, HasSubstr("50"));
}

TEST_F(EvalTable, FilesAreWrittenAsTheyEndAndNotOverwritten) {
  write_two_systems();
  arguments.outputs = {folder / "t.md", folder / "t.json"};
  const FigureTable table = eval_table(arguments);
  EXPECT_EQ(whole_text(folder / "t.md"), to_markdown(table));
  EXPECT_EQ(nlohmann::json::parse(whole_text(folder / "t.json"))["rows"].size(), 4u);
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)eval_table(arguments); }),
              HasSubstr("exists already"));
  arguments.outputs = {folder / "t.doc"};
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)eval_table(arguments); }),
              HasSubstr("a table ends in one of .txt"));
}

TEST_F(EvalTable, OneTruthAndSystemsInRows) {
  arguments.judging.truth = write_drive("truth.txt", 0);
  arguments.judging.align = "none";
  arguments.systems = {"a=" + write_drive("a.txt", 0.2), "b=" + write_drive("b.txt", 0.1)};
  arguments.rows = "systems";
  arguments.figures = {"ate_rmse_m", "rpe_trans_m"};
  const FigureTable table = eval_table(arguments);
  EXPECT_EQ(table.caption, "truth");
  EXPECT_EQ(table.columns[0].name, "ATE RMSE");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_TRUE(best_cells(table)[1][0]);
}

TEST_F(EvalTable, WhatCannotBeComparedIsRefused) {
  write_two_systems();
  EvalTableArguments without_truth = arguments;
  without_truth.judging.truth.clear();
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)eval_table(without_truth); }),
              HasSubstr("--truth"));
  EvalTableArguments misspelled = arguments;
  misspelled.figures = {"ate_rsme_m"};
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)eval_table(misspelled); }),
              HasSubstr("did you mean ate_rmse_m"));
  EvalTableArguments missing = arguments;
  missing.systems = {"a=" + (folder / "none")};
  EXPECT_THAT(message_of<FileError>([&] { (void)eval_table(missing); }), HasSubstr("is missing"));
  EvalTableArguments twice = arguments;
  twice.systems = {folder / "ours", "ours=" + (folder / "theirs")};
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)eval_table(twice); }),
              HasSubstr("two systems have the name ours"));
}

TEST_F(EvalTable, EvoArchivesAreTabledByTheirOwnNames) {
  const auto archive = [&](const std::string& file, const std::string& reference, double rmse,
                           const std::string& label = "APE (m)") {
    EvoResult result;
    result.title = label == "APE (m)" ? "APE w.r.t. translation part (m)\n(not aligned)" : "RPE";
    result.label = label;
    result.reference = reference;
    result.estimate = "runs/ours.tum";
    result.statistics = {{"rmse", rmse}, {"mean", rmse / 2}};
    write_evo_result(folder / file, result);
    return folder / file;
  };
  arguments.systems = {archive("a.zip", "gt/00.tum", 0.5), archive("b.zip", "gt/01.tum", 0.25),
                       "theirs=" + archive("c.zip", "gt/00.tum", 1.5)};
  FigureTable table = eval_table(arguments);
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[0].name, "00");
  EXPECT_EQ(table.columns[0].name, "ours");
  EXPECT_EQ(table.columns[0].group, "APE rmse");
  EXPECT_EQ(table.columns[0].unit, "m");
  EXPECT_EQ(table.rows[0].cells[1].value, 1.5);
  EXPECT_EQ(table.rows[1].cells[1].note, "no estimate");
  arguments.figures = {"ape_m_mean"};
  EXPECT_EQ(eval_table(arguments).rows[0].cells[0].value, 0.25);
  // Two figures of one system and sequence stand side by side; the same one twice is refused.
  arguments.figures.clear();
  arguments.systems = {folder / "a.zip", archive("r.zip", "gt/00.tum", 7, "RPE (deg)")};
  table = eval_table(arguments);
  EXPECT_EQ(table.columns[1].name, "RPE rmse");
  EXPECT_EQ(table.columns[1].unit, "deg");
  arguments.systems = {folder / "a.zip", folder / "c.zip"};
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)eval_table(arguments); }),
              HasSubstr("another archive has APE rmse of ours on 00"));
  arguments.systems = {folder / "a.zip", write_drive("ours/00.txt", 0)};
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)eval_table(arguments); }),
              HasSubstr("do not go into one table"));
}

}  // namespace eval_table_test
}  // namespace placegraph::apps
