#pragma once
#include <placegraph/eval/tables/figure_table.h>

#include <string>
#include <vector>

#include "apps/eval/eval.h"

namespace placegraph::apps {

/// Names of TableRows, in its order.
const std::vector<std::string>& table_row_names();

struct EvalTableArguments {
  /// "NAME=PATH" or a path, whose name is the system's: folders of trajectories (or trajectories,
  /// where the truth is one), or result archives of evo.
  std::vector<std::string> systems;
  EvalArguments judging;  ///< the truth and how estimates are judged by it; not used by archives
  std::vector<std::string> figures;  ///< keys of figures; empty: the usual ones that there are
  std::string rows = "sequences";    ///< one of table_row_names()
  std::vector<std::string> outputs;  ///< files to write, of table_file_endings()
  bool force = false;                ///< overwrite them
};

/// Judges systems on sequences and writes the tables: `placegraph eval table`.
/// Failures keep their cells. Throws ArgumentError, FileError, and NoResult if no system has a
/// figure.
FigureTable eval_table(const EvalTableArguments& arguments);

}  // namespace placegraph::apps
