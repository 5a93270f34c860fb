#include "apps/eval/benchmarks/eval_record.h"

#include <fmt/format.h>
#include <placegraph/eval/gate/record.h>
#include <placegraph/eval/gate/trajectory_record.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/evaluated_files.h>
#include <placegraph/io/files/output_file.h>
#include <placegraph/io/trajectories/trajectory_filter.h>
#include <placegraph/pipeline/results/gate_files.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

/// The runs over one sequence.
struct RecordedRuns {
  std::string truth;
  std::vector<EvaluatedFiles> runs;
  std::vector<std::string> missing;  ///< a reason for each run without a file
};

std::string stem_of(const std::string& path) {
  const std::filesystem::path file = std::filesystem::path(path).lexically_normal();
  return (file.has_filename() ? file : file.parent_path()).stem().string();
}

/// Whether the truth is a folder of trajectories, not of one sequence.
bool holds_trajectories(const std::string& truth) {
  return std::filesystem::is_directory(truth) &&
         !std::filesystem::exists(std::filesystem::path(truth) / "poses.txt");
}

/// The files of folders: each folder of estimates is a run over all sequences.
std::map<std::string, RecordedRuns> runs_of_folders(const EvalArguments& evaluation) {
  std::map<std::string, RecordedRuns> sequences;
  std::vector<PairedFiles> folders;
  for (const std::string& folder : evaluation.estimates) {
    require(std::filesystem::is_directory(folder),
            folder + ": is no folder, and the ground truth is a folder of trajectories");
    folders.push_back(pair_files(evaluation.truth, folder));
    for (const EvaluatedFiles& pair : folders.back().pairs) sequences[pair.name].truth = pair.truth;
    for (const std::string& truth : folders.back().alone) sequences[stem_of(truth)].truth = truth;
  }
  for (auto& [name, sequence] : sequences)
    for (std::size_t i = 0; i < folders.size(); ++i) {
      const auto found = std::ranges::find(folders[i].pairs, name, &EvaluatedFiles::name);
      if (found == folders[i].pairs.end())
        sequence.missing.push_back(evaluation.estimates[i] + ": no file of " + name);
      else
        sequence.runs.push_back({found->truth, found->estimate, evaluation.estimates[i]});
    }
  return sequences;
}

std::map<std::string, RecordedRuns> recorded_runs(const EvalRecordArguments& arguments) {
  const EvalArguments& evaluation = arguments.evaluation;
  if (holds_trajectories(evaluation.truth)) {
    require(arguments.name.empty(),
            "--name: names one sequence; those of folders have the names of their files");
    return runs_of_folders(evaluation);
  }
  RecordedRuns sequence{evaluation.truth, {}, {}};
  for (const std::string& run : evaluation.estimates) {
    const bool folder = std::filesystem::is_directory(run);
    require(!folder || is_run_folder(run),
            run + ": is a folder without trajectory_optimized.kitti");
    const std::string file =
        folder ? trajectory_of_run(run, truth_has_times(evaluation.truth)) : run;
    sequence.runs.push_back({evaluation.truth, file, run});
  }
  return {{arguments.name.empty() ? stem_of(evaluation.truth) : arguments.name, sequence}};
}

/// A run without a file: it has no figure, as one that cannot be judged.
EvaluationResult missing_run(const std::string& reason) {
  EvaluationResult result;
  result.outcome = Outcome::failure(Outcome::Code::kTooFewData, "there is no trajectory");
  result.name = reason;
  return result;
}

SequenceRecord record_runs(const std::string& name, const RecordedRuns& sequence,
                             const EvalArguments& arguments, const EvaluationOptions& options) {
  std::vector<EvaluationResult> results;
  for (const EvaluatedFiles& run : sequence.runs) {
    results.push_back(evaluate_files(run, arguments, options));
    for (const std::string& warning : results.back().warnings) warn(run.name + ": " + warning);
    // Of several runs only the figures are needed.
    if (sequence.runs.size() > 1) results.back().aligned_pairs = {};
  }
  const Trajectory truth =
      TrajectoryFilter(arguments.apply_truth)
          .apply(read_truth(sequence.truth, arguments.times.empty() ? "" : arguments.times.front()));
  for (const std::string& reason : sequence.missing) results.push_back(missing_run(reason));
  return record_of(name, truth, results);
}

}  // namespace

Record eval_record(const EvalRecordArguments& arguments) {
  const EvaluationOptions options = evaluation_options(arguments.evaluation);
  require(!arguments.evaluation.estimates.empty(), "RUN: no run is given");
  require(arguments.evaluation.times.size() <= 2,
          "--times: one file for all, or two: ground truth, estimate");
  const bool exists = std::filesystem::exists(arguments.out);
  require_free(arguments.out, arguments.evaluation.force || arguments.append);
  Record record;
  if (arguments.append && exists) record = read_record(arguments.out);
  for (const auto& [name, runs] : recorded_runs(arguments))
    add_runs({arguments.programs, {record_runs(name, runs, arguments.evaluation, options)}},
             {arguments.out, "the new run"}, record);
  write_file(arguments.out, to_json(record));
  return record;
}

std::string to_text(const Record& record) {
  std::string text;
  for (const SequenceRecord& sequence : record.sequences) {
    const std::size_t runs = sequence.figures.empty() ? 0 : sequence.figures.front().values.size();
    text += fmt::format("{}: {} run{}", sequence.name, runs, runs == 1 ? "" : "s");
    if (const FigureRecord* ate = sequence.find("ate_rmse_m"); ate && ate->mean())
      text += fmt::format(", ATE {:.4g} m", *ate->mean());
    text += "\n";
    for (const std::string& failure : sequence.failures) text += "  failed: " + failure + "\n";
  }
  return text;
}

}  // namespace placegraph::apps
