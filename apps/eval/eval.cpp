#include "apps/eval/eval.h"

#include <fmt/format.h>
#include <placegraph/eval/plots/evaluation_plot.h>
#include <placegraph/eval/trajectory/report.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <algorithm>
#include <filesystem>

#include "apps/support/choice.h"
#include "apps/support/distinct_paths.h"
#include "apps/support/output.h"
#include "apps/support/plot_file.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

// One estimate to evaluate: both files and the name of the result.
struct Job {
  std::string truth, estimate, name;
};

std::vector<fs::path> files_in(const std::string& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename().string().front() != '.')
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// The file in `folder` with the same name, or else the only one with the same stem.
fs::path partner(const fs::path& truth, const std::vector<fs::path>& candidates) {
  std::vector<fs::path> same_stem;
  for (const fs::path& candidate : candidates) {
    if (candidate.filename() == truth.filename()) return candidate;
    if (candidate.stem() == truth.stem()) same_stem.push_back(candidate);
  }
  if (same_stem.empty()) return {};
  require(same_stem.size() == 1,
          truth.filename().string() + ": both " + same_stem[0].filename().string() + " and " +
              same_stem.back().filename().string() + " could be its estimate");
  return same_stem.front();
}

std::vector<Job> folder_jobs(const std::string& truth, const std::string& estimate) {
  std::vector<Job> jobs;
  const std::vector<fs::path> candidates = files_in(estimate);
  for (const fs::path& file : files_in(truth)) {
    const fs::path match = partner(file, candidates);
    if (match.empty())
      warn(file.string() + ": no file of that name in " + estimate);
    else
      jobs.push_back({file.string(), match.string(), file.stem().string()});
  }
  require(!jobs.empty(), estimate + ": no file has the name of one in " + truth);
  return jobs;
}

// The first of file name, folder name and path that no other estimate shares.
std::string short_name(const std::string& estimate, const std::vector<std::string>& all) {
  const auto folder = [](const fs::path& path) { return path.parent_path().filename(); };
  const auto is_unique = [&](auto&& part) {
    return 1 == std::count_if(all.begin(), all.end(), [&](const std::string& other) {
             return part(fs::path(other)) == part(fs::path(estimate));
           });
  };
  const fs::path path(estimate);
  if (is_unique([](const fs::path& p) { return p.filename(); })) return path.filename().string();
  if (!folder(path).empty() && is_unique(folder)) return folder(path).string();
  return estimate;
}

bool is_run(const std::string& folder) {
  return fs::exists(fs::path(folder) / "trajectory_optimized.kitti");
}

/// The trajectory of a run for a truth: with times where the truth has them.
std::string trajectory_of_run(const std::string& folder, const std::string& truth) {
  const std::string extension = fs::path(truth).extension().string();
  const bool timed = fs::is_directory(truth) || extension == ".tum" || extension == ".csv" ||
                     fs::exists(fs::path(truth).parent_path() / "times.txt");
  return (fs::path(folder) / (timed ? "trajectory_optimized.tum" : "trajectory_optimized.kitti"))
      .string();
}

std::vector<Job> jobs_of(const EvalArguments& arguments) {
  std::string truth = arguments.truth;
  const std::vector<std::string>& estimates = arguments.estimates;
  const bool one_folder =
      estimates.size() == 1 && fs::is_directory(estimates.front()) && !is_run(estimates.front());
  if (fs::is_directory(truth)) {
    const std::string poses = (fs::path(truth) / "poses.txt").string();
    require(!one_folder || !fs::exists(poses),
            estimates.front() + ": is not an output folder of `placegraph run`");
    if (one_folder) return folder_jobs(truth, estimates.front());
    if (fs::exists(poses)) truth = poses;  // otherwise a sequence of another kind
  }
  std::vector<Job> jobs;
  for (const std::string& estimate : estimates) {
    const bool folder = fs::is_directory(estimate);
    require(!folder || is_run(estimate),
            estimate +
                ": is a folder without trajectory_optimized.kitti, and the ground truth is "
                "one trajectory");
    jobs.push_back({truth, folder ? trajectory_of_run(estimate, truth) : estimate,
                    short_name(estimate, estimates)});
  }
  return jobs;
}

/// The ground truth of a sequence, as `run` reads it.
Trajectory truth_of_sequence(const std::string& folder) {
  const auto dataset = open_dataset(folder);
  if (!dataset->ground_truth()) throw FileError(folder, "the sequence has no ground truth");
  return *dataset->ground_truth();
}

/// `times` are those of a file without times of its own; others keep theirs.
Trajectory read(const std::string& path, const std::string& times) {
  Trajectory trajectory = read_trajectory(path, {}, Orientation::kOptional);
  if (!trajectory.has_times && !times.empty()) give_times(trajectory, path, times);
  return trajectory;
}

/// The trajectories are local, because long ones take most of the memory.
PairingResult pair(const Job& job, const EvalArguments& arguments,
                   const EvaluationOptions& options) {
  const std::string truth_times = arguments.times.empty() ? "" : arguments.times.front();
  const std::string estimate_times = arguments.times.empty() ? "" : arguments.times.back();
  const Trajectory estimate = read(job.estimate, estimate_times);
  Trajectory truth =
      fs::is_directory(job.truth) ? truth_of_sequence(job.truth) : read(job.truth, truth_times);
  // A KITTI sequence stores its times beside its poses; they are needed if the estimate has times.
  const fs::path beside = fs::path(job.truth).parent_path() / "times.txt";
  if (!truth.has_times && estimate.has_times && fs::path(job.truth).filename() == "poses.txt" &&
      options.association != Association::kIndex && fs::exists(beside))
    give_times(truth, job.truth, beside.string());
  return pair_trajectories(truth, estimate, options.association, options.time);
}

/// A figure to write.
struct PlotFile {
  EvaluationPlot kind;
  std::string path;
};

/// One figure into the file itself, several into files beside it, of which the names end in the
/// kind: "e_xyz.png".
std::vector<PlotFile> plot_files(const EvalArguments& arguments) {
  if (arguments.plot.empty()) return {};
  const std::vector<std::string>& kinds = arguments.plot_kinds;
  require(!kinds.empty(), "--plot-kind: names no figure");
  std::vector<PlotFile> files;
  for (const std::string& kind : kinds) {
    fs::path path = arguments.plot;
    if (kinds.size() > 1)
      path.replace_filename(
          fmt::format("{}_{}{}", path.stem().string(), kind, path.extension().string()));
    files.push_back(
        {choice<EvaluationPlot>("--plot-kind", evaluation_plot_names(), kind), path.string()});
  }
  return files;
}

void check_outputs(const EvalArguments& arguments) {
  if (!arguments.report.empty()) require_page_name(arguments.report);
  require_plot_name(arguments.plot);
  std::vector<NamedPath> outputs = {
      {"--csv", arguments.csv}, {"--latex", arguments.latex}, {"--report", arguments.report}};
  for (const PlotFile& file : plot_files(arguments)) outputs.push_back({"--plot", file.path});
  for (const NamedPath& output : outputs)
    if (!output.path.empty()) require_free(output.path, arguments.force);
  require_distinct_paths(outputs, {});
  require(arguments.times.size() <= 2, "--times: one file for all, or two: ground truth, estimate");
}

void write_outputs(const EvalArguments& arguments, const EvalResult& result) {
  const EvaluatedTruth truth = result.folders ? EvaluatedTruth::kOwn : EvaluatedTruth::kShared;
  std::vector<std::pair<std::string, std::string>> figures;  // before the first file is written
  const std::vector<PlotFile> files = plot_files(arguments);
  for (const PlotFile& file : files) try {
      figures.emplace_back(file.path, to_svg(figure_of(result.results, truth, file.kind)));
    } catch (const ArgumentError& error) {
      if (files.size() == 1) throw;
      warn(fmt::format("{} is not drawn: {}", file.path, error.what()));
    }
  if (!arguments.csv.empty()) write_file(arguments.csv, to_csv(result.results));
  if (!arguments.latex.empty()) write_file(arguments.latex, to_latex(result.results));
  for (const auto& [path, svg] : figures) write_plot(path, svg);
}

}  // namespace

const std::vector<std::string>& eval_alignments() {
  static const std::vector<std::string> names = {"none", "origin", "se3", "sim3", "scale"};
  return names;
}

const std::vector<std::string>& eval_associations() {
  static const std::vector<std::string> names = {"auto", "index", "time"};
  return names;
}

const EvaluationResult* EvalResult::refused() const {
  const auto found = std::find_if(results.begin(), results.end(),
                                  [](const EvaluationResult& r) { return !r.outcome; });
  return found == results.end() ? nullptr : &*found;
}

EvalResult eval(const EvalArguments& arguments) {
  EvaluationOptions options = arguments.options;
  options.alignment = choice<Alignment>("--align", eval_alignments(), arguments.align);
  options.association =
      choice<Association>("--associate", eval_associations(), arguments.associate);
  options.check();
  require(!arguments.estimates.empty(), "EST: no estimate is given");
  check_outputs(arguments);
  EvalResult result;
  const std::string& first = arguments.estimates.front();
  result.folders = fs::is_directory(first) && !is_run(first);
  for (const Job& job : jobs_of(arguments)) {
    result.results.push_back(evaluate(pair(job, arguments, options), options, job.name));
    for (const std::string& warning : result.results.back().warnings)
      warn(job.name + ": " + warning);
  }
  if (!result.refused()) write_outputs(arguments, result);
  return result;
}

std::string to_text(const EvalResult& result) {
  return result.single() ? to_text(result.results.front())
                         : to_table(result.results, result.folders);
}

std::string to_json(const EvalResult& result) {
  return result.single() ? to_json(result.results.front())
                         : to_json(result.results, result.folders);
}

}  // namespace placegraph::apps
