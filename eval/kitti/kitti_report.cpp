#include <fmt/format.h>
#include <placegraph/eval/kitti/kitti_report.h>
#include <placegraph/graph/text/csv_text.h>
#include <placegraph/graph/text/json_text.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

using nlohmann::ordered_json;

std::string figure_cell(const KittiFigures& figures, double value) {
  return figures.outcome ? fmt::format("{:.4f}", value) : "-";
}

std::string rows_table(const char* at, const std::vector<KittiRow>& rows) {
  std::string text = fmt::format("\n  {:<11} {:>9} {:>11} {:>18}\n", at, "segments", "t_rel [%]",
                                 "r_rel [deg/100m]");
  for (const KittiRow& row : rows)
    fmt::format_to(std::back_inserter(text), "  {:<11g} {:>9} {:>11.4f} {:>18.4f}\n", row.at,
                   row.segments, row.t_percent, row.r_deg_per_100m);
  return text;
}

std::string one_system(const KittiSystem& system) {
  std::string text = fmt::format("{:<8} {:>7} {:>10} {:>9} {:>11} {:>18}\n", "sequence", "frames",
                                 "path [m]", "segments", "t_rel [%]", "r_rel [deg/100m]");
  const auto add = [&](const std::string& name, const std::string& frames, const std::string& path,
                       const KittiFigures& figures) {
    fmt::format_to(std::back_inserter(text), "{:<8} {:>7} {:>10} {:>9} {:>11} {:>18}\n", name,
                   frames, path, figures.segments, figure_cell(figures, figures.t_rel_percent),
                   figure_cell(figures, figures.r_rel_deg_per_100m));
  };
  for (const KittiSequence& s : system.sequences)
    if (s.has_truth)
      add(s.name, std::to_string(s.frames), s.faulty ? "-" : fmt::format("{:.1f}", s.path_m),
          s.figures);
  add("mean", "", "", system.mean);
  if (!system.mean.outcome) return text + "  no mean: " + system.mean.outcome.reason + "\n";
  return text + "  mean over all segments of all sequences: r_rel " +
         fmt::format("{:.6f} deg/m\n", system.mean.r_rel_deg_per_100m / 100) +
         rows_table("length [m]", system.mean.by_length) +
         rows_table("speed [m/s]", system.mean.by_speed);
}

/// The sequences with a truth, which are those of every system.
std::vector<std::string> judged_names(const KittiSystem& system) {
  std::vector<std::string> names;
  for (const KittiSequence& sequence : system.sequences)
    if (sequence.has_truth) names.push_back(sequence.name);
  return names;
}

const KittiFigures& figures_of(const KittiSystem& system, const std::string& name) {
  return std::ranges::find(system.sequences, name, &KittiSequence::name)->figures;
}

std::string several_systems(const std::vector<KittiSystem>& systems) {
  constexpr std::size_t kLeastWidth = 20;
  std::string head = fmt::format("{:<8}", ""), units = fmt::format("{:<8}", "sequence");
  std::vector<std::size_t> widths;
  for (const KittiSystem& system : systems) {
    widths.push_back(std::max(kLeastWidth, system.name.size()));
    head += fmt::format("  {:>{}}", system.name, widths.back());
    units += fmt::format("  {:>{}}", fmt::format("{:>9} {:>10}", "t_rel", "r_rel"), widths.back());
  }
  std::string text = head + "\n" + units + "\n";
  const auto add = [&](const std::string& name, auto&& figures_in) {
    fmt::format_to(std::back_inserter(text), "{:<8}", name);
    for (std::size_t i = 0; i < systems.size(); ++i) {
      const KittiFigures& figures = figures_in(systems[i]);
      const std::string cells =
          fmt::format("{:>9} {:>10}", figure_cell(figures, figures.t_rel_percent),
                      figure_cell(figures, figures.r_rel_deg_per_100m));
      fmt::format_to(std::back_inserter(text), "  {:>{}}", cells, widths[i]);
    }
    text += '\n';
  };
  for (const std::string& name : judged_names(systems.front()))
    add(name,
        [&](const KittiSystem& system) -> const KittiFigures& { return figures_of(system, name); });
  add("mean", [](const KittiSystem& system) -> const KittiFigures& { return system.mean; });
  text += "  t_rel [%], r_rel [deg/100m]; mean over all segments of all sequences\n";
  for (const KittiSystem& system : systems)
    if (!system.mean.outcome)
      text += fmt::format("  {}: no mean: {}\n", system.name, system.mean.outcome.reason);
  return text;
}

std::string count_text(std::size_t count, const char* one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

/// What was checked of a submission, and what was found.
std::string check_text(const KittiSystem& system) {
  const auto untrue = std::ranges::count(system.sequences, false, &KittiSequence::has_truth);
  const auto files = static_cast<std::size_t>(std::ranges::count_if(
      system.sequences, [](const KittiSequence& s) { return !s.file.empty(); }));
  std::string text = fmt::format("\n{}: {}", system.name, count_text(files, "file"));
  if (untrue > 0) text += fmt::format(", {} without ground truth: checked in form alone", untrue);
  text += fmt::format("; {}\n", system.faults.empty() ? "fit to be submitted"
                                                      : count_text(system.faults.size(), "fault"));
  for (const KittiFault& fault : system.faults) text += "  " + to_string(fault) + "\n";
  for (const KittiFault& warning : system.warnings)
    text += "  warning: " + to_string(warning) + "\n";
  return text;
}

ordered_json rows_json(const char* at, const std::vector<KittiRow>& rows) {
  ordered_json list = ordered_json::array();
  for (const KittiRow& row : rows)
    list.push_back({{at, row.at},
                    {"segments", row.segments},
                    {"t_rel_percent", row.t_percent},
                    {"r_rel_deg_per_100m", row.r_deg_per_100m}});
  return list;
}

void add_figures(const KittiFigures& figures, ordered_json& json) {
  const auto value = [&](double number) {
    return figures.outcome ? ordered_json(number) : ordered_json(nullptr);
  };
  json["outcome"] = figures.outcome                                        ? "ok"
                    : figures.outcome.code == Outcome::Code::kNotAttempted ? "not judged"
                                                                           : figures.outcome.reason;
  json["t_rel_percent"] = value(figures.t_rel_percent);
  json["r_rel_deg_per_100m"] = value(figures.r_rel_deg_per_100m);
  json["r_rel_deg_per_m"] = value(figures.r_rel_deg_per_100m / 100);
  json["segments"] = figures.segments;
  json["per_length"] = rows_json("length_m", figures.by_length);
  json["per_speed"] = rows_json("speed_m_per_s", figures.by_speed);
}

ordered_json faults_json(const std::vector<KittiFault>& faults) {
  ordered_json list = ordered_json::array();
  for (const KittiFault& fault : faults)
    list.push_back({{"file", fault.file},
                    {"line", fault.line > 0 ? ordered_json(fault.line) : ordered_json(nullptr)},
                    {"text", fault.text}});
  return list;
}

ordered_json system_json(const KittiSystem& system) {
  ordered_json json;
  json["name"] = system.name;
  add_figures(system.mean, json);
  json["sequences"] = ordered_json::array();
  for (const KittiSequence& sequence : system.sequences) {
    ordered_json row;
    row["name"] = sequence.name;
    row["file"] = sequence.file.empty() ? ordered_json(nullptr) : ordered_json(sequence.file);
    row["has_truth"] = sequence.has_truth;
    row["faulty"] = sequence.faulty;
    row["frames"] = sequence.frames;
    row["path_m"] = sequence.pairs.empty() ? ordered_json(nullptr) : ordered_json(sequence.path_m);
    add_figures(sequence.figures, row);
    json["sequences"].push_back(std::move(row));
  }
  json["faults"] = faults_json(system.faults);
  json["warnings"] = faults_json(system.warnings);
  return json;
}

}  // namespace

std::string to_text(const KittiBenchmark& benchmark) {
  std::string text = benchmark.systems.size() == 1 ? one_system(benchmark.systems.front())
                                                   : several_systems(benchmark.systems);
  for (const KittiSystem& system : benchmark.systems) text += check_text(system);
  return text;
}

std::string to_json(const KittiBenchmark& benchmark) {
  ordered_json json;
  json["systems"] = ordered_json::array();
  for (const KittiSystem& system : benchmark.systems)
    json["systems"].push_back(system_json(system));
  return json_text(json, 2);
}

std::string to_csv(const KittiBenchmark& benchmark) {
  CsvText csv;
  csv.row("system", "sequence", "frames", "path_m", "segments", "t_rel_percent",
          "r_rel_deg_per_100m");
  const auto add = [&](const KittiSystem& system, const std::string& name,
                       const std::string& frames, const std::string& path_m,
                       const KittiFigures& figures) {
    const auto value = [&](double number) {
      return figures.outcome ? fmt::format("{}", number) : std::string();
    };
    csv.row(system.name, name, frames, path_m, figures.segments, value(figures.t_rel_percent),
            value(figures.r_rel_deg_per_100m));
  };
  for (const KittiSystem& system : benchmark.systems) {
    for (const KittiSequence& s : system.sequences)
      if (s.has_truth)
        add(system, s.name, std::to_string(s.frames),
            s.pairs.empty() ? "" : fmt::format("{}", s.path_m), s.figures);
    add(system, "mean", "", "", system.mean);
  }
  return csv.text();
}

}  // namespace placegraph
