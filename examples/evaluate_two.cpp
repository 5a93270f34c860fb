/// Evaluates two trajectories against one ground truth and prints the better one:
/// evaluate_two TRUTH FIRST SECOND
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/eval/trajectory/report.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <cstdio>
#include <vector>

using namespace placegraph;

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "usage: %s TRUTH FIRST SECOND\n", argv[0]);
    return 2;
  }
  const Trajectory truth = read_trajectory(argv[1]);
  EvaluationOptions options;
  options.alignment = Alignment::kSe3;

  std::vector<EvaluationResult> results;
  for (int i = 2; i < 4; ++i) {
    results.push_back(evaluate(truth, read_trajectory(argv[i]), options, argv[i]));
    if (!results.back().outcome) {
      std::fprintf(stderr, "%s: %s\n", argv[i], results.back().outcome.reason.c_str());
      return 1;
    }
  }
  std::fputs(to_table(results, false).c_str(), stdout);
  const bool first = results[0].ape.error_m.rmse <= results[1].ape.error_m.rmse;
  std::printf("smaller absolute error: %s\n", results[first ? 0 : 1].name.c_str());
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
