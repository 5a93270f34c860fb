#include "apps/eval/cmd_eval.h"

#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/eval/trajectory/report.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/support/output.h"
#include "apps/support/plot_file.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

struct EvalArguments {
  std::string truth;
  std::vector<std::string> estimates;
  std::vector<std::string> times;
  std::string align = "se3", associate = "auto";
  std::string csv, latex, plot;
  bool json = false, force = false;
  EvaluationOptions options;
};

const std::vector<std::string> kAlignments = {"none", "origin", "se3", "sim3", "scale"};
const std::vector<std::string> kAssociations = {"auto", "index", "time"};

// One comparison to make: two files and what the result is called.
struct Job {
  std::string truth, estimate, name;
};

template <class Enum>
Enum choice(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Enum>(std::find(names.begin(), names.end(), name) - names.begin());
}

std::vector<fs::path> files_in(const std::string& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().filename().string().front() != '.')
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// The file of `folder` of the same name, or else the only one with the same stem.
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

// The file's name, else its folder's, else its path: the first that no other estimate has too.
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

std::vector<Job> jobs_of(const EvalArguments& arguments) {
  std::string truth = arguments.truth;
  const bool one_folder =
      arguments.estimates.size() == 1 && fs::is_directory(arguments.estimates.front());
  if (fs::is_directory(truth)) {
    if (one_folder) return folder_jobs(truth, arguments.estimates.front());
    const std::string poses = (fs::path(truth) / "poses.txt").string();
    require(fs::exists(poses), truth +
                                   ": is a folder without poses.txt, and the estimate is a "
                                   "file");
    truth = poses;
  }
  std::vector<Job> jobs;
  for (const std::string& estimate : arguments.estimates) {
    require(!fs::is_directory(estimate),
            estimate + ": is a folder, and the ground truth is a file");
    jobs.push_back({truth, estimate, short_name(estimate, arguments.estimates)});
  }
  return jobs;
}

/// `times` are those of a file without times of its own; others keep theirs.
Trajectory read(const std::string& path, const std::string& times) {
  Trajectory trajectory = read_trajectory(path, {}, Orientation::kOptional);
  if (!trajectory.has_times && !times.empty()) give_times(trajectory, path, times);
  return trajectory;
}

/// The trajectories are gone when it returns: long ones take most of the memory.
PairingResult pair(const Job& job, const EvalArguments& arguments) {
  const std::string truth_times = arguments.times.empty() ? "" : arguments.times.front();
  const std::string estimate_times = arguments.times.empty() ? "" : arguments.times.back();
  const Trajectory estimate = read(job.estimate, estimate_times);
  Trajectory truth = read(job.truth, truth_times);
  // A KITTI sequence keeps its times beside its poses; they are wanted where the estimate has some.
  const fs::path beside = fs::path(job.truth).parent_path() / "times.txt";
  if (!truth.has_times && estimate.has_times && fs::path(job.truth).filename() == "poses.txt" &&
      arguments.options.association != Association::kIndex && fs::exists(beside))
    give_times(truth, job.truth, beside.string());
  return pair_trajectories(truth, estimate, arguments.options.association, arguments.options.time);
}

EvaluationResult judge(const Job& job, const EvalArguments& arguments) {
  return evaluate(pair(job, arguments), arguments.options, job.name);
}

void check_outputs(const EvalArguments& arguments) {
  for (const std::string& path : {arguments.csv, arguments.latex, arguments.plot})
    if (!path.empty()) require_free(path, arguments.force);
  require_plot_name(arguments.plot);
  require(arguments.times.size() <= 2, "--times: one file for all, or two: ground truth, estimate");
}

void write_outputs(const EvalArguments& arguments, const std::vector<EvaluationResult>& results) {
  if (!arguments.csv.empty()) write_file(arguments.csv, to_csv(results));
  if (!arguments.latex.empty()) write_file(arguments.latex, to_latex(results));
  if (arguments.plot.empty()) return;
  write_plot(arguments.plot, plot_of(results));
}

void run(EvalArguments arguments) {
  arguments.options.alignment = choice<Alignment>(kAlignments, arguments.align);
  arguments.options.association = choice<Association>(kAssociations, arguments.associate);
  arguments.options.check();
  check_outputs(arguments);
  const bool folder = fs::is_directory(arguments.estimates.front());

  std::vector<EvaluationResult> results;
  for (const Job& job : jobs_of(arguments)) {
    results.push_back(judge(job, arguments));
    for (const std::string& warning : results.back().warnings) warn(job.name + ": " + warning);
  }
  const bool single = results.size() == 1 && !folder;
  std::string text = single ? to_text(results.front()) : to_table(results, folder);
  if (arguments.json) text = single ? to_json(results.front()) : to_json(results, folder);
  const auto refused = std::find_if(results.begin(), results.end(),
                                    [](const EvaluationResult& r) { return !r.outcome; });
  if (refused == results.end()) write_outputs(arguments, results);
  std::fputs(text.c_str(), stdout);
  if (refused != results.end()) throw NoAnswer(refused->name + ": " + refused->outcome.reason);
}

}  // namespace

void add_eval_command(CLI::App& app) {
  auto arguments = std::make_shared<EvalArguments>();
  EvalArguments& a = *arguments;
  CLI::App* command = app.add_subcommand(
      "eval", "Judge estimated trajectories against ground truth (KITTI, TUM or EuRoC form)");
  command->footer("placegraph eval poses.txt trajectory_optimized.kitti --align se3 --plot e.png");
  command
      ->add_option("GT", a.truth,
                   "true trajectory, a KITTI sequence's folder, or a folder of "
                   "trajectories")
      ->required()
      ->check(CLI::ExistingPath);
  command
      ->add_option("EST", a.estimates,
                   "estimates to compare, or one folder, whose files are paired with GT's by name")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_option("--align", a.align, "what is fitted first: none, origin, se3, sim3 or scale")
      ->check(CLI::IsMember(kAlignments))
      ->capture_default_str();
  command
      ->add_option("--lengths", a.options.segments.lengths_m, "segment lengths [m], as 100,200,300")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--step", a.options.segments.step, "frames between segment starts")
      ->capture_default_str();
  command
      ->add_option("--associate", a.associate,
                   "how lines are paired: auto (by time if both have times), index or time")
      ->check(CLI::IsMember(kAssociations))
      ->capture_default_str();
  command
      ->add_option("--max-difference", a.options.time.max_difference_s,
                   "largest difference of paired stamps [s]")
      ->capture_default_str();
  command->add_option("--offset", a.options.time.offset_s, "added to the estimate's stamps [s]")
      ->capture_default_str();
  command
      ->add_option("--times", a.times,
                   "times of KITTI files: one file for all, or two: ground truth's, estimate's")
      ->delimiter(',')
      ->expected(1)
      ->take_all()
      ->check(CLI::ExistingFile);
  command->add_flag("--json", a.json, "print JSON");
  command->add_option("--csv", a.csv, "write figures and every segment's errors as CSV");
  command->add_option("--latex", a.latex, "write a LaTeX table");
  command->add_option("--plot", a.plot, "draw top view and error over distance (.png or .svg)");
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
