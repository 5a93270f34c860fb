#pragma once
#include <placegraph/eval/trajectory/evaluate.h>

#include <string>
#include <vector>

namespace placegraph::apps {

/// The names in the order of Alignment, and in that of Association.
const std::vector<std::string>& eval_alignments();
const std::vector<std::string>& eval_associations();

struct EvalArguments {
  std::string truth;  ///< a trajectory, the folder of a KITTI sequence, or of trajectories
  std::vector<std::string> estimates;  ///< trajectories, or one folder of them
  std::vector<std::string> times;  ///< of KITTI files: one for all, or ground truth's, estimate's
  std::string align = "se3";       ///< one of eval_alignments()
  std::string associate = "auto";  ///< one of eval_associations()
  EvaluationOptions options;       ///< but the two that the names above choose
  std::string csv, latex, plot;    ///< files to write; empty: none
  bool force = false;              ///< overwrite them
};

struct EvalResult {
  std::vector<EvaluationResult> results;  ///< one for each estimate
  bool folders = false;                   ///< the files of two folders were paired by name

  /// Whether one file was judged by another.
  bool single() const { return results.size() == 1 && !folders; }
  /// The first that the data did not allow; nullptr if there is none. Then no file was written.
  const EvaluationResult* refused() const;
};

/// `placegraph eval`: judges trajectories by the true ones, and writes the files asked for if none
/// is refused. Throws ArgumentError, FileError.
EvalResult eval(const EvalArguments& arguments);

/// One result in full, of several a table.
std::string to_text(const EvalResult& result);
std::string to_json(const EvalResult& result);

}  // namespace placegraph::apps
