#include "apps/results/judgement_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace placegraph::apps {

using nlohmann::json;

json describe_judgement(const Judgement& judgement) {
  json findings = json::array();
  for (const DataNote& finding : judgement.findings)
    findings.push_back(
        {{"cause", to_string(finding.cause)}, {"text", finding.text}, {"advice", finding.advice}});
  json result = {{"verdict", to_string(judgement.verdict)},
                 {"metric", judgement.metric},
                 {"why_metric", judgement.why_metric},
                 {"findings", findings}};
  if (judgement.expected_drift_m) result["expected_drift_m"] = *judgement.expected_drift_m;
  return result;
}

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

}  // namespace placegraph::apps
