#include <placegraph/pipeline/results/component_files.h>
#include <placegraph/pipeline/results/result_json.h>
#include <placegraph/pipeline/results/run_files.h>
#include <placegraph/pipeline/results/run_judgement.h>
#include <placegraph/pipeline/results/run_results.h>

#include <nlohmann/json.hpp>

namespace placegraph {

using nlohmann::json;

namespace {

std::string text_of(const json& data) {
  return data.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

bool metric_of(const json& result) {
  const auto judgement = result.find("judgement");
  return (judgement == result.end() ? result : *judgement).value("metric", true);
}

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

std::string run_json(const RunResult& run, const Trajectory& optimized) {
  return text_of(describe_run(run, optimized));
}

std::string motion_json(const PlaceGraph& graph) { return text_of(describe_motion(graph)); }

std::string components_json(const Map& map) { return text_of(describe_components(map)); }

std::string judgement_json(const Judgement& judgement) {
  return text_of(describe_judgement(judgement));
}

std::string truth_json(const Trajectory& truth, const RunResult& run, const Trajectory& optimized) {
  return text_of(judge_run(truth, run, optimized));
}

}  // namespace placegraph
