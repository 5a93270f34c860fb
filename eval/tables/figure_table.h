#pragma once
#include <placegraph/eval/trajectory/result.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A figure of a table, or why there is none.
struct TableCell {
  std::optional<double> value;  ///< finite, in the unit of its column; nothing: no figure
  std::optional<std::pair<double, double>> interval;  ///< lower and upper bound of the value
  std::string text;     ///< stands in place of a number, as "120/240", and is not compared
  std::string note;     ///< why there is no value, or a remark about it; one line
  double coverage = 1;  ///< share of the frames to be judged that the value is of, 0 to 1
};

/// Which of two figures is better.
enum class BetterFigure {
  kLower,   ///< the lower one: errors
  kHigher,  ///< the higher one: shares
  kNearerZero,  ///< the one of smaller magnitude: drifts; means of them are not compared
  kNone     ///< neither: counts
};

/// A column of a table.
struct TableColumn {
  std::string name;   ///< its heading
  std::string group;  ///< heading above it and its neighbours of one group; empty: none
  std::string unit;   ///< of its values, "m"; empty: none
  BetterFigure better = BetterFigure::kLower;  ///< for the mark of the best
  std::optional<int> decimals = {};  ///< of its numbers, 0 to 17; nothing: as the values need
};

/// A row of a table.
struct TableRow {
  std::string name;              ///< its heading
  std::vector<TableCell> cells;  ///< one for each column
  bool summary = false;          ///< of other rows, as a mean: stands below a line
};

/// Among which cells the best is marked.
enum class TableBest {
  kNone,   ///< nowhere
  kRow,    ///< in each row, among columns of one group
  kColumn  ///< in each column, rows that are a summary left out
};

/// Figures in rows and columns, for texts and files (table_writers.h).
struct FigureTable {
  std::string caption;               ///< what the table shows, one line; empty: none
  std::string corner;                ///< heading of the names of the rows
  std::vector<TableColumn> columns;  ///< those of one group stand side by side
  std::vector<TableRow> rows;
  TableBest best = TableBest::kNone;  ///< where the best figures are marked
  std::vector<std::string> notes;     ///< lines below the table

  /// Throws ArgumentError unless every row has a cell for each column and all numbers are finite.
  void check() const;
};

/// For each cell of a table whether it is a best one, to the digits that are printed.
/// None is marked where the best value is of fewer frames than another one it is compared with
/// (coverage lower by more than 0.01), or is compared with none.
std::vector<std::vector<bool>> best_cells(const FigureTable& table);

/// Figures of one system on one sequence.
struct SequenceFigures {
  std::string name;             ///< of the sequence
  std::string failure;          ///< why there are no figures, one line; empty: there are
  std::vector<Metric> figures;  ///< no value: the data allow none
  std::map<std::string, std::string> reasons;  ///< why a figure has no value, by Metric::key
  std::map<std::string, std::pair<double, double>> intervals;  ///< bounds, by Metric::key
  std::string remark;   ///< about all of them, one line; empty: none
  double coverage = 1;  ///< share of the judged frames that are posed
};

/// The figures of an evaluation for a table, with its reasons and a remark on lost frames.
SequenceFigures sequence_figures(const EvaluationResult& result, const std::string& name);

/// A system with its results.
struct NamedResults {
  std::string name;                        ///< of the system
  std::vector<SequenceFigures> sequences;  ///< in the order of the table
};

/// What the rows of a table of results are.
enum class TableRows {
  kSequences,  ///< sequences, and for each figure a column for each system
  kSystems     ///< systems, and for each figure a column for each sequence
};

/// Makes the table of sequences and systems for the figures of these keys.
///
/// Sequences stand in the order in which the systems name them. A system that failed, or has no
/// estimate of a sequence, keeps its cell, whose note says so. Means follow, if there are several
/// sequences: "mean of all N", which a system without every figure does not have, and then "mean
/// of those that all have", over the sequences on which each system has the figure. Throws
/// ArgumentError for no system, no key, a key that no result has, and names that stand twice.
FigureTable table_of(const std::vector<NamedResults>& systems, const std::vector<std::string>& keys,
                     TableRows rows = TableRows::kSequences);

}  // namespace placegraph
