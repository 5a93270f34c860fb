#include "apps/pages.h"

#include <placegraph/pipeline/report/evaluation_page.h>
#include <placegraph/pipeline/report/graph_page.h>
#include <placegraph/pipeline/report/loops_page.h>
#include <placegraph/pipeline/report/run_page.h>

#include <filesystem>

#include "apps/eval/eval.h"
#include "apps/eval/loops.h"
#include "apps/graph/optimize.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

/// A file, or its folder where every sequence has a file of that name.
std::string name_of(const std::string& path) {
  const fs::path whole = fs::absolute(fs::path(path) / "").lexically_normal().parent_path();
  return (whole.filename() == "poses.txt" ? whole.parent_path() : whole).filename().string();
}

}  // namespace

void write_optimize_page(const OptimizeArguments& arguments, const OptimizeResult& result) {
  GraphPage page{fs::path(arguments.in).filename().string(), result.start, result.solution.graph,
                 result.solution.chi2_by_constraint,         {},           {}};
  for (const RejectedEdge& edge : result.solution.rejected)
    page.rejected.push_back(edge.constraint);
  page.figures = {{"chi2 (logarithm), before", result.before.log},
                  {"chi2 (logarithm)", result.after.log},
                  {"chi2 (g2o), before", result.before.g2o},
                  {"chi2 (g2o)", result.after.g2o},
                  {"iterations", result.solution.iterations},
                  {"rejected constraints", static_cast<double>(page.rejected.size())}};
  write_graph_page(arguments.report, page, kProgram);
}

void write_eval_page(const EvalArguments& arguments, const EvalResult& result) {
  write_evaluation_page(arguments.report,
                        {name_of(arguments.truth), result.results, result.folders}, kProgram);
}

void write_loops_page(const LoopsArguments& arguments, const LoopsResult& result) {
  LoopsPage page{result.protocol, result.truth, result.poses, arguments.poses, {}};
  for (const LoopJudgement& judgement : result.systems)
    page.systems.push_back(
        {judgement.name, judgement.path, judgement.benchmark, judgement.reliability});
  write_loops_page(arguments.report, page, kProgram, messages());
}

void write_folder_page(const std::string& folder, const std::string& file) {
  if (!fs::exists(fs::path(folder) / "map.db")) return;
  RunPageArguments arguments;
  arguments.runs = {folder};
  arguments.out = file;
  arguments.program = kProgram;
  arguments.force = true;
  (void)write_run_page(arguments, messages());
}

}  // namespace placegraph::apps
