#include "apps/eval/benchmarks/eval_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/tables/table_writers.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/distinct_paths.h>
#include <placegraph/io/datasets/evaluated_files.h>
#include <placegraph/pipeline/results/evo_archives.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "apps/support/choice.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

/// A system of the command line.
struct GivenSystem {
  std::string name, path;
  bool named = false;  ///< the command line names it
};

std::string last_name(const fs::path& path) {
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

std::vector<GivenSystem> given_systems(const std::vector<std::string>& texts) {
  std::vector<GivenSystem> systems;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    GivenSystem system{last_name(text), text, false};
    if (!fs::exists(text) && equals != std::string::npos)
      system = {text.substr(0, equals), text.substr(equals + 1), true};
    require(!system.name.empty(), text + ": names no system");
    if (!fs::exists(system.path)) throw FileError(system.path, "is missing");
    systems.push_back(std::move(system));
  }
  return systems;
}

/// The name of the sequence whose truth is one file, or the folder of a sequence.
std::string sequence_of(const std::string& truth) {
  const fs::path path = truth;
  return fs::is_directory(path) ? last_name(path) : path.stem().string();
}

/// Results on all sequences of the truth, of which a system may lack some.
NamedResults judged_system(const GivenSystem& system, EvalArguments judging) {
  judging.estimates = {system.path};
  const EvalResult result = eval(judging);
  NamedResults named{system.name, {}};
  for (const EvaluationResult& each : result.results)
    named.sequences.push_back(
        sequence_figures(each, result.folders ? each.name : sequence_of(judging.truth)));
  if (!result.folders) return named;
  for (const std::string& file : pair_files(judging.truth, system.path).alone) {
    SequenceFigures& missing = named.sequences.emplace_back();
    missing.name = fs::path(file).stem().string();
    missing.failure = "no estimate";
    missing.coverage = 0;
  }
  std::ranges::sort(named.sequences, {}, &SequenceFigures::name);
  return named;
}

/// A name of evo, which may be a path, as a table shows it.
std::string evo_name(const std::string& name, const std::string& instead) {
  const std::string last = last_name(fs::path(name)), stem = fs::path(last).stem().string();
  return stem.empty() ? instead : stem;
}

/// One system for each name that the command line or evo gives.
std::vector<NamedResults> archived_systems(const std::vector<GivenSystem>& systems) {
  std::vector<NamedResults> all;
  std::map<std::string, std::string> protocols;  ///< of the figures, by their keys
  for (const GivenSystem& given : systems) {
    const EvoResult result = read_evo_result(given.path);
    const std::string name = given.named
                                 ? given.name
                                 : evo_name(result.estimate, fs::path(given.name).stem().string()),
                      sequence = evo_name(result.reference, "sequence");
    SequenceFigures figures = figures_of_evo(result, sequence);
    for (const Metric& metric : figures.figures) {
      const auto [first, fresh] = protocols.emplace(metric.key, metric.protocol);
      if (fresh || first->second == metric.protocol) continue;
      warn(fmt::format("{}: {} is '{}', and that of another archive '{}'", given.path, metric.name,
                       metric.protocol, first->second));
      break;
    }
    auto system = std::ranges::find(all, name, &NamedResults::name);
    if (system == all.end()) system = all.insert(all.end(), NamedResults{name, {}});
    auto known = std::ranges::find(system->sequences, sequence, &SequenceFigures::name);
    if (known == system->sequences.end()) {
      system->sequences.push_back(std::move(figures));
      continue;
    }
    for (Metric& metric : figures.figures) {
      require(std::ranges::count(known->figures, metric.key, &Metric::key) == 0,
              fmt::format("{}: another archive has {} of {} on {}; NAME={} names its system",
                          given.path, metric.name, name, sequence, given.path));
      known->figures.push_back(std::move(metric));
    }
  }
  return all;
}

bool has_value(const SequenceFigures& sequence, const std::string& key) {
  return std::ranges::any_of(sequence.figures, [&](const Metric& metric) {
    return (key.empty() || metric.key == key) && metric.value;
  });
}

/// Whether a system has a figure of this key (of any, if it is empty) on some sequence.
bool any_has(const std::vector<NamedResults>& systems, const std::string& key) {
  return std::ranges::any_of(systems, [&](const NamedResults& system) {
    return std::ranges::any_of(system.sequences,
                               [&](const SequenceFigures& s) { return has_value(s, key); });
  });
}

/// The usual figures, of which those that no system has are left out; of archives each RMSE.
std::vector<std::string> usual_figures(const std::vector<NamedResults>& systems, bool archives) {
  std::vector<std::string> keys;
  if (!archives) {
    for (const char* key : {"ate_rmse_m", "t_rel_percent"})
      if (any_has(systems, key)) keys.emplace_back(key);
    return keys;
  }
  for (const NamedResults& system : systems)
    for (const SequenceFigures& sequence : system.sequences)
      for (const Metric& metric : sequence.figures)
        if (metric.key.ends_with("rmse") && std::ranges::count(keys, metric.key) == 0)
          keys.push_back(metric.key);
  return keys;
}

std::string protocol_note(const EvalArguments& judging) {
  return fmt::format("align {}; segments of {} m, start step {}; association {}", judging.align,
                     fmt::join(judging.options.segments.lengths_m, ", "),
                     judging.options.segments.step, judging.associate);
}

void check_table_outputs(const EvalTableArguments& arguments) {
  std::vector<NamedPath> outputs;
  for (const std::string& path : arguments.outputs) {
    (void)table_file_text(FigureTable(), path);  // the ending, before the work
    require_free(path, arguments.force);
    outputs.push_back({"--out", path});
  }
  require_distinct_paths(outputs, {});
}

}  // namespace

const std::vector<std::string>& table_row_names() {
  static const std::vector<std::string> names = {"sequences", "systems"};
  return names;
}

FigureTable eval_table(const EvalTableArguments& arguments) {
  const auto rows = choice<TableRows>("--rows", table_row_names(), arguments.rows);
  require(!arguments.systems.empty(), "SYSTEM: no system is given");
  check_table_outputs(arguments);
  const std::vector<GivenSystem> given = given_systems(arguments.systems);
  const auto archives = std::ranges::count_if(
      given, [](const GivenSystem& system) { return is_zip_archive(system.path); });
  const bool archived = archives > 0;
  require(!archived || archives == static_cast<std::ptrdiff_t>(given.size()),
          "SYSTEM: result archives and trajectories do not go into one table");
  std::vector<NamedResults> systems;
  if (archived) {
    require(arguments.judging.truth.empty(),
            "--truth: result archives of evo are judged already, by their own truth");
    systems = archived_systems(given);
  } else {
    require(!arguments.judging.truth.empty(),
            "--truth: is needed to judge trajectories (result archives of evo are judged already)");
    for (const GivenSystem& system : given)
      systems.push_back(judged_system(system, arguments.judging));
  }
  if (!any_has(systems, "")) throw NoResult("no system has a figure on any sequence");
  FigureTable table = table_of(
      systems, arguments.figures.empty() ? usual_figures(systems, archived) : arguments.figures,
      rows);
  if (!archived) table.notes.push_back(protocol_note(arguments.judging));
  std::vector<std::pair<std::string, std::string>> files;  // all before the first is written
  for (const std::string& path : arguments.outputs)
    files.emplace_back(path, table_file_text(table, path));
  for (const auto& [path, text] : files) write_file(path, text);
  return table;
}

}  // namespace placegraph::apps
