#pragma once
#include <placegraph/pipeline/run.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph::apps {

/// The judgement for result.json: verdict, metric, why_metric, and findings with cause, text,
/// advice.
nlohmann::json describe_judgement(const Judgement& judgement);

/// The judgement in lines of text, the first one with the verdict; each ends with a line break and
/// all but the first begin with `indent`.
std::string judgement_text(const nlohmann::json& judgement, const std::string& indent);

}  // namespace placegraph::apps
