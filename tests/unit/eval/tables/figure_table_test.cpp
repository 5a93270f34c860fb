#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/tables/figure_table.h>
#include <placegraph/eval/tables/printed_table.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "tests/support/trajectories.h"

namespace placegraph {
namespace figure_table_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

SequenceFigures figures(const std::string& name, std::optional<double> ate,
                        std::optional<double> t_rel = 1.0) {
  SequenceFigures result;
  result.name = name;
  result.figures = {{"ate_rmse_m", "ATE RMSE", "m", ate, ""},
                    {"t_rel_percent", "t_rel", "%", t_rel, ""}};
  return result;
}

SequenceFigures failed(const std::string& name, const std::string& why) {
  SequenceFigures result = figures(name, {}, {});
  result.failure = why;
  return result;
}

const TableRow& row_of(const FigureTable& table, const std::string& name) {
  const auto found = std::ranges::find(table.rows, name, &TableRow::name);
  if (found == table.rows.end()) throw ArgumentError("no row " + name);
  return *found;
}

std::vector<std::string> row_names(const FigureTable& table) {
  std::vector<std::string> names;
  for (const TableRow& row : table.rows) names.push_back(row.name);
  return names;
}

std::string refusal_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const ArgumentError& error) {
    return error.what();
  }
  return "";
}

TEST(FigureTable, AMeanOverAllIsOfSystemsThatHaveAll) {
  const FigureTable table =
      table_of({{"ours", {figures("00", 1), figures("01", 3), figures("02", 8)}},
                {"theirs", {figures("00", 2), failed("01", "lost after 12 s"), figures("02", 5)}}},
               {"ate_rmse_m"});
  EXPECT_THAT(row_names(table),
              ElementsAre("00", "01", "02", "mean of all 3", "mean of the 2 that all have"));
  const TableRow &all = row_of(table, "mean of all 3"),
                 &common = row_of(table, "mean of the 2 that all have");
  EXPECT_EQ(all.cells[0].value, 4);
  EXPECT_FALSE(all.cells[1].value);
  EXPECT_EQ(all.cells[1].note, "no mean of all: 1 of 3 have no figure");
  EXPECT_EQ(common.cells[0].value, 4.5);
  EXPECT_EQ(common.cells[1].value, 3.5);
  EXPECT_EQ(row_of(table, "01").cells[1].note, "lost after 12 s");
  EXPECT_FALSE(row_of(table, "01").cells[1].value);
}

TEST(FigureTable, WithoutFailuresThereIsOneMean) {
  const FigureTable table = table_of(
      {{"a", {figures("00", 1), figures("01", 3)}}, {"b", {figures("00", 2), figures("01", 5)}}},
      {"ate_rmse_m", "t_rel_percent"});
  EXPECT_THAT(row_names(table), ElementsAre("00", "01", "mean of all 2"));
  EXPECT_EQ(table.columns.size(), 4u);
  EXPECT_EQ(table.columns[1].name, "b");
  EXPECT_EQ(table.columns[1].group, "ATE RMSE");
  EXPECT_EQ(table.columns[2].group, "t_rel");
}

TEST(FigureTable, ASequenceWithoutEstimateKeepsItsCell) {
  const FigureTable table = table_of(
      {{"a", {figures("00", 1)}}, {"b", {figures("00", 2), figures("01", 5)}}}, {"ate_rmse_m"});
  EXPECT_EQ(row_of(table, "01").cells[0].note, "no estimate");
  EXPECT_FALSE(row_of(table, "mean of all 2").cells[0].value);
  EXPECT_EQ(row_of(table, "mean of the 1 that all have").cells[1].value, 2);
}

TEST(FigureTable, CommonSequencesAreCountedForEachFigure) {
  const FigureTable table =
      table_of({{"a", {figures("00", 1, {}), figures("01", 3, 4), figures("02", 5, 6)}},
                {"b", {figures("00", 2, 1), figures("01", 4, 2), figures("02", 6, 4)}}},
               {"ate_rmse_m", "t_rel_percent"});
  const TableRow& common = row_of(table, "mean of those that all have");
  EXPECT_EQ(common.cells[0].value, 3);
  EXPECT_EQ(common.cells[0].note, "over 3 of 3");
  EXPECT_EQ(common.cells[2].value, 5);
  EXPECT_EQ(common.cells[3].value, 3);
  EXPECT_EQ(common.cells[3].note, "over 2 of 3");
}

/// Over many tables with failures: a system with a failure has no mean of all, others have theirs,
/// and the common mean is the one over lines without any failure.
TEST(FigureTable, NoMeanLeavesAFailureOutWithoutSayingSo) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const int systems = 1 + static_cast<int>(random.uniform(0, 4)),
              sequences = 2 + static_cast<int>(random.uniform(0, 6));
    std::vector<NamedResults> results;
    for (int s = 0; s < systems; ++s) {
      NamedResults& system = results.emplace_back(NamedResults{"s" + std::to_string(s), {}});
      for (int q = 0; q < sequences; ++q)
        system.sequences.push_back(random.uniform(0, 1) < 0.15
                                       ? failed(std::to_string(q), "lost")
                                       : figures(std::to_string(q), random.uniform(0, 9)));
    }
    const FigureTable table = table_of(results, {"ate_rmse_m"});
    const TableRow& all = table.rows[static_cast<std::size_t>(sequences)];
    std::vector<double> common(static_cast<std::size_t>(systems), 0);
    int count = 0;
    for (int q = 0; q < sequences; ++q) {
      const TableRow& row = table.rows[static_cast<std::size_t>(q)];
      if (std::ranges::any_of(row.cells, [](const TableCell& c) { return !c.value; })) continue;
      ++count;
      for (std::size_t s = 0; s < common.size(); ++s) common[s] += *row.cells[s].value;
    }
    for (std::size_t s = 0; s < common.size(); ++s) {
      double sum = 0;
      bool whole = true;
      for (int q = 0; q < sequences; ++q) {
        const TableCell& cell = table.rows[static_cast<std::size_t>(q)].cells[s];
        whole = whole && cell.value;
        sum += cell.value.value_or(0);
      }
      EXPECT_EQ(all.cells[s].value.has_value(), whole);
      if (whole) {
        EXPECT_NEAR(*all.cells[s].value, sum / sequences, 1e-12);
      }
      EXPECT_EQ(all.cells[s].note.empty(), whole);
      if (count == sequences) continue;
      const TableCell& mean = table.rows[static_cast<std::size_t>(sequences) + 1].cells[s];
      EXPECT_EQ(mean.value.has_value(), count > 0);
      if (count > 0) {
        EXPECT_NEAR(*mean.value, common[s] / count, 1e-12);
      }
    }
    EXPECT_EQ(table.rows.size(), static_cast<std::size_t>(sequences) + (count < sequences ? 2 : 1));
  }
}

TEST(FigureTable, RowsAndColumnsChangePlaces) {
  const std::vector<NamedResults> results = {{"a", {figures("00", 1, 7), failed("01", "lost")}},
                                             {"b", {figures("00", 2, 8), figures("01", 5, 9)}}};
  const FigureTable by_sequence = table_of(results, {"ate_rmse_m"}),
                    by_system = table_of(results, {"ate_rmse_m"}, TableRows::kSystems);
  ASSERT_EQ(by_system.rows.size(), by_sequence.columns.size());
  ASSERT_EQ(by_system.columns.size(), by_sequence.rows.size());
  for (std::size_t r = 0; r < by_system.rows.size(); ++r)
    for (std::size_t c = 0; c < by_system.columns.size(); ++c) {
      EXPECT_EQ(by_system.rows[r].cells[c].value, by_sequence.rows[c].cells[r].value);
      EXPECT_EQ(by_system.rows[r].cells[c].note, by_sequence.rows[c].cells[r].note);
      EXPECT_EQ(best_cells(by_system)[r][c], best_cells(by_sequence)[c][r]);
    }
}

TEST(FigureTable, OneSequenceHasTheFiguresAsColumns) {
  const FigureTable table = table_of({{"a", {figures("00", 1, 7)}}, {"b", {figures("00", 2, 8)}}},
                                     {"ate_rmse_m", "t_rel_percent"}, TableRows::kSystems);
  EXPECT_EQ(table.columns[0].name, "ATE RMSE");
  EXPECT_EQ(table.columns[0].group, "");
  EXPECT_EQ(table.columns[1].unit, "%");
  EXPECT_EQ(table.caption, "00");
  EXPECT_EQ(table.rows.size(), 2u);
}

TEST(FigureTable, TheBestIsTheLowestErrorAndTheHighestShare) {
  SequenceFigures a = figures("00", 0.5), b = figures("00", 0.4);
  a.figures.push_back({"coverage", "coverage", "", 0.9, ""});
  b.figures.push_back({"coverage", "coverage", "", 0.8, ""});
  const FigureTable table = table_of({{"a", {a}}, {"b", {b}}}, {"ate_rmse_m", "coverage"});
  EXPECT_THAT(best_cells(table)[0], ElementsAre(false, true, true, false));
}

TEST(FigureTable, TheBestDriftIsTheOneNearestToZero) {
  const auto drift = [](const std::string& name, double value) {
    SequenceFigures result;
    result.name = name;
    result.figures = {{"scale_drift_percent_per_100m", "scale drift", "%/100m", value, ""}};
    return result;
  };
  const FigureTable table =
      table_of({{"wild", {drift("0", 11), drift("1", -13)}}, {"calm", {drift("0", 1), drift("1", 1.5)}}},
               {"scale_drift_percent_per_100m"}, TableRows::kSequences);
  const std::vector<std::vector<bool>> best = best_cells(table);
  EXPECT_THAT(best[0], ElementsAre(false, true));
  EXPECT_THAT(best[1], ElementsAre(false, true));
  // A mean of both signs says nothing of the drift.
  EXPECT_THAT(best[2], ElementsAre(false, false));
}

TEST(FigureTable, ValuesThatPrintAlikeAreBothTheBest) {
  const FigureTable table = table_of(
      {{"a", {figures("00", 1.23401)}}, {"b", {figures("00", 1.23399)}}, {"c", {figures("00", 2)}}},
      {"ate_rmse_m"});
  EXPECT_THAT(best_cells(table)[0], ElementsAre(true, true, false));
}

TEST(FigureTable, WhatIsOfHalfTheFramesIsNotTheBest) {
  SequenceFigures whole = figures("00", 0.553), half = figures("00", 0.188);
  half.coverage = 0.5;
  half.remark = "of 120 of 240 frames";
  const FigureTable table = table_of({{"whole", {whole}}, {"half", {half}}}, {"ate_rmse_m"});
  EXPECT_THAT(best_cells(table)[0], ElementsAre(false, false));
  EXPECT_EQ(table.rows[0].cells[1].note, "of 120 of 240 frames");
  half.coverage = 0.995;
  EXPECT_THAT(best_cells(table_of({{"whole", {whole}}, {"half", {half}}}, {"ate_rmse_m"}))[0],
              ElementsAre(false, true));
}

TEST(FigureTable, AFigureAloneIsNoBest) {
  const FigureTable table =
      table_of({{"a", {figures("00", 1)}}, {"b", {failed("00", "lost")}}}, {"ate_rmse_m"});
  EXPECT_THAT(best_cells(table)[0], ElementsAre(false, false));
}

TEST(FigureTable, WhatCannotBeATableIsRefused) {
  const SequenceFigures one = figures("00", 1);
  EXPECT_THAT(refusal_of([] { (void)table_of({}, {"ate_rmse_m"}); }), HasSubstr("no system"));
  EXPECT_THAT(refusal_of([&] { (void)table_of({{"a", {one}}}, {}); }), HasSubstr("no figure"));
  EXPECT_THAT(refusal_of([&] {
                (void)table_of({{"a", {one}}}, {"ate_rsme_m"});
              }),
              HasSubstr("'ate_rsme_m'; did you mean ate_rmse_m?"));
  EXPECT_THAT(refusal_of([&] {
                (void)table_of({{"a", {one}}, {"a", {one}}}, {"ate_rmse_m"});
              }),
              HasSubstr("two systems have the name a"));
  EXPECT_THAT(refusal_of([&] {
                (void)table_of({{"a", {one, one}}}, {"ate_rmse_m"});
              }),
              HasSubstr("a has two results of 00"));
  FigureTable table;
  table.columns.resize(2);
  table.rows.push_back({"r", {TableCell()}, false});
  EXPECT_THAT(refusal_of([&] { table.check(); }), HasSubstr("'r' has 1 cells for 2 columns"));
  table.rows[0].cells.resize(2);
  table.rows[0].cells[1].value = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal_of([&] { table.check(); }), HasSubstr("not finite"));
}

TEST(FigureTable, AnEvaluationGivesItsFiguresReasonsAndLostFrames) {
  Random random(3);
  const Trajectory truth = test::winding_drive(60);
  Trajectory estimate = test::drifting(truth, 0.02, 0.002, random);
  estimate.poses[30].T_world_body.reset();
  EvaluationOptions options;
  options.segments.lengths_m = {1000};
  const EvaluationResult result = evaluate(truth, estimate, options);
  const SequenceFigures own = sequence_figures(result, "00");
  EXPECT_EQ(own.remark, "of 59 of 60 frames");
  EXPECT_EQ(own.coverage, result.coverage);
  EXPECT_EQ(own.reasons.at("t_rel_percent"), result.segments.outcome.reason);
  EXPECT_FALSE(own.reasons.contains("ate_rmse_m"));
  const FigureTable table = table_of({{"a", {own}}}, {"ate_rmse_m", "t_rel_percent"});
  EXPECT_EQ(table.rows[0].cells[0].value, result.ape.error_m.rmse);
  EXPECT_EQ(table.rows[0].cells[1].note, result.segments.outcome.reason);
}

TEST(FigureTable, NumbersHaveThreeDigitsOfTheSmallestOfTheirGroup) {
  const auto decimals_for = [](std::vector<double> values) {
    FigureTable table;
    table.columns = {{"a", "", "m"}};
    for (const double value : values)
      table.rows.push_back({"r", {TableCell{value, {}, "", "", 1}}, false});
    return decimals_of_columns(table).front();
  };
  EXPECT_EQ(decimals_for({0.553, 0.188}), 3);
  EXPECT_EQ(decimals_for({12.5, 130}), 1);
  EXPECT_EQ(decimals_for({1250, 999}), 0);
  EXPECT_EQ(decimals_for({1e-9, 12}), 4);    // one tiny value does not lengthen the others
  EXPECT_EQ(decimals_for({2e-6, 3e-6}), 8);  // all are tiny
  EXPECT_EQ(decimals_for({0, 0}), 3);
}

TEST(FigureTable, AnIntervalHasTwoDigits) {
  FigureTable table;
  table.columns = {{"a", "", "m"}};
  table.rows.push_back({"r", {TableCell{12.3456, {{12.3, 12.38}}, "", "", 1}}, false});
  EXPECT_EQ(decimals_of_columns(table).front(), 3);  // half an interval is 0.040
  const PrintedTable shown = printed(table);
  EXPECT_EQ(shown.cells[0][0].number, "12.346");
  EXPECT_EQ(shown.cells[0][0].interval, "[12.300, 12.380]");
}

TEST(FigureTable, NoValueIsPrintedAsZeroThatIsNone) {
  EXPECT_EQ(number_text(0, 3), "0.000");
  EXPECT_EQ(number_text(-0.0, 3), "0.000");
  EXPECT_EQ(number_text(0.0125, 3), "0.013");
  EXPECT_EQ(number_text(0.0004, 3), "4.00e-04");
  EXPECT_EQ(number_text(3, 0), "3");
  EXPECT_EQ(number_text(2.5e15, 3), "2.50e+15");
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const double value = std::pow(10.0, random.uniform(-12, 14));
    const int decimals = static_cast<int>(random.uniform(1, 6));
    EXPECT_NEAR(std::stod(number_text(value, decimals)) / value, 1, 0.1001) << value;
  }
}

}  // namespace figure_table_test
}  // namespace placegraph
