#include "apps/eval/eval.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/drawing/figure_settings.h>
#include <placegraph/eval/edges/truth_noise.h>
#include <placegraph/eval/plots/evaluation_plot.h>
#include <placegraph/eval/trajectory/report.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/distinct_paths.h>
#include <placegraph/io/datasets/evaluated_files.h>
#include <placegraph/io/scene/ground_picture_file.h>
#include <placegraph/io/trajectories/trajectory_filter.h>
#include <placegraph/pipeline/report/run_page.h>
#include <placegraph/pipeline/results/evo_archives.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/support/choice.h"
#include "apps/support/output.h"
#include "apps/support/plot_file.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::vector<EvaluatedFiles> files_of_folders(const std::string& truths,
                                             const std::string& estimates, int& missing) {
  const PairedFiles paired = pair_files(truths, estimates);
  for (const std::string& file : paired.alone)
    warn(file + ": no file of that name in " + estimates);
  missing = static_cast<int>(paired.alone.size());
  return paired.pairs;
}

std::vector<EvaluatedFiles> files_of(const EvalArguments& arguments, int& missing) {
  const std::string& truth = arguments.truth;
  const std::vector<std::string>& estimates = arguments.estimates;
  const bool one_folder = estimates.size() == 1 && fs::is_directory(estimates.front()) &&
                          !is_run_folder(estimates.front());
  if (one_folder && fs::is_directory(truth)) {
    require(!fs::exists(fs::path(truth) / "poses.txt"),
            estimates.front() + ": is not an output folder of `placegraph run`");
    return files_of_folders(truth, estimates.front(), missing);
  }
  const std::vector<std::string> names = distinct_names(estimates);
  std::vector<EvaluatedFiles> files;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const bool folder = fs::is_directory(estimates[i]);
    require(!folder || is_run_folder(estimates[i]),
            estimates[i] +
                ": is a folder without trajectory_optimized.kitti, and the ground truth is "
                "one trajectory");
    files.push_back(
        {truth, folder ? trajectory_of_run(estimates[i], truth_has_times(truth)) : estimates[i],
         names[i]});
  }
  return files;
}

OffsetOptions offset_options(const EvalArguments& arguments, const EvaluationOptions& options) {
  const auto asked = [&](const char* name) {
    const std::vector<std::string>& names = arguments.estimated;
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  OffsetOptions offsets;
  offsets.body = asked("body");
  offsets.time = asked("time");
  offsets.scale = options.alignment == Alignment::kSim3 || options.alignment == Alignment::kScale;
  offsets.start_s = options.time.offset_s;
  return offsets;
}

/// The trajectories are local, because long ones take most of the memory.
PairingResult pair(const EvaluatedFiles& files, const EvalArguments& arguments,
                   const EvaluationOptions& options, std::optional<OffsetEstimate>& offsets) {
  std::string truth_times = arguments.times.empty() ? "" : arguments.times.front();
  const std::string estimate_times = arguments.times.empty() ? "" : arguments.times.back();
  const Trajectory estimate =
      TrajectoryFilter(arguments.apply).apply(read_evaluated(files.estimate, estimate_times));
  // A KITTI sequence stores its times beside its poses; they are needed if the estimate has times.
  if (truth_times.empty() && estimate.has_times && options.association != Association::kIndex)
    truth_times = times_beside(files.truth);
  const Trajectory truth =
      TrajectoryFilter(arguments.apply_truth).apply(read_truth(files.truth, truth_times));
  if (arguments.estimated.empty())
    return pair_trajectories(truth, estimate, options.association, options.time);
  offsets = estimate_offsets(truth, estimate, offset_options(arguments, options));
  AssociationOptions time = options.time;
  time.offset_s = 0;  // is part of what was estimated
  PairingResult paired;
  paired.outcome = offsets->outcome;
  return offsets->outcome ? pair_trajectories(truth, with_offsets(estimate, *offsets),
                                              options.association, time)
                          : paired;
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
  std::vector<NamedPath> outputs = {{"--csv", arguments.csv},
                                    {"--latex", arguments.latex},
                                    {"--report", arguments.report},
                                    {"--evo-results", arguments.evo_results}};
  for (const PlotFile& file : plot_files(arguments)) outputs.push_back({"--plot", file.path});
  for (const NamedPath& output : outputs)
    if (!output.path.empty()) require_free(output.path, arguments.force);
  require_distinct_paths(outputs, {});
  require(arguments.times.size() <= 2, "--times: one file for all, or two: ground truth, estimate");
}

std::string last_name_of(const std::string& path) {
  const fs::path whole = path;
  return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

/// How figures look, and what lies under them.
struct PlotLook {
  FigureSettings settings;
  std::optional<GroundPicture> ground;
};

/// Read before the work. Errors name the file.
PlotLook plot_look_of(const EvalArguments& arguments) {
  PlotLook look;
  const std::string& path = arguments.plot_settings;
  require(!arguments.plot.empty() || (path.empty() && arguments.map.empty()),
          "--plot-settings, --map: there is no --plot to apply them to");
  require(arguments.map_corners_m.empty() || !arguments.map.empty(),
          "--map-corners: there is no --map to place");
  if (!arguments.map.empty())
    look.ground = read_ground_picture(arguments.map, arguments.map_corners_m);
  if (path.empty()) return look;
  read_options(path, look.settings, option_notes());
  try {
    look.settings.check();
  } catch (const ArgumentError& error) {
    throw FileError(path, error.what());
  }
  return look;
}

void write_outputs(const EvalArguments& arguments, const EvalResult& result, const PlotLook& look) {
  const EvaluatedTruth truth = result.folders ? EvaluatedTruth::kOwn : EvaluatedTruth::kShared;
  std::vector<std::pair<std::string, std::string>> figures;  // before the first file is written
  const std::vector<PlotFile> files = plot_files(arguments);
  for (const PlotFile& file : files) try {
      figures.emplace_back(
          file.path, to_svg(with_settings(figure_of(result.results, truth, file.kind, look.ground),
                                          look.settings)));
    } catch (const ArgumentError& error) {
      if (files.size() == 1) throw;
      warn(fmt::format("{} is not drawn: {}", file.path, error.what()));
    }
  if (!arguments.csv.empty()) write_file(arguments.csv, to_csv(result.results));
  if (!arguments.latex.empty()) write_file(arguments.latex, to_latex(result.results));
  for (const auto& [path, svg] : figures) write_plot(path, svg);
  if (!arguments.evo_results.empty())
    write_evo_result(arguments.evo_results,
                     evo_result_of(result.results.front(), last_name_of(arguments.truth)));
}

/// The number on one side of the colon of a span; `missing` if there is none.
double span_end(const std::string& option, const std::string& text, double missing) {
  if (text.empty()) return missing;
  double value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  require(error == std::errc() && rest == text.data() + text.size(),
          option + ": '" + text + "' is not a number (a span is A:B, with either end open)");
  return value;
}

AlignmentSpan span_of(const std::string& option, const std::string& text,
                      AlignmentSpan::Unit unit) {
  const std::size_t colon = text.find(':');
  require(colon != std::string::npos, option + ": '" + text + "' is no span A:B");
  AlignmentSpan span;
  span.unit = unit;
  span.begin = span_end(option, text.substr(0, colon), span.begin);
  span.end = span_end(option, text.substr(colon + 1), span.end);
  require(span.begin < span.end, option + ": '" + text + "' ends before it begins");
  return span;
}

AlignmentSpan align_over(const EvalArguments& a) {
  require(!a.align_frames.empty() + !a.align_seconds.empty() + (a.align_first > 0) <= 1,
          "--align-frames, --align-seconds, --align-first: give one of them");
  if (!a.align_frames.empty())
    return span_of("--align-frames", a.align_frames, AlignmentSpan::Unit::kFrames);
  if (!a.align_seconds.empty())
    return span_of("--align-seconds", a.align_seconds, AlignmentSpan::Unit::kSeconds);
  AlignmentSpan span;
  if (a.align_first > 0) span = {AlignmentSpan::Unit::kPoses, 0, double(a.align_first)};
  return span;
}

}  // namespace

EvaluationOptions evaluation_options(const EvalArguments& arguments) {
  EvaluationOptions options = arguments.options;
  options.alignment = choice<Alignment>("--align", eval_alignments(), arguments.align);
  options.align_over = align_over(arguments);
  options.vertical = choice<Vertical>("--vertical", eval_verticals(), arguments.vertical);
  options.part = choice<ErrorPart>("--part", eval_parts(), arguments.part);
  for (const std::string& delta : arguments.deltas)
    options.relative.deltas.push_back(parse_delta(delta));
  options.below = parse_error_bounds(fmt::format("{}", fmt::join(arguments.below, ",")));
  if (arguments.all_pairs) options.relative.pairs = StepPairs::kAll;
  options.association =
      choice<Association>("--associate", eval_associations(), arguments.associate);
  options.check();
  return options;
}

EvaluationResult evaluate_files(const EvaluatedFiles& files, const EvalArguments& arguments,
                                EvaluationOptions options, std::vector<PairingResult>* kept) {
  std::optional<OffsetEstimate> offsets;
  PairingResult paired = pair(files, arguments, options, offsets);
  if (kept) kept->push_back(paired);
  if (offsets) options.time.offset_s = offsets->time_s;
  EvaluationResult result = evaluate(std::move(paired), options, files.name);
  if (offsets)
    for (const FreeOffset& free : offsets->free) result.warnings.push_back(free.text);
  result.offsets = std::move(offsets);
  result.protocol.filters = arguments.apply;
  result.protocol.truth_filters = arguments.apply_truth;
  result.protocol.offsets = fmt::format("{}", fmt::join(arguments.estimated, ","));
  return result;
}

const std::vector<std::string>& eval_alignments() {
  static const std::vector<std::string> names = {"none", "origin", "se3",
                                                 "sim3", "scale", "yaw"};
  return names;
}

const std::vector<std::string>& eval_associations() {
  static const std::vector<std::string> names = {"auto", "index", "time"};
  return names;
}

const std::vector<std::string>& eval_verticals() {
  static const std::vector<std::string> names = {"estimated", "x", "y", "z"};
  return names;
}

const std::vector<std::string>& eval_parts() {
  static const std::vector<std::string> names = {"space", "xy", "xz", "yz",
                                                 "fitted", "x", "y", "z"};
  return names;
}

const EvaluationResult* EvalResult::refused() const {
  const auto found = std::find_if(results.begin(), results.end(),
                                  [](const EvaluationResult& r) { return !r.outcome; });
  return found == results.end() ? nullptr : &*found;
}

EvalResult eval(const EvalArguments& arguments) {
  const EvaluationOptions options = evaluation_options(arguments);
  require(!arguments.estimates.empty(), "EST: no estimate is given");
  check_outputs(arguments);
  const PlotLook look = plot_look_of(arguments);
  EvalResult result;
  const std::string& first = arguments.estimates.front();
  result.folders = fs::is_directory(first) && !is_run_folder(first);
  const std::vector<EvaluatedFiles> all = files_of(arguments, result.missing);
  require(arguments.evo_results.empty() || all.size() == 1,
          "--evo-results: an archive of evo holds one estimate");
  const bool compared = !result.folders && all.size() > 1;
  std::vector<PairingResult> paired;
  std::vector<std::string> names;
  for (const EvaluatedFiles& files : all) {
    result.results.push_back(
        evaluate_files(files, arguments, options, compared ? &paired : nullptr));
    names.push_back(files.name);
    for (const std::string& warning : result.results.back().warnings)
      warn(files.name + ": " + warning);
  }
  if (compared) result.common = on_common_frames(paired, names, options);
  if (result.common.needed)
    warn("the estimates are of different frames: compare them by the figures of the frames that "
         "all have");
  if (arguments.repeated_runs) result.of_runs = intervals_of_repeated_runs(result.results);
  if (compared && options.intervals && !arguments.repeated_runs)
    result.comparisons =
        compare_with_first(result.common.needed ? result.common.results : result.results);
  if (!result.refused()) write_outputs(arguments, result, look);
  return result;
}

std::string to_text(const EvalResult& result) {
  if (result.single()) return to_text(result.results.front());
  std::string text = to_table(result.results, result.folders, result.missing);
  if (result.common.needed)
    text += "\non the frames that all estimates have:\n" + to_table(result.common.results, false);
  if (!result.of_runs.empty()) text += "\nover the runs:\n" + to_text(result.of_runs);
  for (const std::vector<FigureComparison>& each : result.comparisons)
    text.append("\n").append(to_text(each));
  return text;
}

std::string to_json(const EvalResult& result) {
  if (result.single()) return to_json(result.results.front());
  Json json =
      Json::parse(to_json(result.results, result.folders, result.common.results, result.missing));
  if (!result.of_runs.empty()) json["over_runs"] = Json::parse(to_json(result.of_runs));
  for (std::size_t i = 0; i < result.comparisons.size(); ++i)
    json["comparisons"].push_back({{"first", result.results.front().name},
                                   {"second", result.results[i + 1].name},
                                   {"figures", Json::parse(to_json(result.comparisons[i]))}});
  return json_text(json, 2);
}

}  // namespace placegraph::apps
