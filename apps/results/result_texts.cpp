#include "apps/results/result_texts.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace placegraph::apps {

using nlohmann::json;

std::string judgement_text(const json& judgement, const std::string& indent) {
  const json& findings = judgement["findings"];
  std::string text = judgement["verdict"].get<std::string>();
  text += judgement["metric"].get<bool>() ? ": lengths are in metres, " : ": scale unknown, ";
  text += judgement["why_metric"].get<std::string>();
  if (judgement.contains("expected_drift_m"))
    text += fmt::format("; expected drift at the end {:.2g} m",
                        judgement["expected_drift_m"].get<double>());
  text += findings.empty() ? "; nothing contradicts the result\n" : "\n";
  for (const json& finding : findings) {
    text +=
        indent + finding["cause"].get<std::string>() + ": " + finding["text"].get<std::string>();
    if (const auto advice = finding["advice"].get<std::string>(); !advice.empty())
      text += "; " + advice;
    text += "\n";
  }
  return text;
}

std::string components_text(const json& components) {
  if (components.size() < 2) return "";
  std::string text = fmt::format("{} components, each in a frame of its own:", components.size());
  const char* separator = " ";
  for (const json& component : components) {
    text += fmt::format("{}{} frames from {} to {}{}", separator, component["posed"].get<int>(),
                        component["first_frame"].get<std::int64_t>(),
                        component["last_frame"].get<std::int64_t>(),
                        component["main"].get<bool>() ? " (main)" : "");
    separator = "; ";
  }
  return text;
}

}  // namespace placegraph::apps
