#pragma once
#include <placegraph/eval/gate/record.h>

#include <string>

#include "apps/eval/eval.h"

namespace placegraph::apps {

struct EvalRecordArguments {
  /// Truth, runs (files, output folders of `run`, or folders of trajectories if the truth is one)
  /// and how they are judged; no outputs of its own.
  EvalArguments evaluation;
  std::string name;                   ///< of the sequence; empty: that of the truth, or of the files
  std::vector<std::string> programs;  ///< versions to note in the record
  std::string out;                    ///< file to write
  bool append = false;  ///< add the runs to those of the file, and sequences that it lacks
};

/// Judges runs and writes them as a record: `placegraph eval record`.
/// A run that the data allow no figure is a failed run of the record, and a file that one of
/// several folders lacks, too. Throws ArgumentError, FileError.
Record eval_record(const EvalRecordArguments& arguments);

/// What was recorded, a line for each sequence.
std::string to_text(const Record& record);

}  // namespace placegraph::apps
