#pragma once
#include <placegraph/eval/trajectory/result.h>

#include <string>
#include <vector>

namespace placegraph::apps {

/// What a page of evaluated trajectories shows.
struct EvalPage {
  std::string truth;                      ///< name of the ground truth
  std::vector<EvaluationResult> results;  ///< those whose outcome is ok are shown
  /// Whether every result is of a sequence of its own, so that averages mean something and no two
  /// trajectories are compared.
  bool sequences = false;
};

/// A page with every estimate as a run, in the frame of its ground truth.
/// `program`: name and version of the program.
std::string eval_page(const EvalPage& page, const std::string& program);

/// Writes that page. Throws FileError if it cannot be written.
void write_eval_page(const std::string& file, const EvalPage& page, const std::string& program);

}  // namespace placegraph::apps
