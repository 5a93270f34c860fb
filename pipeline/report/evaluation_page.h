#pragma once
#include <placegraph/eval/trajectory/result.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What a page of evaluated trajectories shows.
struct EvaluationPage {
  std::string truth;                      ///< name of the ground truth
  std::vector<EvaluationResult> results;  ///< those whose outcome is ok are shown
  /// Whether every result is of a sequence of its own, so that averages mean something and no two
  /// trajectories are compared.
  bool sequences = false;
};

/// A page, HTML, with every estimate as a run, in the frame of its ground truth.
/// `program`: name and version of the program, which the page shows.
std::string evaluation_page(const EvaluationPage& page, const std::string& program);

/// Writes that page, as `placegraph eval --report` does.
/// Throws FileError if it cannot be written.
void write_evaluation_page(const std::string& file, const EvaluationPage& page,
                           const std::string& program);

}  // namespace placegraph
