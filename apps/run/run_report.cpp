#include "apps/run/run_report.h"

#include <fmt/format.h>
#include <placegraph/graph/text/json_text.h>

#include <algorithm>

#include "apps/results/result_texts.h"

namespace placegraph::apps {
namespace {

using nlohmann::json;

/// A line whose text begins at the 14th byte.
std::string line(const std::string& label, const std::string& text) {
  constexpr std::size_t kWidth = 12;
  return label + std::string(kWidth - std::min(kWidth, label.size()), ' ') + " " + text + "\n";
}

std::string frames_text(const json& summary) {
  std::string text =
      line(summary["sequence"].get<std::string>(),
           fmt::format("{}, {} of {} frames posed ({} online), {} keyframes, {} places, {} loops",
                       summary["sensor"].get<std::string>(), summary["posed"].get<int>(),
                       summary["frames"].get<int>(), summary["posed_online"].get<int>(),
                       summary["keyframes"].get<int>(), summary["places"].get<int>(),
                       summary["loops_accepted"].get<int>()));
  if (const std::string components =
          components_text(summary.value("component_trajectories", json::array()));
      !components.empty())
    text += line("", components);
  for (const json& frames : summary["unposed"])
    text += line(
        "", fmt::format("no pose: {} ({} {})", frames["reason"].get<std::string>(),
                        frames["frames"].get<int>(), frames["frames"] == 1 ? "frame" : "frames"));
  return text;
}

std::string motion_text(const json& summary) {
  std::string text;
  if (summary.contains("motion") && summary["motion"]["median_deviation"].is_number())
    text += line("", fmt::format("motion by other sensors: {} constraints, deviation {:.2f} times "
                                 "the stated one",
                                 summary["motion"]["constraints"].get<int>(),
                                 summary["motion"]["median_deviation"].get<double>()));
  const bool scaled = !summary.contains("metric") || summary["metric"].get<bool>();
  if (!scaled && summary.contains("scale_doubted"))
    text += line("", "scale in doubt: the findings say why");
  else if (!scaled)
    text += line("", "scale unknown: lengths are not in metres; --camera-height gives the scale");
  if (!summary.contains("evaluation")) return text;
  for (const auto& [name, figures] : summary["evaluation"].items())
    if ((scaled || name == "sim3") && figures.contains("ate_rmse_m") &&
        figures["ate_rmse_m"].is_number())
      text += line(
          "", fmt::format("ATE {:.4f} m ({}), path {:.1f} m", figures["ate_rmse_m"].get<double>(),
                          name, summary["path_m"].get<double>()));
  return text;
}

std::string scene_text(const json& summary) {
  std::string text;
  if (summary.contains("floor_plan") && summary["floor_plan"].contains("walls")) {
    const json& plan = summary["floor_plan"];
    text +=
        line("", fmt::format("floor plan: {} walls, {} doors, {} rooms", plan["walls"].get<int>(),
                             plan["doors"].get<int>(), plan["rooms"].get<int>()));
  }
  if (summary.contains("semantic_map") && summary["semantic_map"].contains("cells"))
    text += line("", fmt::format("street map: {} cells of {} keyframes",
                                 summary["semantic_map"]["cells"].get<long long>(),
                                 summary["semantic_map"]["keyframes"].get<int>()));
  return text;
}

std::string judgement_lines(const json& summary) {
  if (!summary.contains("judgement")) return "";
  std::string text = judgement_text(summary["judgement"], std::string(13, ' '));
  text.pop_back();  // `line` ends it
  return line("judgement", text);
}

}  // namespace

std::string to_text(const RunReport& report) {
  const json& summary = report.summary;
  return frames_text(summary) + motion_text(summary) + scene_text(summary) +
         judgement_lines(summary) +
         line("",
              fmt::format("{:.1f} s, {:.1f} ms CPU a frame, results in {}",
                          summary["wall_s"].get<double>(),
                          1000 * summary["cpu_s"].get<double>() / summary["frames"].get<double>(),
                          report.out));
}

std::string to_json(const RunReport& report) { return json_text(report.summary, 1); }

std::string stages_text(const RunReport& report) {
  const double frames = std::max(1, report.summary["frames"].get<int>());
  std::string text =
      fmt::format("{:<22} {:>9} {:>13} {:>13}\n", "stage", "calls", "CPU ms/call", "CPU ms/frame");
  for (const json& stage : report.summary["stages"]) {
    const double ms = 1000 * stage["cpu_s"].get<double>();
    const auto calls = stage["calls"].get<std::int64_t>();
    text += fmt::format("{:<22} {:>9} {:>13.2f} {:>13.2f}\n", stage["name"].get<std::string>(),
                        calls, ms / static_cast<double>(calls), ms / frames);
  }
  return text;
}

}  // namespace placegraph::apps
